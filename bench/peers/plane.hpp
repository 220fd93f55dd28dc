/// @file
/// One of the battery's integrals as a library rule sees it: a function on the unit square.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "albedo/core/model.hpp"
#include "core/integrand.hpp"

namespace albedo::peers {

/// What the unit square stands for.
enum class Coordinates {
  hemisphere,  ///< (θ_V, φ_V), half a turn of φ_V from L's azimuth on: one panel
  lobe         ///< this library's own coordinates of the lobe, a panel for each part of its domain
};

std::string_view to_string(Coordinates coordinates);

/// A material of the battery: a model with one parameter set.
struct Material {
  std::string model;
  std::string parameter;
  double value;

  [[nodiscard]] std::unique_ptr<Model> make() const { return make_model(model, {{parameter, value}}); }
};

/// w(u, v) on the unit squares of an integral; the model's formula is compiled into every function, so that an
/// evaluation is one indirect call, as a C library's rules make it anyway. Counts the evaluations, and answers 0 beyond
/// the budget.
class Plane {
 public:
  virtual ~Plane() = default;

  [[nodiscard]] virtual int panels() const = 0;

  virtual double at(int panel, double u, double v) = 0;
  /// Fixes v, for rules that are nested with u inside: what a ray's points have in common is computed once.
  virtual void set_ray(int panel, double v) = 0;
  virtual double on_ray(double u) = 0;

  /// The same in blocks. Its evaluations are counted by who makes them.
  [[nodiscard]] virtual const Integrand<double>& blocks() const = 0;

  void start(std::int64_t budget) { evaluations = 0, budget_ = budget; }
  [[nodiscard]] bool spent() const { return evaluations > budget_; }

  std::int64_t evaluations = 0;

 protected:
  Plane() = default;
  Plane(const Plane&) = default;
  Plane& operator=(const Plane&) = default;

 private:
  std::int64_t budget_ = 0;
};

/// A coordinate just inside the square: some rules evaluate at the horizon itself, where f is infinite and f cosθ_V is
/// 0.
inline double inside(double u) { return u < 1 ? u : 1 - 0x1p-53; }

/// `model` is what `material` makes. @param tolerance of what lobe coordinates may leave out
std::unique_ptr<Plane> make_plane(const Material& material, const Model& model, const Direction& l,
                                  Coordinates coordinates, double tolerance);

}  // namespace albedo::peers
