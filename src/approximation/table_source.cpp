#include "albedo/table_source.hpp"

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <map>
#include <mutex>

#include "albedo/core/errors.hpp"
#include "albedo/core/suggestion.hpp"
#include "albedo/registry.hpp"
#include "core/text.hpp"
#include "numerics/parallel.hpp"

namespace albedo {
namespace {

bool is_polar(const std::string& name) { return name == "cos_theta" || name == "theta"; }
bool is_direction(const std::string& name) { return is_polar(name) || name == "phi"; }

/// The parameters that a name of an axis sets; a direction's name stands for itself.
std::vector<std::string> set_by(const ModelInfo& info, const TableAxis& axis) {
  if (is_direction(axis.name)) return {axis.name};
  std::vector<std::string> names = info.resolve(axis.name);
  if (!names.empty()) return names;
  std::vector<std::string> candidates{"cos_theta", "theta", "phi"};
  for (const ParameterInfo& parameter : info.parameters) candidates.push_back(parameter.name);
  for (const Shorthand& shorthand : info.shorthands) candidates.push_back(shorthand.name);
  const std::string close = suggestion(axis.name, candidates);
  throw ParameterError(fmt::format("{} has no parameter '{}' for an axis{}", info.name, axis.name,
                                   close.empty() ? "" : fmt::format("; did you mean '{}'?", close)));
}

void check_values(const std::string& subject, const TableAxis& axis, const Range& range) {
  for (const double value : axis.values) {
    if (range.contains(value)) continue;
    throw ParameterError(fmt::format("{} is {:g} on its axis and must be within [{:g}, {:g}]", subject, value,
                                     range.minimum, range.maximum));
  }
}

void check_direction(const TableAxis& axis) {
  if (axis.is_categorical()) throw ParameterError(axis.name + " is a direction and its axis holds numbers, not names");
  if (axis.name == "cos_theta") check_values("cos_theta", axis, {0, 1});
  if (axis.name == "theta") check_values("theta", axis, {0, 90});
  if (axis.name == "phi") {
    check_values("phi", axis, {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()});
  }
}

/// Throws unless the axes have values, set nothing twice and give L a polar angle.
void check(const std::vector<TableAxis>& axes) {
  const std::string* polar = nullptr;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::string& name = axes[i].name;
    if (axes[i].size() == 0) throw ParameterError(fmt::format("the axis '{}' has no values", name));
    if (is_direction(name)) check_direction(axes[i]);
    for (std::size_t k = 0; k < i; ++k) {
      if (axes[k].name != name) continue;
      throw ParameterError(fmt::format("{} is varied twice, by the axes '{}' and '{}'", name, name, name));
    }
    if (!is_polar(name)) continue;
    if (polar != nullptr) throw ParameterError("the axes 'cos_theta' and 'theta' exclude each other");
    polar = &name;
  }
  if (polar == nullptr) throw ParameterError("a table needs an axis 'cos_theta' or 'theta'");
}

void check_parameter(const ModelInfo& info, const TableAxis& axis) {
  for (const std::string& name : set_by(info, axis)) {
    const ParameterInfo& parameter = *info.find(name);
    if (parameter.is_choice() && !axis.is_categorical()) {
      throw ParameterError(info.name + ": " + name + " is a choice of names and can't be an axis of numbers");
    }
    if (!axis.is_categorical()) {
      check_values(info.name + ": " + name, axis, parameter.range);
    } else if (!parameter.is_text) {
      for (const std::string& label : axis.labels) detail::checked_value(info, parameter, label);
    }
  }
}

/// Throws unless the axes vary parameters that the model has, within their ranges, and that are neither fixed nor
/// varied twice.
void check(const ModelInfo& info, const Parameters& fixed, const std::vector<TableAxis>& axes) {
  std::vector<std::pair<std::string, std::string>> set;  // parameter, axis
  for (const TableAxis& axis : axes) {
    for (const std::string& name : set_by(info, axis)) {
      const auto same = std::ranges::find(set, name, &std::pair<std::string, std::string>::first);
      if (same != set.end()) {
        throw ParameterError(
            fmt::format("{} is varied twice, by the axes '{}' and '{}'", name, same->second, axis.name));
      }
      set.emplace_back(name, axis.name);
    }
    if (!is_direction(axis.name)) check_parameter(info, axis);
  }
  for (const auto& [given, value] : fixed) {
    for (const std::string& name : info.resolve(given)) {
      const auto same = std::ranges::find(set, name, &std::pair<std::string, std::string>::first);
      if (same == set.end()) continue;
      throw ParameterError(fmt::format("{} is fixed by '{}' and varied by the axis '{}'", name, given, same->second));
    }
  }
  make_model(info.name, fixed);
}

/// The model of that name, with what the axes vary.
TableModels models_of(const std::string& model, Parameters fixed, const std::vector<TableAxis>& axes,
                      const TableOptions& options) {
  const ModelInfo& info = model_info(model);
  check(info, fixed, axes);
  std::vector<TableAxis> varied = axes;
  std::erase_if(varied, [](const TableAxis& axis) { return is_direction(axis.name); });
  auto make = [&info, fixed = std::move(fixed), varied = std::move(varied)](const std::vector<double>& place) {
    Parameters parameters = fixed;
    for (std::size_t i = 0; i < varied.size(); ++i) {
      if (varied[i].is_categorical()) {
        parameters.emplace_back(varied[i].name, varied[i].labels[static_cast<std::size_t>(place[i])]);
      } else {
        parameters.emplace_back(varied[i].name, place[i]);
      }
    }
    return make_model(info.name, parameters);
  };
  if (!options.correction) return make;
  return kept([make = std::move(make), correction = options.correction](const std::vector<double>& place) {
    return correction(make(place));
  });
}

TableOptions without_correction(TableOptions options) {
  options.correction = nullptr;
  return options;
}

/// Cells of numeric axes: all of them, or `most` by an additive recurrence that spreads over every axis alike
/// [Roberts 2018].
std::vector<TableSource::Cell> spread_cells(const std::vector<std::size_t>& sizes, std::size_t most) {
  std::vector<std::size_t> counts;  // of cells along each axis; an axis of one value has no extent
  std::size_t cells = 1;
  bool is_extended = false;
  for (const std::size_t size : sizes) {
    counts.push_back(std::max<std::size_t>(size - 1, 1));
    cells *= counts.back();
    is_extended = is_extended || size > 1;
  }
  if (!is_extended) return {};
  const bool takes_all = cells <= most;
  std::vector<TableSource::Cell> chosen(takes_all ? cells : most, TableSource::Cell(sizes.size()));
  double ratio = 2;  // the root of ratio^(d+1) = ratio + 1
  for (int step = 0; step < 64; ++step) ratio = std::pow(1 + ratio, 1 / (static_cast<double>(sizes.size()) + 1));
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    std::size_t rest = k;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const double turns = static_cast<double>(k + 1) * std::pow(ratio, -static_cast<double>(i + 1));
      const auto spread = static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(counts[i]));
      chosen[k][i] = takes_all ? rest % counts[i] : std::min(spread, counts[i] - 1);
      rest /= counts[i];
    }
  }
  return chosen;
}

