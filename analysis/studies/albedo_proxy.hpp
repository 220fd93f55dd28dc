/// @file
/// The albedo over parameters and directions as a tensor of Chebyshev series, from as few integrations as it takes: a
/// table of any resolution is filled from it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "albedo/table.hpp"

namespace albedo::analysis {

/// The albedos over some axes, C order.
struct ProxySamples {
  std::vector<double> values{};
  std::size_t unconverged = 0;
  std::int64_t evaluations = 0;
};

/// Where they come from; called from several threads.
using ProxyEntries = std::function<ProxySamples(const std::vector<TableAxis>& axes)>;

struct ProxyOptions {
  double tolerance = 1e-6;                  ///< relative to the largest albedo
  std::size_t most_integrations = 200'000;  ///< for the fit
  std::size_t verified = 256;               ///< random places
  std::uint64_t seed = 1;
  int threads = 0;  ///< of the verification
};

/// How an axis becomes the variable of its series, [−1, 1] between its least and its largest value.
enum class ProxyScale {
  linear,
  logarithmic,  ///< of a positive parameter that spans a decade or more
  grazing,      ///< −ln(cosθ + c), which resolves the decades of cosθ down to c
};

/// Σ c_{ij…} T_i(u) T_j(v) …, within the box of the axes it is made for.
///
/// The tensor has 2^k + 1 Chebyshev–Lobatto points along each axis of more than one value; k grows along the axis whose
/// last coefficients are the largest, and every point that was integrated stays one of the finer grid's.
class AlbedoProxy {
 public:
  /// @param axes of the table to be filled; an axis of one value has one point
  AlbedoProxy(const std::vector<TableAxis>& axes, const ProxyEntries& entries, const ProxyOptions& options = {});

  [[nodiscard]] double operator()(const std::vector<double>& place) const;

  /// All entries over these axes, of the same names, within the box. The same bits for any number of threads.
  [[nodiscard]] std::vector<double> fill(const std::vector<TableAxis>& axes, int threads = 0) const;

  [[nodiscard]] const std::vector<std::size_t>& sizes() const { return sizes_; }  ///< coefficients along each axis
  /// The largest error at the verified places, relative to the largest albedo.
  [[nodiscard]] double error() const { return error_; }
  [[nodiscard]] double largest() const { return largest_; }  ///< albedo that was integrated for the fit
  [[nodiscard]] const std::vector<double>& worst_place() const { return worst_place_; }
  [[nodiscard]] bool is_reached() const { return is_reached_; }
  [[nodiscard]] std::size_t integrations() const { return integrations_; }  ///< with those of the verification
  [[nodiscard]] std::size_t unconverged() const { return unconverged_; }
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

 private:
  struct Variable {
    ProxyScale scale = ProxyScale::linear;
    double least = 0, largest = 0;  ///< of the axis
    double shift = 0;               ///< c of ProxyScale::grazing

    [[nodiscard]] double raw(double value) const;
    [[nodiscard]] double of(double value) const;    ///< in [−1, 1]
    [[nodiscard]] double value_at(double u) const;  ///< the inverse
  };

  void verify(const ProxyEntries& entries, const ProxyOptions& options);

  std::vector<std::string> names_;
  std::vector<Variable> variables_;
  std::vector<std::size_t> sizes_;
  std::vector<double> coefficients_;
  double error_ = 0, largest_ = 0;
  std::vector<double> worst_place_;
  bool is_reached_ = false;
  std::size_t integrations_ = 0, unconverged_ = 0;
  std::int64_t evaluations_ = 0;
};

}  // namespace albedo::analysis
