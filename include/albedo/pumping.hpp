#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "albedo/core/estimate.hpp"
#include "albedo/core/model.hpp"
#include "albedo/cosine_tables.hpp"

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

/// D_K(L,V) = g_1 g_2 … g_K, by which K pumpings divide f, from tables of the a_k. Every table is raised by its error,
/// so that it bounds a_k from above.
class PumpDivisor {
 public:
  PumpDivisor(PumpControl control, bool only_up) : control_(control), only_up_(only_up) {}

  [[nodiscard]] int orders() const { return albedos.count(); }
  [[nodiscard]] PumpControl control() const { return control_; }
  [[nodiscard]] bool only_up() const { return only_up_; }

  /// ln of the tabulated bound of a_k.
  [[nodiscard]] double log_albedo(int order, double x) const { return albedos.log(order, x); }

  /// ln D after the step that follows `before`, from the two bounds; T is double or Block.
  template <class T>
  [[nodiscard]] T step(const T& before, double log_l, const T& log_v, double x_l, const T& x_v) const {
    const T floor = -min(T(x_l), x_v);
    T g = max(T(log_l), log_v);
    if (control_ == PumpControl::step) g = max(g, floor);
    if (only_up_) g = min(g, T(0));
    const T after = before + g;
    return control_ == PumpControl::total ? max(after, floor) : after;
  }

  /// ln D_k of the first k orders, k ≤ orders().
  [[nodiscard]] double log_divisor(int k, double x_l, double x_v) const;

  CosineTables albedos{};  ///< the bounds of a_0, a_1, …

 private:
  PumpControl control_;
  bool only_up_;
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
  /// @throws ParameterError for an albedo that vanishes at grazing incidence
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
