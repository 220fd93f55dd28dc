#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "albedo/directional_albedo.hpp"

namespace albedo {

/// One axis of a table: numbers, or names. Directions are `cos_theta` (cosine of L's polar angle), `theta` (degrees)
/// and `phi` (degrees); whatever else varies is the model.
struct TableAxis {
  std::string name{};
  std::vector<double> values{};
  std::vector<std::string> labels{};  ///< not empty: a categorical axis, whose values are not looked at
  std::string unit{};                 ///< for readers

  [[nodiscard]] bool is_categorical() const { return !labels.empty(); }
  [[nodiscard]] std::size_t size() const { return is_categorical() ? labels.size() : values.size(); }
  /// The number at a place on the axis; of a name it is the place itself.
  [[nodiscard]] double number(std::size_t index) const {
    return is_categorical() ? static_cast<double>(index) : values[index];
  }
};

/// The entries of a table over these axes; none overflows unless memory has not so many addresses.
[[nodiscard]] std::size_t entry_count(const std::vector<TableAxis>& axes);

struct TableOptions {
  AlbedoOptions albedo{};
  int threads = 0;           ///< 0: as many as OpenMP would use
  bool keep_errors = false;  ///< keep every entry's error too
  /// Cells at whose centre linear interpolation is compared with the albedo, for each combination of names; 0 for none.
  int verified_cells = 256;
  /// What becomes of a model that is given by name before its albedo is integrated, such as pumping; nothing if it is
  /// empty. Called from any thread, once for each set of parameters.
  std::function<std::unique_ptr<Model>(std::unique_ptr<Model>)> correction{};
  std::function<void(std::size_t done, std::size_t total)>
      progress{};  ///< called from the constructor's thread, 10 times a second at most
};

/// What is known of some entries of a table without the entries themselves. Tallies of disjoint parts may be merged in
/// any order: the result is the same.
struct TableTally {
  double worst_error = -1;  ///< largest absolute error of a finite entry; negative if there is none
  std::size_t worst_entry = 0;
  std::size_t unconverged = 0;   ///< entries that missed the tolerance
  std::size_t divergent = 0;     ///< infinite entries
  std::int64_t evaluations = 0;  ///< of the BRDF

  void add(std::size_t entry, const Estimate& estimate);
  void merge(const TableTally& other);
};

class TableSource;

/// The albedo over a grid of parameters and directions, filled in parallel. The same bits for any number of threads.
///
/// It takes its own size (8 bytes an entry, 16 with errors); an infinite albedo (grazing incidence of a divergent
/// model) is +infinity.
class AlbedoTable {
 public:
  /// @param fixed the parameters that no axis varies
  /// @param axes  one of them `cos_theta` or `theta`; numeric parameters (or shorthands), and choices by their names
  /// @throws UnknownModel, ParameterError (also for any axis value outside its parameter's range, before anything is
  /// computed)
  AlbedoTable(const std::string& model, const Parameters& fixed, std::vector<TableAxis> axes,
              const TableOptions& options = {});

  /// All entries of a source.
  explicit AlbedoTable(const TableSource& source);

  [[nodiscard]] const std::vector<TableAxis>& axes() const { return axes_; }
  /// C order: the last axis is the fastest.
  [[nodiscard]] const std::vector<double>& values() const& { return values_; }
  [[nodiscard]] std::vector<double> values() && { return std::move(values_); }
  /// Empty unless asked for.
  [[nodiscard]] const std::vector<double>& errors() const& { return errors_; }
  [[nodiscard]] std::vector<double> errors() && { return std::move(errors_); }

  /// What is known of the entries, without what their verification took.
  [[nodiscard]] const TableTally& tally() const { return tally_; }
  /// Largest absolute error of a finite entry; 0 if there is none.
  [[nodiscard]] double worst_error() const { return std::max(tally_.worst_error, 0.0); }
  [[nodiscard]] std::size_t worst_entry() const { return tally_.worst_entry; }
  /// The largest met at the verified cells, absolute.
  [[nodiscard]] double interpolation_error() const { return interpolation_error_; }
  [[nodiscard]] std::size_t unconverged() const { return tally_.unconverged; }  ///< entries that missed the tolerance
  [[nodiscard]] std::size_t divergent() const { return tally_.divergent; }      ///< infinite entries
  /// Of the BRDF, with those spent on verification.
  [[nodiscard]] std::int64_t evaluations() const { return tally_.evaluations + verification_; }

 private:
  std::vector<TableAxis> axes_;
  std::vector<double> values_, errors_;
  TableTally tally_;
  double interpolation_error_ = 0;
  std::int64_t verification_ = 0;
};

}  // namespace albedo
