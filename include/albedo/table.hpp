#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "albedo/directional_albedo.hpp"

namespace albedo {

/// One axis of a table: a numeric parameter (or shorthand) of the model, or `cos_theta` (cosine of L's polar angle),
/// `theta` (degrees) or `phi` (degrees).
struct TableAxis {
  std::string name;
  std::vector<double> values;
};

struct TableOptions {
  AlbedoOptions albedo{};
  int threads = 0;           ///< 0: as many as OpenMP would use
  bool keep_errors = false;  ///< keep every entry's error too
  int verified_cells = 256;  ///< cells at whose centre linear interpolation is compared with the albedo; 0 for none
  /// What becomes of a model before its albedo is integrated, such as pumping; nothing if it is empty. Called from any
  /// thread, once for each set of parameters.
  std::function<std::unique_ptr<Model>(std::unique_ptr<Model>)> correction{};
  std::function<void(std::size_t done, std::size_t total)>
      progress{};  ///< called from the constructor's thread, 10 times a second at most
};

/// The albedo over a grid of parameters and directions, filled in parallel. The same bits for any number of threads.
///
/// It takes its own size (8 bytes an entry, 16 with errors); an infinite albedo (grazing incidence of a divergent
/// model) is +infinity.
class AlbedoTable {
 public:
  /// @param fixed the parameters that no axis varies
  /// @param axes  one of them `cos_theta` or `theta`
  /// @throws UnknownModel, ParameterError (also for any axis value outside its parameter's range, before anything is
  /// computed)
  AlbedoTable(const std::string& model, const Parameters& fixed, std::vector<TableAxis> axes,
              const TableOptions& options = {});

  [[nodiscard]] const std::vector<TableAxis>& axes() const { return axes_; }
  [[nodiscard]] const std::vector<double>& values() const {
    return values_;
  }  ///< C order: the last axis is the fastest
  [[nodiscard]] const std::vector<double>& errors() const { return errors_; }  ///< empty unless asked for

  [[nodiscard]] double worst_error() const { return worst_error_; }  ///< largest absolute error of a finite entry
  [[nodiscard]] std::size_t worst_entry() const { return worst_entry_; }
  [[nodiscard]] double interpolation_error() const {
    return interpolation_error_;
  }  ///< largest met at the verified cells, absolute
  [[nodiscard]] std::size_t unconverged() const { return unconverged_; }  ///< entries that missed the tolerance
  [[nodiscard]] std::size_t divergent() const { return divergent_; }      ///< infinite entries
  [[nodiscard]] std::int64_t evaluations() const {
    return evaluations_;
  }  ///< of the BRDF, with those spent on verification

 private:
  std::vector<TableAxis> axes_;
  std::vector<double> values_, errors_;
  double worst_error_ = 0, interpolation_error_ = 0;
  std::size_t worst_entry_ = 0, unconverged_ = 0, divergent_ = 0;
  std::int64_t evaluations_ = 0;
};

}  // namespace albedo
