#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "albedo/core/estimate.hpp"
#include "albedo/core/model.hpp"

namespace albedo {

/// What keeps the output radiance of a pumped model from exceeding its input   [Neumann 1999, §3.2]. The paper's
/// "repeated controlled pumping" can be read in two ways.
enum class PumpControl {
  none,   ///< g = max(a(L), a(V)), eq. 20
  step,   ///< g = max(a(L), a(V), N·L, N·V), eq. 21, at every step
  total,  ///< the product of all divisors is at least max(N·L, N·V): what leads to eq. 22
};

std::string_view to_string(PumpControl control);

struct PumpOptions {
  static constexpr int most_times = 1000;

  int times = 1;  ///< K, within [0, most_times]
  PumpControl control = PumpControl::none;
  bool only_up = false;     ///< g ≤ 1, eq. 17: an albedo above 1 stays as it is
  double tolerance = 1e-8;  ///< of the tabulated albedos, relative; within [1e-12, 0.1]
};

/// D_K(L,V) = g_1 g_2 … g_K, by which K pumpings divide f: one-variate tables of ln a_k over x = −ln cosθ, piecewise
/// Chebyshev expansions of one degree on panels that all orders share. Every table is raised by its error, so that it
/// bounds a_k from above.
class PumpDivisor {
 public:
  static constexpr int terms = 11;        ///< of an expansion
  static constexpr double last_x = 138;   ///< cosθ ~ 1e-60; the tables end there, and what is beyond is as there
  using Expansion = std::vector<double>;  ///< orders × terms, of one panel

  PumpDivisor(std::vector<double> edges, PumpControl control, bool only_up)
      : edges_(std::move(edges)), expansions_(edges_.size() - 1), control_(control), only_up_(only_up) {}

  [[nodiscard]] int orders() const { return orders_; }
  [[nodiscard]] PumpControl control() const { return control_; }
  [[nodiscard]] bool only_up() const { return only_up_; }
  [[nodiscard]] const std::vector<double>& edges() const { return edges_; }

  /// ln of the tabulated bound of a_k.
  [[nodiscard]] double log_albedo(int order, double x) const;
  /// The same of all orders, in `values`.
  void log_albedos(double x, double* values) const;

  /// ln D after the step that follows `before`, from the two bounds.
  [[nodiscard]] double step(double before, double log_l, double log_v, double x_l, double x_v) const {
    double g = log_l > log_v ? log_l : log_v;
    const double floor = -(x_l < x_v ? x_l : x_v);
    if (control_ == PumpControl::step && g < floor) g = floor;
    if (only_up_ && g > 0) g = 0;
    const double after = before + g;
    return control_ == PumpControl::total && after < floor ? floor : after;
  }

  /// ln D_k of the first k orders, k ≤ orders().
  [[nodiscard]] double log_divisor(int k, double x_l, double x_v) const;

  /// Joins another order: its expansion on each panel, terms() numbers one after the other.
  void add_order(const std::vector<double>& expansions);
  /// Adds to the last order's ln a_k.
  void raise_last(double by);
  /// Divides a panel at x; the tables stay what they are.
  void split(std::size_t panel, double x);

 private:
  [[nodiscard]] std::size_t basis(double x, double* values) const;

  std::vector<double> edges_;
  std::vector<Expansion> expansions_;
  PumpControl control_;
  bool only_up_;
  int orders_ = 0;
};

/// The albedos a_0, a_1, … of a model that is pumped again and again.
///
/// f depends on azimuths, but D on the two cosines only: for every tabulated L, f is integrated over the azimuth of V
/// once, to a piecewise polynomial in x_V = −ln cosθ_V, and each order divides that by another factor. No BRDF is
/// evaluated again, unless a panel of the tables has to be halved. cosθ_V = cosθ_L is an edge, and so is every other
/// place where one term of the max() takes over from another.
///
/// An anisotropic model's a_k is the largest over the azimuth of L: D stays symmetric, and what isn't brightest is
/// pumped less than it could be.
class PumpSequence {
 public:
  /// Tabulates a_0.
  /// @throws ParameterError for a tolerance outside its range, for a model that doesn't claim to be reciprocal, and
  /// for one whose albedo isn't finite and positive everywhere above the horizon.
  PumpSequence(const Model& model, PumpControl control, bool only_up, double tolerance);
  ~PumpSequence();
  PumpSequence(const PumpSequence&) = delete;
  PumpSequence& operator=(const PumpSequence&) = delete;

  /// Pumps once more: tabulates the next a_k. The model must still exist.
  void advance();

  [[nodiscard]] int orders() const { return divisor().orders(); }  ///< K + 1 after K pumpings
  [[nodiscard]] const PumpDivisor& divisor() const;

  /// a_k(L), without the margin by which the table is raised.
  [[nodiscard]] double albedo(int order, double cos_theta) const;
  /// A value that a_k(L) doesn't exceed: what pumping divides by.
  [[nodiscard]] double upper(int order, double cos_theta) const;
  /// 2 ∫ a_k(μ) μ dμ over [0, 1]
  [[nodiscard]] double average(int order) const;
  /// What |albedo() − a_k| stays within, relative.
  [[nodiscard]] double relative_bound(int order) const;
  [[nodiscard]] Status status() const;             ///< converged: all orders so far meet the tolerance
  [[nodiscard]] std::int64_t evaluations() const;  ///< of the BRDF, so far
  [[nodiscard]] int rows() const;                  ///< directions L whose light has been followed

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace albedo
