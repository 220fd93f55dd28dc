#include "albedo/table.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <future>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>

#include "albedo/core/errors.hpp"
#include "albedo/core/suggestion.hpp"

namespace albedo {
namespace {

constexpr std::size_t tile = 32;  // consecutive entries of one thread

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

/// Corrected models, which are worth keeping, by the values of the parameters that vary. Whoever comes first makes one.
class CorrectedModels {
 public:
  using Shared = std::shared_ptr<const Model>;

  template <class Make>
  Shared get(const std::vector<double>& place, const Make& make) {
    std::promise<Shared> promise;
    std::unique_lock lock(mutex_);
    const auto [found, is_new] = models_.try_emplace(place);
    if (is_new) found->second = promise.get_future().share();
    const std::shared_future<Shared> result = found->second;
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
  std::mutex mutex_;
  std::map<std::vector<double>, std::shared_future<Shared>> models_;
};

/// The albedo at places of the grid, or between; its model is made when a parameter changes.
class Entry {
 public:
  Entry(const std::string& name, const Parameters& fixed, const std::vector<TableAxis>& axes,
        const TableOptions& options, CorrectedModels& corrected)
      : name_(name), fixed_(fixed), axes_(axes), options_(options), corrected_(corrected) {}

  /// @param place one value for each axis
  Estimate operator()(const std::vector<double>& place) {
    bool is_same = model_ != nullptr;
    double phi = 0;
    const double* theta = nullptr;
    const double* cosine = nullptr;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      switch (kind_of(axes_[i])) {
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
          is_same = is_same && place[i] == place_[i];
      }
    }
    if (!is_same) {
      model_ = model_at(place);
      place_ = place;
    }
    const Direction l = theta != nullptr ? Direction::from_degrees(*theta, phi) : Direction::from_cosine(*cosine, phi);
    return directional_albedo(*model_, l, options_.albedo);
  }

 private:
  [[nodiscard]] std::shared_ptr<const Model> model_at(const std::vector<double>& place) const {
    Parameters parameters = fixed_;
    std::vector<double> varied;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      if (kind_of(axes_[i]) != AxisKind::parameter) continue;
      parameters.emplace_back(axes_[i].name, place[i]);
      varied.push_back(place[i]);
    }
    if (!options_.correction) return make_model(name_, parameters);
    return corrected_.get(varied, [&] { return options_.correction(make_model(name_, parameters)); });
  }

  const std::string& name_;
  const Parameters& fixed_;
  const std::vector<TableAxis>& axes_;
  const TableOptions& options_;
  CorrectedModels& corrected_;
  std::shared_ptr<const Model> model_;
  std::vector<double> place_;
};

/// Runs task(i, state) for i < count, each thread with a state of its own from make_state(), which merge() gets at the
/// end, one at a time. What a task throws is thrown again here.
template <class MakeState, class Task, class Merge>
void in_parallel(std::size_t count, int threads, const MakeState& make_state, const Task& task, const Merge& merge) {
  std::exception_ptr thrown;
  std::atomic<bool> failed = false;
#pragma omp parallel num_threads(threads)
  {
    auto state = make_state();
#pragma omp for schedule(dynamic)
    for (std::size_t i = 0; i < count; ++i) {
      if (failed) continue;
      try {
        task(i, state);
      } catch (...) {
#pragma omp critical(albedo_table)
        if (!failed.exchange(true)) thrown = std::current_exception();
      }
    }
#pragma omp critical(albedo_table)
    merge(state);
  }
  if (thrown) std::rethrow_exception(thrown);
}

/// Tells a callback how far the work is, from the thread that called for it.
class Progress {
 public:
  Progress(const TableOptions& options, std::size_t total) : callback_(options.progress), total_(total) {}

  void add(std::size_t count) {
    const std::size_t done = done_ += count;
    if (!callback_ || omp_get_thread_num() != 0) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    callback_(done, total_);
  }

 private:
  const std::function<void(std::size_t, std::size_t)>& callback_;
  std::size_t total_;
  std::atomic<std::size_t> done_ = 0;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

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
double at_centre(const std::vector<TableAxis>& axes, const std::vector<double>& values,
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
  for (const std::size_t corner : corners) sum += values[corner];
  return sum / static_cast<double>(corners.size());
}

}  // namespace

AlbedoTable::AlbedoTable(const std::string& model, const Parameters& fixed, std::vector<TableAxis> axes,
                         const TableOptions& options)
    : axes_(std::move(axes)) {
  if (options.threads < 0)
    throw ParameterError("threads is " + std::to_string(options.threads) + " and must be 0 or more");
  if (options.verified_cells < 0) {
    throw ParameterError("verified_cells is " + std::to_string(options.verified_cells) + " and must be 0 or more");
  }
  check(model_info(model), fixed, axes_);
  const std::size_t count = entry_count(axes_);
  values_.resize(count);
  if (options.keep_errors) errors_.resize(count);
  const int threads = options.threads > 0 ? options.threads : omp_get_max_threads();

  struct Share {  // of a thread
    Entry entry;
    std::vector<double> place;
    double worst = -1;
    std::size_t worst_entry = 0, unconverged = 0, divergent = 0;
    std::int64_t evaluations = 0;
  };
  CorrectedModels corrected;
  const auto make_share = [&] {
    return Share{{model, fixed, axes_, options, corrected}, std::vector<double>(axes_.size())};
  };
  double worst = -1;
  Progress progress(options, count);

  const auto fill_tile = [&](std::size_t index, Share& share) {
    const std::size_t begin = index * tile, end = std::min(count, begin + tile);
    for (std::size_t e = begin; e < end; ++e) {
      const std::vector<std::size_t> indices = indices_of(e, axes_);
      for (std::size_t i = 0; i < axes_.size(); ++i) share.place[i] = axes_[i].values[indices[i]];
      const Estimate a = share.entry(share.place);
      values_[e] = a.value;
      if (options.keep_errors) errors_[e] = a.error;
      share.evaluations += a.evaluations;
      if (a.status == Status::divergent) {
        ++share.divergent;
        continue;
      }
      if (a.status != Status::converged) ++share.unconverged;
      if (std::isfinite(a.value) && (a.error > share.worst || (a.error == share.worst && e < share.worst_entry))) {
        share.worst = a.error;
        share.worst_entry = e;
      }
    }
    progress.add(end - begin);
  };
  in_parallel((count - 1) / tile + 1, threads, make_share, fill_tile, [&](const Share& share) {
    unconverged_ += share.unconverged;
    divergent_ += share.divergent;
    evaluations_ += share.evaluations;
    if (share.worst > worst || (share.worst == worst && share.worst_entry < worst_entry_)) {
      worst = share.worst;
      worst_entry_ = share.worst_entry;
    }
  });
  worst_error_ = std::max(worst, 0.0);

  const auto cells = spread_cells(axes_, static_cast<std::size_t>(options.verified_cells));
  const auto verify = [&](std::size_t k, Share& share) {
    const double interpolated = at_centre(axes_, values_, cells[k], share.place);
    if (!std::isfinite(interpolated)) return;
    const Estimate a = share.entry(share.place);
    share.evaluations += a.evaluations;
    if (std::isfinite(a.value)) share.worst = std::max(share.worst, std::abs(interpolated - a.value));
  };
  in_parallel(cells.size(), threads, make_share, verify, [&](const Share& share) {
    evaluations_ += share.evaluations;
    interpolation_error_ = std::max(interpolation_error_, share.worst);
  });
}

}  // namespace albedo
