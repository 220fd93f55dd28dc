#include "albedo/table_source.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <map>
#include <mutex>
#include <sstream>

#include "albedo/core/errors.hpp"
#include "albedo/core/suggestion.hpp"
#include "numerics/parallel.hpp"

namespace albedo {
namespace {

enum class AxisKind { parameter, cos_theta, theta, phi };

AxisKind kind_of(const TableAxis& axis) {
  if (axis.name == "cos_theta") return AxisKind::cos_theta;
  if (axis.name == "theta") return AxisKind::theta;
  return axis.name == "phi" ? AxisKind::phi : AxisKind::parameter;
}

/// The parameters that a name of an axis or of a fixed value sets; a direction's name stands for itself.
std::vector<std::string> set_by(const ModelInfo& info, const TableAxis& axis) {
  if (kind_of(axis) != AxisKind::parameter) return {axis.name};
  std::vector<std::string> names = info.resolve(axis.name);
  if (!names.empty()) return names;
  std::vector<std::string> candidates{"cos_theta", "theta", "phi"};
  for (const ParameterInfo& parameter : info.parameters) candidates.push_back(parameter.name);
  for (const Shorthand& shorthand : info.shorthands) candidates.push_back(shorthand.name);
  const std::string close = suggestion(axis.name, candidates);
  throw ParameterError(info.name + " has no parameter '" + axis.name + "' for an axis" +
                       (close.empty() ? "" : "; did you mean '" + close + "'?"));
}

void check_values(const std::string& subject, const TableAxis& axis, const Range& range) {
  for (const double value : axis.values) {
    if (range.contains(value)) continue;
    std::ostringstream message;
    message << subject << " is " << value << " on its axis and must be within [" << range.minimum << ", "
            << range.maximum << "]";
    throw ParameterError(message.str());
  }
}

void check_axis(const ModelInfo& info, const TableAxis& axis) {
  if (axis.values.empty()) throw ParameterError("the axis '" + axis.name + "' has no values");
  switch (kind_of(axis)) {
    case AxisKind::cos_theta:
      return check_values("cos_theta", axis, {0, 1});
    case AxisKind::theta:
      return check_values("theta", axis, {0, 90});
    case AxisKind::phi:
      return check_values("phi", axis, {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()});
    case AxisKind::parameter:
      break;
  }
  for (const std::string& name : set_by(info, axis)) {
    const ParameterInfo& parameter = *info.find(name);
    if (parameter.is_choice())
      throw ParameterError(info.name + ": " + name + " is a choice of names and can't be an axis");
    check_values(info.name + ": " + name, axis, parameter.range);
  }
}

/// Throws unless the axes are valid, set nothing twice and give L a polar angle.
void check(const ModelInfo& info, const Parameters& fixed, const std::vector<TableAxis>& axes) {
  std::vector<std::pair<std::string, std::string>> set;  // parameter, axis
  bool has_angle = false;
  for (const TableAxis& axis : axes) {
    check_axis(info, axis);
    for (const std::string& name : set_by(info, axis)) {
      const auto same = std::find_if(set.begin(), set.end(), [&](const auto& s) { return s.first == name; });
      if (same != set.end())
        throw ParameterError(name + " is varied twice, by the axes '" + same->second + "' and '" + axis.name + "'");
      set.emplace_back(name, axis.name);
    }
    if (kind_of(axis) == AxisKind::cos_theta || kind_of(axis) == AxisKind::theta) {
      if (has_angle) throw ParameterError("the axes 'cos_theta' and 'theta' exclude each other");
      has_angle = true;
    }
  }
  if (!has_angle) throw ParameterError("a table needs an axis 'cos_theta' or 'theta'");
  for (const auto& [given, value] : fixed) {
    for (const std::string& name : info.resolve(given)) {
      const auto same = std::find_if(set.begin(), set.end(), [&](const auto& s) { return s.first == name; });
      if (same == set.end()) continue;
      throw ParameterError(name + " is fixed by '" + given + "' and varied by the axis '" + same->second + "'");
    }
  }
  make_model(info.name, fixed);
}

std::size_t entry_count(const std::vector<TableAxis>& axes) {
  std::size_t count = 1;
  const std::size_t most = std::vector<double>().max_size();
  for (const TableAxis& axis : axes) {
    if (axis.values.size() > most / count) throw ParameterError("the table has more entries than memory has addresses");
    count *= axis.values.size();
  }
  return count;
}

/// The indices on the axes of an entry in C order.
std::vector<std::size_t> indices_of(std::size_t entry, const std::vector<TableAxis>& axes) {
  std::vector<std::size_t> indices(axes.size());
  for (std::size_t i = axes.size(); i-- > 0;) {
    indices[i] = entry % axes[i].values.size();
    entry /= axes[i].values.size();
  }
  return indices;
}

/// Cells of the grid by their first corner: all of them, or `most` by an additive recurrence that spreads over every
/// axis alike [Roberts 2018].
std::vector<std::vector<std::size_t>> spread_cells(const std::vector<TableAxis>& axes, std::size_t most) {
  std::vector<std::size_t> counts;  // of cells along each axis; an axis of one value has no extent
  std::size_t cells = 1;
  bool is_extended = false;
  for (const TableAxis& axis : axes) {
    counts.push_back(std::max<std::size_t>(axis.values.size() - 1, 1));
    cells *= counts.back();
    is_extended = is_extended || axis.values.size() > 1;
  }
  if (!is_extended) return {};
  const bool takes_all = cells <= most;
  std::vector<std::vector<std::size_t>> chosen(takes_all ? cells : most, std::vector<std::size_t>(axes.size()));
  double ratio = 2;  // the root of ratio^(d+1) = ratio + 1
  for (int step = 0; step < 64; ++step) ratio = std::pow(1 + ratio, 1 / (static_cast<double>(axes.size()) + 1));
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    std::size_t rest = k;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const double turns = static_cast<double>(k + 1) * std::pow(ratio, -static_cast<double>(i + 1));
      const auto spread = static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(counts[i]));
      chosen[k][i] = takes_all ? rest % counts[i] : std::min(spread, counts[i] - 1);
      rest /= counts[i];
    }
  }
  return chosen;
}