/// So many cells of the numeric axes for each combination of names.
std::vector<TableSource::Cell> verified_cells(const std::vector<TableAxis>& axes, std::size_t most) {
  std::vector<std::size_t> sizes;
  for (const TableAxis& axis : axes) {
    if (!axis.is_categorical()) sizes.push_back(axis.size());
  }
  const std::vector<TableSource::Cell> numeric = spread_cells(sizes, most);
  std::size_t combinations = 1;
  for (const TableAxis& axis : axes) combinations *= axis.is_categorical() ? axis.size() : 1;
  std::vector<TableSource::Cell> cells;
  for (std::size_t combination = 0; combination < combinations; ++combination) {
    for (const TableSource::Cell& of_numbers : numeric) {
      TableSource::Cell& cell = cells.emplace_back(axes.size());
      std::size_t rest = combination, next = of_numbers.size();
      for (std::size_t i = axes.size(); i-- > 0;) {
        if (!axes[i].is_categorical()) {
          cell[i] = of_numbers[--next];
          continue;
        }
        cell[i] = rest % axes[i].size();
        rest /= axes[i].size();
      }
    }
  }
  return cells;
}

/// The mean of the table over the corners of a cell, which is what multilinear interpolation gives at its centre, and
/// the centre.
double at_centre(const std::vector<TableAxis>& axes, const std::function<double(std::size_t)>& value,
                 const TableSource::Cell& cell, std::vector<double>& centre) {
  std::vector<std::size_t> corners{0};  // entries
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const TableAxis& axis = axes[i];
    const bool is_extended = !axis.is_categorical() && axis.size() > 1;
    centre[i] = is_extended ? axis.values[cell[i]] / 2 + axis.values[cell[i] + 1] / 2 : axis.number(cell[i]);
    for (std::size_t& corner : corners) corner = corner * axis.size() + cell[i];
    if (!is_extended) continue;
    const std::size_t count = corners.size();
    for (std::size_t k = 0; k < count; ++k) corners.push_back(corners[k] + 1);
  }
  double sum = 0;
  for (const std::size_t corner : corners) sum += value(corner);
  return sum / static_cast<double>(corners.size());
}

/// Models by their places: those that were used last. Whoever comes first makes one.
class KeptModels {
 public:
  using Shared = std::shared_ptr<const Model>;

  KeptModels(TableModels models, std::size_t most) : make_(std::move(models)), most_(most) {}

