#include "analysis/subjects/material_table.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <functional>
#include <numeric>

#include "albedo/combinators/sum.hpp"
#include "albedo/core/errors.hpp"
#include "numerics/larger.hpp"

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
    throw FormatError("'" + file + "', line " + std::to_string(material.line) + ": " + error.what());
  }
}

namespace {

Direction direction_at(const std::string& axis, double place, double phi) {
  return axis == "theta" ? Direction::from_degrees(place, phi) : Direction::from_cosine(place, phi);
}

/// Calls work(0) to work(count − 1) in parallel, and carries an exception out.
void parallel_for(std::size_t count, const TableOptions& options, const std::function<void(std::size_t)>& work) {
  std::exception_ptr failure;
  std::atomic<std::size_t> done = 0;
#pragma omp parallel for schedule(dynamic) num_threads(options.threads > 0 ? options.threads : omp_get_max_threads())
  for (std::size_t i = 0; i < count; ++i) {
    try {
      work(i);
      const std::size_t so_far = ++done;
      if (options.progress && omp_get_thread_num() == 0) options.progress(so_far, count);
    } catch (...) {
#pragma omp critical(albedo_material_table)
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

/// At most `wanted` of the gaps 0 to count − 1, evenly spread.
std::vector<std::size_t> spread(std::size_t count, std::size_t wanted) {
  std::vector<std::size_t> chosen(std::min(count, wanted));
  for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = i * count / chosen.size();
  return chosen;
}

}  // namespace

MaterialTable::MaterialTable(const std::vector<Material>& materials, const std::string& file) {
  Axis names{.name = "material"}, channels{.name = "channel", .labels = channels_of(materials)};
  for (const Material& material : materials) {
    names.labels.push_back(material.name);
    for (std::size_t channel = 0; channel < channels.size(); ++channel)
      rows_.push_back(make_material(material, channel, file));
  }
  label_axes_ = {std::move(names), std::move(channels)};
}

void MaterialTable::fill(const TableAxis& directions, double phi, const TableOptions& options) {
  const std::size_t columns = directions.values.size();
  std::vector<Direction> lights;
  for (const double place : directions.values) lights.push_back(direction_at(directions.name, place, phi));

  if (options.correction) {
    parallel_for(rows_.size(), options, [&](std::size_t i) { rows_[i] = options.correction(std::move(rows_[i])); });
  }
  std::vector<Estimate> estimates(rows_.size() * columns);
  parallel_for(estimates.size(), options, [&](std::size_t i) {
    estimates[i] = directional_albedo(*rows_[i / columns], lights[i % columns], options.albedo);
  });
  values_.resize(estimates.size());
  if (options.keep_errors) errors_.resize(estimates.size());
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const Estimate& estimate = estimates[i];
    values_[i] = estimate.value;
    if (options.keep_errors) errors_[i] = estimate.error;
    evaluations_ += estimate.evaluations;
    if (estimate.status == Status::divergent) {
      ++divergent_;
      continue;
    }
    if (estimate.status != Status::converged) ++unconverged_;
    keep_larger(worst_error_, estimate.error);
  }

  const std::size_t gaps_in_row = columns - 1;
  const std::vector<std::size_t> gaps =
      spread(rows_.size() * gaps_in_row, static_cast<std::size_t>(std::max(options.verified_cells, 0)));
  std::vector<double> misses(gaps.size());
  TableOptions quietly = options;
  quietly.progress = nullptr;
  parallel_for(gaps.size(), quietly, [&](std::size_t i) {
    const std::size_t row = gaps[i] / gaps_in_row, left = gaps[i] % gaps_in_row;
    const double middle = std::midpoint(directions.values[left], directions.values[left + 1]);
    const double linear = std::midpoint(values_[row * columns + left], values_[row * columns + left + 1]);
    if (!std::isfinite(linear)) return;  // nobody interpolates towards infinity
    misses[i] = std::abs(
        directional_albedo(*rows_[row], direction_at(directions.name, middle, phi), options.albedo).value - linear);
  });
  for (const double miss : misses) interpolation_error_ = std::max(interpolation_error_, miss);
}

}  // namespace albedo::analysis