/// The mean of the table over the corners of a cell, which is what multilinear interpolation gives at its centre, and
/// the centre.
double at_centre(const std::vector<TableAxis>& axes, const std::function<double(std::size_t)>& value,
                 const std::vector<std::size_t>& cell, std::vector<double>& centre) {
  std::vector<std::size_t> corners{0};  // entries
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::vector<double>& v = axes[i].values;
    const bool is_extended = v.size() > 1;
    centre[i] = is_extended ? v[cell[i]] / 2 + v[cell[i] + 1] / 2 : v[0];
    for (std::size_t& corner : corners) corner = corner * v.size() + cell[i];
    if (!is_extended) continue;
    const std::size_t count = corners.size();
    for (std::size_t k = 0; k < count; ++k) corners.push_back(corners[k] + 1);
  }
  double sum = 0;
  for (const std::size_t corner : corners) sum += value(corner);
  return sum / static_cast<double>(corners.size());
}

}  // namespace

/// Corrected models, which are worth keeping, by the values of the parameters that vary: those that were used last.
/// Whoever comes first makes one.
class TableSource::CorrectedModels {
 public:
  using Shared = std::shared_ptr<const Model>;

  template <class Make>
  Shared get(const std::vector<double>& place, const Make& make) {
    std::promise<Shared> promise;
    std::unique_lock lock(mutex_);
    const auto [found, is_new] = models_.try_emplace(place);
    if (is_new) found->second.model = promise.get_future().share();
    found->second.last_use = ++uses_;
    const std::shared_future<Shared> result = found->second.model;
    if (models_.size() > most)
      models_.erase(std::ranges::min_element(models_, {}, [](const auto& item) { return item.second.last_use; }));
    lock.unlock();
    if (is_new) {
      try {
        promise.set_value(make());
      } catch (...) {
        promise.set_exception(std::current_exception());
      }
    }
    return result.get();
  }

 private:
  static constexpr std::size_t most = 256;  // some 100 kB each

  struct Kept {
    std::shared_future<Shared> model;
    std::size_t last_use = 0;
  };

