#include "analysis/subjects/material_table.hpp"

#include <algorithm>

#include "albedo/combinators/sum.hpp"
#include "albedo/core/errors.hpp"
#include "core/text.hpp"
#include "numerics/parallel.hpp"

namespace albedo::analysis {
namespace {

using Channels = std::array<double, 3>;

/// The choice of a channel that a material leaves open, or nullptr; also for a model that there isn't.
const ParameterInfo* open_channel(const Material& material) {
  for (const ModelInfo& info : model_infos()) {
    if (info.name != material.model || info.channel() == nullptr) continue;
    const bool is_given =
        std::ranges::any_of(material.parameters, [&](const auto& p) { return p.first == info.channel()->name; });
    return is_given ? nullptr : info.channel();
  }
  return nullptr;
}

bool is_rgb(const Material& material) {
  const auto is_array = [](const ParameterValue& value) { return std::holds_alternative<Channels>(value); };
  return open_channel(material) != nullptr || is_array(material.scale) || is_array(material.lambertian) ||
         std::ranges::any_of(material.parameters, [&](const auto& p) { return is_array(p.second); });
}

albedo::ParameterValue value_in_channel(const ModelInfo& info, const std::string& name, const ParameterValue& value,
                                        std::size_t channel) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* number = std::get_if<double>(&value)) return *number;
  for (const std::string& parameter : info.resolve(name)) {
    if (!info.find(parameter)->per_channel) {
      throw ParameterError(info.name + ": " + name + " is one number for all channels and can't be an array");
    }
  }
  return std::get<Channels>(value)[channel];
}

double number_in_channel(const ParameterValue& value, std::size_t channel) {
  if (const auto* channels = std::get_if<Channels>(&value)) return (*channels)[channel];
  return std::get<double>(value);
}

/// The model itself where nothing is added to it, else a sum that goes by its name.
std::unique_ptr<Model> with_lambertian(std::unique_ptr<Model> model, double scale, double lambertian) {
  if (scale == 1 && lambertian == 0) return model;
  ModelInfo info = model->info();
  info.parameters.clear(), info.shorthands.clear();
  std::vector<SumModel::Part> parts(2);
  parts[0] = {scale, std::move(model)};
  parts[1].model = make_model("lambert", {{"rho", lambertian}});
  return std::make_unique<SumModel>(std::move(parts), std::move(info));
}

}  // namespace

std::vector<std::string> channels_of(const std::vector<Material>& materials) {
  if (std::ranges::any_of(materials, is_rgb)) return {"R", "G", "B"};
  return {"all"};
}

std::unique_ptr<Model> make_material(const Material& material, std::size_t channel, const std::string& file) {
  try {
    const ModelInfo& info = model_info(material.model);
    Parameters parameters;
    for (const auto& [name, value] : material.parameters) {
      parameters.emplace_back(name, value_in_channel(info, name, value, channel));
    }
    if (const ParameterInfo* open = open_channel(material)) parameters.emplace_back(open->name, open->choices[channel]);
    return with_lambertian(make_model(material.model, parameters), number_in_channel(material.scale, channel),
                           number_in_channel(material.lambertian, channel));
  } catch (const Error& error) {
    throw FormatError(fmt::format("'{}', line {}: {}", file, material.line, error.what()));
  }
}

MaterialModels::MaterialModels(const std::vector<Material>& materials, const std::string& file)
    : axes_{{.name = "material"}, {.name = "channel", .labels = channels_of(materials)}},
      rows_(std::make_shared<std::vector<std::unique_ptr<Model>>>()) {
  for (const Material& material : materials) {
    axes_[0].labels.push_back(material.name);
    for (std::size_t channel = 0; channel < axes_[1].size(); ++channel)
      rows_->push_back(make_material(material, channel, file));
  }
}

void MaterialModels::correct(const std::function<std::unique_ptr<Model>(std::unique_ptr<Model>)>& correction,
                             int threads) {
  in_parallel(rows_->size(), threads, [&](std::size_t i) { (*rows_)[i] = correction(std::move((*rows_)[i])); });
}

TableSource MaterialModels::source(const TableAxis& directions, double phi, const TableOptions& options) const {
  const auto row = [rows = rows_, channels = axes_[1].size()](const std::vector<double>& place) {
    const std::size_t i = static_cast<std::size_t>(place[0]) * channels + static_cast<std::size_t>(place[1]);
    return std::shared_ptr<const Model>(rows, (*rows)[i].get());
  };
  return {row, {axes_[0], axes_[1], directions, {.name = "phi", .values = {phi}}}, options};
}

std::vector<TableSource::Cell> material_cells(const TableSource& source, std::size_t most) {
  const std::vector<TableAxis>& axes = source.axes();
  const std::size_t channels = axes[1].size(), gaps = axes[2].size() - 1, count = axes[0].size() * channels * gaps;
  std::vector<TableSource::Cell> cells(std::min(count, most));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t gap = i * count / cells.size(), row = gap / gaps;
    cells[i] = {row / channels, row % channels, gap % gaps, 0};
  }
  return cells;
}

}  // namespace albedo::analysis
