#pragma once

#include <vector>

#include "albedo/directional_albedo.hpp"

namespace albedo {

/// How a curve goes between its nodes.
enum class CurveForm {
  rational,  ///< one barycentric rational function, fitted to about four times as many samples as it has nodes
  monotone,  ///< piecewise cubic, monotone where the nodes are: never overshoots
};

struct CurveOptions {
  AlbedoOptions
      albedo{};  ///< the tolerance of the curve is `albedo.tolerance`; its nodes are integrated somewhat better
  double phi_degrees = 0;  ///< azimuth of L
  int most_nodes = 4097;   ///< of the monotone form
};

/// a(θ) from normal incidence to grazing as a one-variate table, with as many nodes as its tolerance asks for.
///
/// The variable is x = −ln cosθ: away from grazing it follows cosθ, in which the albedo is analytic, and towards
/// grazing every decade of cosθ, over which boundary layers live, takes the same length. What is interpolated is ln a
/// (a itself if it has zeros), by the rational form, or by the monotone one where that doesn't converge. Nodes reach
/// cosθ = c₀ = 1e-10; below, the albedo follows its own power law with the first correction to it, (c/c₀)^p (A + (a(c₀)
/// − A) c/c₀), where p = 0 and A is the limit if that is finite and not 0.
class AlbedoCurve {
 public:
  struct Node {
    double cos_theta;
    Estimate albedo;
  };

  /// Where a is less than this part of its largest value, errors are relative to that: a curve with zeros has no
  /// others.
  static constexpr double relative_floor = 1e-3;

  /// @throws ParameterError as directional_albedo does, and unless phi is finite and there may be 16 nodes or more.
  explicit AlbedoCurve(const Model& model, const CurveOptions& options = {});

  /// The interpolated albedo for cosθ within [0, 1]; at 0 the limit, which is +infinity where the model diverges.
  [[nodiscard]] double operator()(double cos_theta) const;

  /// What |curve − a| stays within, relative to a: interpolation error measured between nodes plus the nodes' own
  /// error.
  [[nodiscard]] double relative_bound() const { return relative_bound_; }

  /// A value that a(L) doesn't exceed: the curve raised by its bound.
  [[nodiscard]] double upper(double cos_theta) const;

  /// 2 ∫ a(μ) μ dμ over [0, 1] of the interpolated albedo: what is reflected of light from everywhere.
  [[nodiscard]] double average() const;

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }  ///< from normal incidence to grazing
  [[nodiscard]] CurveForm form() const { return form_; }
  [[nodiscard]] double grazing_exponent() const { return grazing_exponent_; }  ///< p; negative where the model diverges
  [[nodiscard]] std::int64_t evaluations() const {
    return evaluations_;
  }                                                                 ///< of the BRDF, with those spent on verification
  [[nodiscard]] int integrations() const { return integrations_; }  ///< directions at which the albedo was integrated
  [[nodiscard]] Status status() const { return status_; }           ///< converged: the bound meets the tolerance

 private:
  std::vector<Node> nodes_;
  std::vector<double> variable_, values_, weights_;  ///< x, ln a or a, barycentric weights or slopes
  CurveForm form_ = CurveForm::rational;
  bool logarithmic_ = true;                        ///< values_ are ln a
  double floor_ = 0;                               ///< errors are relative to a or this
  double grazing_value_ = 0, grazing_factor_ = 0;  ///< the limit at cosθ = 0, and A
  double relative_bound_ = 0;
  double grazing_exponent_ = 0;
  std::int64_t evaluations_ = 0;
  int integrations_ = 0;
  Status status_ = Status::converged;
};

}  // namespace albedo
