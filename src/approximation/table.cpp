#include "albedo/table.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <span>

#include "albedo/core/errors.hpp"
#include "albedo/table_source.hpp"
#include "numerics/parallel.hpp"

namespace albedo {
namespace {

constexpr std::size_t tile = 32;  // consecutive entries of one thread

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

}  // namespace

std::size_t entry_count(const std::vector<TableAxis>& axes) {
  std::size_t count = 1;
  const std::size_t most = std::vector<double>().max_size();
  for (const TableAxis& axis : axes) {
    if (axis.size() > 0 && count > most / axis.size()) {
      throw ParameterError("the table has more entries than memory has addresses");
    }
    count *= axis.size();
  }
  return count;
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

AlbedoTable::AlbedoTable(const std::string& model, const Parameters& fixed, std::vector<TableAxis> axes,
                         const TableOptions& options)
    : AlbedoTable(TableSource(model, fixed, std::move(axes), options)) {}

AlbedoTable::AlbedoTable(const TableSource& source) : axes_(source.axes()) {
  const bool keeps_errors = source.options().keep_errors;
  const std::size_t count = source.size();
  values_.resize(count);
  if (keeps_errors) errors_.resize(count);

  struct Share {  // of a thread
    TableSource::Worker worker;
    TableTally tally{};
  };
  Progress progress(source.options(), count);
  const auto fill_tile = [&](std::size_t index, Share& share) {
    const std::size_t begin = index * tile, size = std::min(count - begin, tile);
    const std::span<double> errors = keeps_errors ? std::span(errors_).subspan(begin, size) : std::span<double>{};
    share.tally.merge(share.worker.fill(begin, std::span(values_).subspan(begin, size), errors));
    progress.add(size);
  };
  in_parallel((count - 1) / tile + 1, source.threads(), [&] { return Share{TableSource::Worker(source)}; }, fill_tile,
              [&](const Share& share) { tally_.merge(share.tally); });
  const TableSource::Interpolation interpolation = source.interpolation([&](std::size_t e) { return values_[e]; });
  interpolation_error_ = interpolation.error;
  verification_ = interpolation.evaluations;
}

}  // namespace albedo
