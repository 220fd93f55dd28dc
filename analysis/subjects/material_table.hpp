/// @file
/// The albedos of a list of materials, channel by channel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "albedo/table.hpp"
#include "analysis/files/table_document.hpp"
#include "analysis/subjects/materials.hpp"

namespace albedo::analysis {

/// R, G and B or, if no parameter of any material is an array, "all".
std::vector<std::string> channels_of(const std::vector<Material>& materials);

/// A material in one of the channels. @throws FormatError naming `file` and the line of the material
std::unique_ptr<Model> make_material(const Material& material, std::size_t channel, const std::string& file);

/// material × channel × direction.
class MaterialTable {
 public:
  /// @throws FormatError naming `file` and the line of a material whose model or parameters are wrong
  MaterialTable(const std::vector<Material>& materials, const std::string& file);

  /// The labels of materials and channels.
  [[nodiscard]] const std::vector<Axis>& label_axes() const { return label_axes_; }

  /// Computes in parallel, with the same bits for any number of threads. Whether linear interpolation between
  /// neighbouring directions is good is measured in `options.verified_cells` gaps.
  /// @param directions `theta` in degrees or `cos_theta`
  /// @throws ParameterError for a direction outside its range, before anything is computed
  void fill(const TableAxis& directions, double phi, const TableOptions& options);

  [[nodiscard]] const std::vector<double>& values() const { return values_; }  ///< C order
  [[nodiscard]] const std::vector<double>& errors() const { return errors_; }  ///< empty unless asked for
  [[nodiscard]] double worst_error() const { return worst_error_; }  ///< largest absolute error of a finite entry
  [[nodiscard]] double interpolation_error() const { return interpolation_error_; }  ///< largest met, absolute
  [[nodiscard]] std::size_t unconverged() const { return unconverged_; }
  [[nodiscard]] std::size_t divergent() const { return divergent_; }
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

 private:
  std::vector<Axis> label_axes_;
  std::vector<std::unique_ptr<Model>> rows_;  // material by material, channel by channel
  std::vector<double> values_, errors_;
  double worst_error_ = 0, interpolation_error_ = 0;
  std::size_t unconverged_ = 0, divergent_ = 0;
  std::int64_t evaluations_ = 0;
};

}  // namespace albedo::analysis
