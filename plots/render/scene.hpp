/// @file
/// What a picture shows: analytic shapes, their materials, light, and the camera.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "albedo/core/model.hpp"

namespace albedo::render {

using Vector = Eigen::Vector3d;

/// Radiance or reflectance in up to block_width bands; a picture in colours has red, green and blue in the first three.
using Spectrum = Block;

/// Red, green and blue.
Spectrum rgb(double red, double green, double blue);

struct Ray {
  Vector origin, direction;
};

/// The local frame of a surface: x is the axis of α_x, m_x, n_u; z the normal.
struct Frame {
  Vector x, y, z;

  [[nodiscard]] UnitVector<double> local(const Vector& v) const { return {v.dot(x), v.dot(y), v.dot(z)}; }
  [[nodiscard]] Vector world(const UnitVector<double>& v) const { return v.x * x + v.y * y + v.z * z; }
};

/// Of a sphere whose anisotropy runs around an axis: x along the parallels, y along the meridians.
Frame sphere_frame(const Vector& normal, const Vector& axis);

/// How a lobe's directions are drawn and weighted.
enum class Sampling {
  model,          ///< by the model's sampler, weight f cosθ/density
  equal_weights,  ///< by the model's sampler, one weight for all that are above the surface [Walter 2005, fig. 3]
  uniform,        ///< uniformly over the hemisphere, weight 2π f cosθ
};

/// A factor of a lobe's f by L·H: a colour, or a Fresnel factor.
using Reflectance = std::function<Spectrum(double cos_theta_d)>;
Reflectance constant(const Spectrum& colour);

/// One lobe of a model, coloured. The model's L is the direction to the eye: one that isn't reciprocal is seen as if
/// light went from there.
struct SurfaceLobe {
  std::shared_ptr<const Model> model;
  int component = 0;
  Reflectance reflectance{};
  Sampling sampling = Sampling::model;
  double equal_weight = 1;  ///< of Sampling::equal_weights
};

/// All lobes of a model.
/// @throws ParameterError for a model that has a lobe without a sampler, or a coherent part
std::vector<SurfaceLobe> lobes_of(std::shared_ptr<const Model> model, const Reflectance& reflectance);

/// A surface reflects, or it emits the same radiance in all directions of both its sides.
struct Material {
  std::vector<SurfaceLobe> lobes{};
  std::optional<Spectrum> emission{};
  double chequer = 0;          ///< edge of a facet's squares, 0 for none
  Spectrum odd = Spectrum(1);  ///< factor of every other square's reflectance
};

/// Seen from outside.
struct Sphere {
  Vector centre;
  double radius;
  std::size_t material;
  Vector axis = Vector::UnitZ();  ///< of its anisotropy
};

/// A parallelogram, or half of it.
struct Facet {
  Vector corner, u, v;
  std::size_t material;
  bool triangle = false;
};

struct Hit {
  double distance;
  Vector point;
  Frame frame;            ///< z on the side that the ray came from
  std::size_t primitive;  ///< spheres, then facets
  std::size_t material;
  bool odd = false;  ///< on an odd square
};

struct Scene {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::vector<Material> materials{};
  std::vector<Sphere> spheres{};
  std::vector<Facet> facets{};
  Spectrum environment = Spectrum(0);  ///< radiance from everywhere that no shape hides

  /// Adds a material and returns its number.
  std::size_t add(Material material);
  /// The six sides of a box, or five without its top (z).
  void add_box(const Vector& low, const Vector& high, std::size_t material, bool has_top = true);
  /// Four triangles over a square in a plane of constant z; `turn` in degrees about its axis.
  void add_pyramid(const Vector& base_centre, double edge, double height, double turn, std::size_t material);

  /// The first hit. A ray that leaves a primitive never hits that one again: all of them are convex.
  [[nodiscard]] std::optional<Hit> closest(const Ray& ray, std::size_t leaving = none) const;
};

/// Maps (x, y) of [−1, 1]² (left to right, bottom to top) to rays.
struct Camera {
  Vector eye, forward, right, up;  ///< right and up reach from the middle of the picture to its edges
  bool orthographic = false;

  /// @param fov_degrees of the picture's width
  static Camera perspective(const Vector& eye, const Vector& target, double fov_degrees, double aspect = 1);
  /// Parallel rays towards the target; the picture is 2 half_width wide.
  static Camera parallel(const Vector& target, const Vector& direction, double half_width);

  [[nodiscard]] Ray ray(double x, double y) const;
};

}  // namespace albedo::render
