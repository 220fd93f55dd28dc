#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "albedo/pumping.hpp"
#include "pumping/azimuth_integral.hpp"

namespace albedo {

/// A direction L and where its light goes: ∫ f dφ_V cos²θ_V over x_V = −ln cosθ_V as a polynomial per panel, so that
/// a_k(L) = ∫ that / D_k dx_V for any divisor of cosines, at nodes that no longer ask for the BRDF.
class KernelRow {
 public:
  /// What f(L,V) may be divided by, at least.
  enum class Least {
    nearer,  ///< the cosine of whichever of L and V is nearer to N: pumping
    viewer,  ///< cosθ_V: a function of V alone
  };

  /// @param azimuth of L, in degrees
  /// @param tolerance of a_k, relative
  KernelRow(const Model& model, double x_l, double azimuth, double tolerance, Least least = Least::nearer);

  /// Divides by the next factor of D, whose order() + 1 first tables must be known.
  void advance(const PumpDivisor& divisor);

  struct Sum {
    double value, error;  ///< absolute
  };
  /// a(L) with f divided by the last of the tables at V: ∫ f / s(V) cosθ_V dω_V.
  Sum divided_by(const CosineTables& s);

  [[nodiscard]] int order() const { return order_; }
  [[nodiscard]] double value() const { return value_; }  ///< a_k(L), coherent part included
  [[nodiscard]] double error() const { return error_; }  ///< absolute
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }
  [[nodiscard]] std::size_t panels() const { return panels_.size(); }

 private:
  static constexpr int nodes = 16;
  using Values = std::array<double, nodes>;

  struct Panel {
    double begin, end;
    double error = 0;  ///< of the integral of `flux`
    Values flux{};     ///< ∫ f dφ_V cos²θ_V
    Values log_d{};

    [[nodiscard]] double width() const { return end - begin; }
    /// Nodes i … i + block_width − 1.
    [[nodiscard]] Block places(std::size_t i) const;
    double sum = 0, doubt = 0;  ///< of flux / D, and its last coefficients
  };

  void integrate(AzimuthIntegral& flux);
  [[nodiscard]] std::vector<double> first_edges(const AzimuthIntegral& flux) const;
  Panel evaluated(AzimuthIntegral& flux, double begin, double end);
  /// The part of a panel between two of its places, without D.
  [[nodiscard]] static Panel part_of(const Panel& panel, double begin, double end);
  void divide(std::size_t panel, double x);
  void divide(std::size_t panel, double x, const PumpDivisor& divisor);
  [[nodiscard]] int branch(const PumpDivisor& divisor, double x_v, double log_v) const;
  void divide_at_kinks(const PumpDivisor& divisor);
  [[nodiscard]] double least_divisor(double x_v) const {
    return std::exp(-(least_ == Least::viewer ? x_v : std::min(x_l_, x_v)));
  }
  static void weigh(Panel& panel);
  void conclude();

  double x_l_, tolerance_;
  Least least_;
  double same_;  ///< of ln a: what differs by less makes no kinks
  int order_ = 0;
  double coherent_ = 0, coherent_log_d_ = 0;
  double log_l_ = 0;  ///< ln a_k's bound at L, of the order that is divided by
  std::vector<Panel> panels_;
  double largest_ = 0;  ///< flux met so far
  double value_ = 0, error_ = 0;
  std::int64_t evaluations_ = 0;
};

}  // namespace albedo