  std::mutex mutex_;
  std::map<std::vector<double>, Kept> models_;
  std::size_t uses_ = 0;
};

TableSource::TableSource(std::string model, Parameters fixed, std::vector<TableAxis> axes, TableOptions options)
    : model_(std::move(model)), fixed_(std::move(fixed)), axes_(std::move(axes)), options_(std::move(options)) {
  if (options_.threads < 0)
    throw ParameterError("threads is " + std::to_string(options_.threads) + " and must be 0 or more");
  if (options_.verified_cells < 0) {
    throw ParameterError("verified_cells is " + std::to_string(options_.verified_cells) + " and must be 0 or more");
  }
  check(model_info(model_), fixed_, axes_);
  size_ = entry_count(axes_);
  threads_ = options_.threads > 0 ? options_.threads : omp_get_max_threads();
  corrected_ = std::make_unique<CorrectedModels>();
}

TableSource::~TableSource() = default;

std::shared_ptr<const Model> TableSource::model_at(const std::vector<double>& place) const {
  Parameters parameters = fixed_;
  std::vector<double> varied;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (kind_of(axes_[i]) != AxisKind::parameter) continue;
    parameters.emplace_back(axes_[i].name, place[i]);
    varied.push_back(place[i]);
  }
  if (!options_.correction) return make_model(model_, parameters);
  return corrected_->get(varied, [&] { return options_.correction(make_model(model_, parameters)); });
}

TableSource::Interpolation TableSource::interpolation(const std::function<double(std::size_t)>& value) const {
  struct Share {  // of a thread
    Worker worker;
    std::vector<double> centre;
    Interpolation met;
  };
  Interpolation result;
  const auto cells = spread_cells(axes_, static_cast<std::size_t>(options_.verified_cells));
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
  const std::vector<TableAxis>& axes = source_->axes_;
  bool is_same = model_ != nullptr;
  double phi = 0;
  const double* theta = nullptr;
  const double* cosine = nullptr;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    switch (kind_of(axes[i])) {
      case AxisKind::cos_theta:
        cosine = &place[i];
        break;
      case AxisKind::theta:
        theta = &place[i];
        break;
      case AxisKind::phi:
        phi = place[i];
        break;
      case AxisKind::parameter:
        is_same = is_same && place[i] == model_place_[i];
    }
  }
  if (!is_same) {
    model_ = source_->model_at(place);
    model_place_ = place;
  }
  const Direction l = theta != nullptr ? Direction::from_degrees(*theta, phi) : Direction::from_cosine(*cosine, phi);
  return directional_albedo(*model_, l, source_->options_.albedo);
}

TableTally TableSource::Worker::fill(std::size_t first, std::span<double> values, std::span<double> errors) {
  const std::vector<TableAxis>& axes = source_->axes_;
  TableTally tally;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::vector<std::size_t> indices = indices_of(first + k, axes);
    for (std::size_t i = 0; i < axes.size(); ++i) place_[i] = axes[i].values[indices[i]];
    const Estimate a = at(place_);
    values[k] = a.value;
    if (!errors.empty()) errors[k] = a.error;
    tally.add(first + k, a);
  }
  return tally;
}

void TableTally::add(std::size_t entry, const Estimate& estimate) {
  evaluations += estimate.evaluations;
  if (estimate.status == Status::divergent) {
    ++divergent;
    return;
  }
  if (estimate.status != Status::converged) ++unconverged;
  if (std::isfinite(estimate.value)) merge({.worst_error = estimate.error, .worst_entry = entry});
}

void TableTally::merge(const TableTally& other) {
  // NaN is worse than any number.
  const auto rank = [](double error) { return std::isnan(error) ? std::numeric_limits<double>::infinity() : error; };
  const double ours = rank(worst_error), theirs = rank(other.worst_error);
  if (theirs > ours || (theirs == ours && other.worst_entry < worst_entry)) {
    worst_error = other.worst_error;
    worst_entry = other.worst_entry;
  }
  unconverged += other.unconverged;
  divergent += other.divergent;
  evaluations += other.evaluations;
}

}  // namespace albedo
