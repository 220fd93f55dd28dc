#include "plots/render/scene.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "albedo/core/errors.hpp"

namespace albedo::render {
namespace {

/// Nearer than that is the edge that two facets share.
constexpr double least_distance = 1e-9;

/// Any unit vector across another one.
Vector across(const Vector& v) {
  const Vector other = std::abs(v.x()) < 0.5 ? Vector::UnitX() : Vector::UnitY();
  return other.cross(v).normalized();
}

/// The distance to a sphere from outside, if it is hit.
std::optional<double> distance(const Sphere& sphere, const Ray& ray) {
  const Vector to_centre = sphere.centre - ray.origin;
  const double along = to_centre.dot(ray.direction);
  // the square of the distance between centre and ray, without cancellation
  const double miss2 = (to_centre - along * ray.direction).squaredNorm();
  const double half2 = sphere.radius * sphere.radius - miss2;
  if (!(half2 > 0)) return {};
  const double t = along - std::sqrt(half2);
  if (t > least_distance) return t;
  return {};
}

struct Place {
  double distance, s, t;
};

/// [Möller & Trumbore 1997]
std::optional<Place> place(const Facet& facet, const Ray& ray) {
  const Vector p = ray.direction.cross(facet.v);
  const double determinant = p.dot(facet.u);
  if (determinant == 0) return {};
  const Vector from_corner = ray.origin - facet.corner;
  const double s = from_corner.dot(p) / determinant;
  if (!(s >= 0 && s <= 1)) return {};
  const Vector q = from_corner.cross(facet.u);
  const double t = q.dot(ray.direction) / determinant;
  if (!(t >= 0 && t <= 1) || (facet.triangle && s + t > 1)) return {};
  const double far = q.dot(facet.v) / determinant;
  if (!(far > least_distance)) return {};
  return Place{far, s, t};
}

/// Whether a place is on an odd square of the facet.
bool is_odd(const Facet& facet, const Place& at, double edge) {
  const auto number = [edge](double length) { return static_cast<long>(std::floor(length / edge)); };
  return ((number(at.s * facet.u.norm()) + number(at.t * facet.v.norm())) & 1) != 0;
}

}  // namespace

Spectrum rgb(double red, double green, double blue) {
  return Spectrum::generate([&](int i) { return i == 0 ? red : i == 1 ? green : i == 2 ? blue : 0; });
}

Frame sphere_frame(const Vector& normal, const Vector& axis) {
  const Vector along = axis.cross(normal);
  const double length = along.norm();
  const Vector x = length > 0 ? Vector(along / length) : across(normal);
  return {x, normal.cross(x), normal};
}

Reflectance constant(const Spectrum& colour) {
  return [colour](double) { return colour; };
}

std::vector<SurfaceLobe> lobes_of(std::shared_ptr<const Model> model, const Reflectance& reflectance) {
  const std::string& name = model->info().name;
  if (model->coherent_albedo(Direction{}) != 0) {
    throw ParameterError("scene: '" + name + "' has a coherent part, which can't be drawn");
  }
  std::vector<SurfaceLobe> lobes;
  for (const Lobe& lobe : model->lobes()) {
    if (!model->has_sampler(lobe.component)) {
      throw ParameterError("scene: lobe " + std::to_string(lobe.component) + " of '" + name + "' has no sampler");
    }
    lobes.push_back({.model = model, .component = lobe.component, .reflectance = reflectance});
  }
  return lobes;
}

std::size_t Scene::add(Material material) {
  materials.push_back(std::move(material));
  return materials.size() - 1;
}

void Scene::add_box(const Vector& low, const Vector& high, std::size_t material, bool has_top) {
  const Vector size = high - low;
  const Vector x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  facets.push_back({low, x, y, material});
  facets.push_back({low, x, z, material});
  facets.push_back({low, y, z, material});
  facets.push_back({low + y, x, z, material});
  facets.push_back({low + x, y, z, material});
  if (has_top) facets.push_back({low + z, x, y, material});
}

void Scene::add_pyramid(const Vector& base_centre, double edge, double height, double turn, std::size_t material) {
  const Vector top = base_centre + Vector(0, 0, height);
  const auto corner = [&](int i) {
    const double angle = (turn + 90.0 * i + 45) * pi<double> / 180;
    return Vector(base_centre + edge / std::sqrt(2.0) * Vector(std::cos(angle), std::sin(angle), 0));
  };
  for (int i = 0; i < 4; ++i) {
    const Vector a = corner(i), b = corner(i + 1);
    facets.push_back({a, b - a, top - a, material, true});
  }
}

std::optional<Hit> Scene::closest(const Ray& ray, std::size_t leaving) const {
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t primitive = none;
  Place at{};
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (i == leaving) continue;
    const auto far = distance(spheres[i], ray);
    if (far && *far < nearest) nearest = *far, primitive = i;
  }
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (spheres.size() + i == leaving) continue;
    const auto found = place(facets[i], ray);
    if (found && found->distance < nearest) nearest = found->distance, primitive = spheres.size() + i, at = *found;
  }
  if (primitive == none) return {};

  Hit hit{.distance = nearest,
          .point = ray.origin + nearest * ray.direction,
          .frame = {},
          .primitive = primitive,
          .material = 0};
  if (primitive < spheres.size()) {
    const Sphere& sphere = spheres[primitive];
    hit.frame = sphere_frame((hit.point - sphere.centre).normalized(), sphere.axis);
    hit.material = sphere.material;
  } else {
    const Facet& facet = facets[primitive - spheres.size()];
    const Vector x = facet.u.normalized();
    Vector z = facet.u.cross(facet.v).normalized();
    if (z.dot(ray.direction) > 0) z = -z;
    hit.frame = {x, z.cross(x), z};
    hit.material = facet.material;
    const double edge = materials[facet.material].chequer;
    hit.odd = edge > 0 && is_odd(facet, at, edge);
  }
  return hit;
}

Camera Camera::perspective(const Vector& eye, const Vector& target, double fov_degrees, double aspect) {
  const Vector forward = (target - eye).normalized();
  const double half_width = std::tan(fov_degrees * pi<double> / 360);
  const Vector right = forward.cross(Vector::UnitZ()).normalized();
  return {eye, forward, half_width * right, half_width / aspect * right.cross(forward)};
}

Camera Camera::parallel(const Vector& target, const Vector& direction, double half_width) {
  const Vector forward = direction.normalized();
  const Vector right = forward.cross(Vector::UnitZ()).normalized();
  constexpr double far = 10;
  return {target - far * forward, forward, half_width * right, half_width * right.cross(forward), true};
}

Ray Camera::ray(double x, double y) const {
  const Vector shift = x * right + y * up;
  if (orthographic) return {eye + shift, forward};
  return {eye, (forward + shift).normalized()};
}

}  // namespace albedo::render
