/// @file
/// The albedos of a list of materials, channel by channel.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "albedo/table_source.hpp"
#include "analysis/subjects/materials.hpp"

namespace albedo::analysis {

/// R, G and B or, if no parameter of any material is an array, "all".
std::vector<std::string> channels_of(const std::vector<Material>& materials);

/// A material in one of the channels. @throws FormatError naming `file` and the line of the material
std::unique_ptr<Model> make_material(const Material& material, std::size_t channel, const std::string& file);

/// The models of material × channel, for tables over them and a direction.
class MaterialModels {
 public:
  /// @throws FormatError naming `file` and the line of a material whose model or parameters are wrong
  MaterialModels(const std::vector<Material>& materials, const std::string& file);

  /// The labels of materials and channels.
  [[nodiscard]] const std::vector<TableAxis>& axes() const { return axes_; }

  /// Makes another one of every model, in parallel.
  void correct(const std::function<std::unique_ptr<Model>(std::unique_ptr<Model>)>& correction, int threads);

  /// material × channel × direction. It shares the models.
  /// @param directions `theta` in degrees or `cos_theta`
  /// @throws ParameterError for a direction outside its range
  [[nodiscard]] TableSource source(const TableAxis& directions, double phi, const TableOptions& options) const;

 private:
  std::vector<TableAxis> axes_;
  std::shared_ptr<std::vector<std::unique_ptr<Model>>> rows_;  // material by material, channel by channel
};

/// The gaps between neighbouring directions of such a table where interpolation is measured: at most so many, spread
/// over all materials.
[[nodiscard]] std::vector<TableSource::Cell> material_cells(const TableSource& source, std::size_t most);

}  // namespace albedo::analysis
