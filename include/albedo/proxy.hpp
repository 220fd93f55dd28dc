/// @file
/// The albedo over parameters and directions as a tensor of Chebyshev series, from as few integrations as it takes: a
/// table of any resolution is filled from it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "albedo/core/proxy_variable.hpp"
#include "albedo/table.hpp"

namespace albedo {

/// The albedos at some places.
struct ProxySamples {
  std::vector<double> values{};
  std::vector<double> errors{};  ///< what is claimed of each, absolute
  std::int64_t evaluations = 0;
};

/// Where they come from. The places follow one another: a value for each axis, then those of the next place.
using ProxyEntries = std::function<ProxySamples(const std::vector<double>& places)>;

struct ProxyOptions {
  double tolerance = 1e-6;                    ///< relative to the largest albedo
  std::size_t most_integrations = 5'000'000;  ///< for one fit
  std::size_t verified = 250;                 ///< random places
  std::uint64_t seed = 1;
  int threads = 0;
};

/// Σ c_{ij…} T_i(u) T_j(v) …, within the box of the axes it is made for.
///
/// A few lines along each axis, at the corners and the centre of the others, tell which variable needs the fewest terms
/// and how many: so many Chebyshev–Lobatto points the tensor gets along that axis. An axis of no more values than that
/// (and one with a kink, which no series ends for) is held by its own values, and the proxy is known at these only: a
/// proxy takes no more integrations for its tensor than the table has entries.
///
/// Then it is compared with integrations at random places, half of them spread evenly over the axes, half over the
/// variables. Where it misses the tolerance its shortest series grow, and it is verified at new places.
class AlbedoProxy {
 public:
  /// Entries of a table over any axes of the same names within the box; those that are held by their values take these
  /// only. The proxy must outlive it; a copy shares all but what it remembers of the last row, for another thread.
  class Filler {
   public:
    /// @throws ParameterError for a value that isn't held or is outside of the box, or another number of axes
    Filler(const AlbedoProxy& proxy, const std::vector<TableAxis>& axes);

    [[nodiscard]] std::size_t size() const { return size_; }  ///< entries
    /// The entries from number `first` on (C order: the last axis is the fastest). Their bits don't depend on how a
    /// table is cut into runs: whole rows of the last axis are computed, and the last one is kept.
    void fill(std::size_t first, std::span<double> entries);

   private:
    /// What an axis does: a matrix of `rows` × `columns` (transposed for the last axis), or a choice of columns.
    struct Factor {
      std::size_t rows, columns;
      std::vector<double> matrix{};
      std::vector<std::size_t> chosen{};
    };

    void compute(std::size_t row);

    const AlbedoProxy* proxy_;
    std::shared_ptr<const std::vector<Factor>> factors_;
    std::size_t size_ = 1;
    std::optional<std::size_t> row_;
    std::vector<std::vector<double>> partial_;  ///< the tensor with the first axis summed, the first two, …; the row
  };

  /// @param axes of the table to be filled
  /// @throws ParameterError if a tensor would take more than most_integrations, an axis has no values, or the tolerance
  /// is not within (0, 1)
  AlbedoProxy(const std::vector<TableAxis>& axes, const ProxyEntries& entries, const ProxyOptions& options = {});

  [[nodiscard]] double operator()(const std::vector<double>& place) const;

  /// All entries over these axes. The same bits for any number of threads.
  [[nodiscard]] std::vector<double> fill(const std::vector<TableAxis>& axes, int threads = 0) const;

  [[nodiscard]] std::vector<std::size_t> sizes() const;  ///< points along each axis
  /// Whether an axis is a series, and not held by its values.
  [[nodiscard]] bool is_series(std::size_t axis) const { return axes_[axis].variable.has_value(); }
  /// The largest error, relative to the largest albedo: what was found at the verified places and what the integrations
  /// there claim of themselves, or what those of the tensor do.
  [[nodiscard]] double error() const { return error_; }
  [[nodiscard]] double largest() const { return largest_; }  ///< albedo that was integrated for the fit
  [[nodiscard]] const std::vector<double>& worst_place() const { return worst_place_; }  ///< none if none was verified
  [[nodiscard]] double tolerance() const { return tolerance_; }
  [[nodiscard]] bool is_reached() const { return error_ <= tolerance_; }
  /// Places; 0 if nothing is a series, or the integrations miss the tolerance.
  [[nodiscard]] std::size_t verified() const { return verified_; }
  [[nodiscard]] std::size_t integrations() const { return integrations_; }  ///< with those of the verification
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

 private:
  struct AxisOfProxy {
    std::string name{};
    std::vector<double> values{};  ///< of the table
    std::size_t size = 1;
    std::optional<ProxyVariable> variable{};  ///< none: held by the values
    [[nodiscard]] std::vector<double> points() const;
  };

  static void hold(AxisOfProxy& axis);
  ProxySamples integrate(const std::vector<double>& places, const ProxyEntries& entries);
  [[nodiscard]] bool is_elliptic(std::size_t axis, const ProxyEntries& entries);
  void look_along_axes(const ProxyEntries& entries);
  void look_along(std::size_t axis, const std::vector<std::vector<double>>& lines,
                  const std::vector<ProxyVariable>& candidates, double share, const ProxyEntries& entries);
  void fit(const ProxyEntries& entries);
  void verify(const ProxyEntries& entries, const ProxyOptions& options, std::uint64_t seed);
  [[nodiscard]] bool grow(std::size_t most);

  std::vector<AxisOfProxy> axes_;
  std::vector<double> coefficients_;
  double tolerance_, error_ = 0, largest_ = 0;
  std::vector<double> worst_place_;
  std::size_t verified_ = 0, integrations_ = 0;
  std::int64_t evaluations_ = 0;
};

}  // namespace albedo