  Shared get(const std::vector<double>& place) {
    std::promise<Shared> promise;
    std::unique_lock lock(mutex_);
    const auto [found, is_new] = models_.try_emplace(place);
    if (is_new) found->second.model = promise.get_future().share();
    found->second.last_use = ++uses_;
    const std::shared_future<Shared> result = found->second.model;
    if (models_.size() > most_)
      models_.erase(std::ranges::min_element(models_, {}, [](const auto& item) { return item.second.last_use; }));
    lock.unlock();
    if (is_new) {
      try {
        promise.set_value(make_(place));
      } catch (...) {
        promise.set_exception(std::current_exception());
      }
    }
    return result.get();
  }

 private:
  struct Kept {
    std::shared_future<Shared> model;
    std::size_t last_use = 0;
  };

  TableModels make_;
  std::size_t most_;
  std::mutex mutex_;
  std::map<std::vector<double>, Kept> models_;
  std::size_t uses_ = 0;
};

}  // namespace

TableModels kept(TableModels models, std::size_t most) {
  return [all = std::make_shared<KeptModels>(std::move(models), most)](const std::vector<double>& place) {
    return all->get(place);
  };
}

TableSource::TableSource(const std::string& model, Parameters fixed, std::vector<TableAxis> axes, TableOptions options)
    : TableSource(models_of(model, std::move(fixed), axes, options), axes, without_correction(options)) {}

TableSource::TableSource(TableModels models, std::vector<TableAxis> axes, TableOptions options)
    : models_(std::move(models)), axes_(std::move(axes)), options_(std::move(options)) {
  if (options_.threads < 0) throw ParameterError(fmt::format("threads is {} and must be 0 or more", options_.threads));
  if (options_.verified_cells < 0) {
    throw ParameterError(fmt::format("verified_cells is {} and must be 0 or more", options_.verified_cells));
  }
  if (options_.correction) throw ParameterError("correction is of a model by name; models of one's own come corrected");
  check(axes_);
  size_ = entry_count(axes_);
  threads_ = thread_count(options_.threads);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const std::string& name = axes_[i].name;
    if (is_polar(name)) {
      polar_ = i, is_in_degrees_ = name == "theta";
    } else if (name == "phi") {
      phi_ = i;
    } else {
      model_axes_.push_back(i);
    }
  }
}

TableSource::Interpolation TableSource::interpolation(const std::function<double(std::size_t)>& value) const {
  return interpolation(value, verified_cells(axes_, static_cast<std::size_t>(options_.verified_cells)));
}

TableSource::Interpolation TableSource::interpolation(const std::function<double(std::size_t)>& value,
                                                      const std::vector<Cell>& cells) const {
  struct Share {  // of a thread
    Worker worker;
    std::vector<double> centre;
    Interpolation met;
  };
  Interpolation result;
  const auto verify = [&](std::size_t k, Share& share) {
    const double interpolated = at_centre(axes_, value, cells[k], share.centre);
    if (!std::isfinite(interpolated)) return;
    const Estimate a = share.worker.at(share.centre);
    share.met.evaluations += a.evaluations;
    if (std::isfinite(a.value)) share.met.error = std::max(share.met.error, std::abs(interpolated - a.value));
  };
  const auto make_share = [&] { return Share{Worker(*this), std::vector<double>(axes_.size()), {}}; };
  in_parallel(cells.size(), threads_, make_share, verify, [&](const Share& share) {
    result.evaluations += share.met.evaluations;
    result.error = std::max(result.error, share.met.error);
  });
  return result;
}

Estimate TableSource::Worker::at(const std::vector<double>& place) {
  const TableSource& source = *source_;
  const std::vector<std::size_t>& varied = source.model_axes_;
  bool is_same = model_ != nullptr;
  for (std::size_t k = 0; k < varied.size() && is_same; ++k) is_same = place[varied[k]] == model_place_[k];
  if (!is_same) {
    model_ = nullptr;  // also if there is none
    model_place_.clear();
    for (const std::size_t axis : varied) model_place_.push_back(place[axis]);
    model_ = source.models_(model_place_);
  }
  const double phi = source.phi_ ? place[*source.phi_] : 0, polar = place[source.polar_];
  const Direction l = source.is_in_degrees_ ? Direction::from_degrees(polar, phi) : Direction::from_cosine(polar, phi);
  return directional_albedo(*model_, l, source.options_.albedo);
}

TableTally TableSource::Worker::fill(std::size_t first, std::span<double> values, std::span<double> errors) {
  const std::vector<TableAxis>& axes = source_->axes_;
  TableTally tally;
  for (std::size_t k = 0; k < values.size(); ++k) {
    std::size_t rest = first + k;
    for (std::size_t i = axes.size(); i-- > 0; rest /= axes[i].size())
      place_[i] = axes[i].number(rest % axes[i].size());
    const Estimate a = at(place_);
    values[k] = a.value;
    if (!errors.empty()) errors[k] = a.error;
    tally.add(first + k, a);
  }
  return tally;
}

}  // namespace albedo
