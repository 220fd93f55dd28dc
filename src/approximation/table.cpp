#include "albedo/table.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <span>

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

AlbedoTable::AlbedoTable(const std::string& model, const Parameters& fixed, std::vector<TableAxis> axes,
                         const TableOptions& options) {
  const TableSource source(model, fixed, std::move(axes), options);
  axes_ = source.axes();
  const std::size_t count = source.size();
  values_.resize(count);
  if (options.keep_errors) errors_.resize(count);

  struct Share {  // of a thread
    TableSource::Worker worker;
    TableTally tally{};
  };
  Progress progress(options, count);
  TableTally whole;
  const auto fill_tile = [&](std::size_t index, Share& share) {
    const std::size_t begin = index * tile, size = std::min(count - begin, tile);
    const std::span<double> errors =
        options.keep_errors ? std::span(errors_).subspan(begin, size) : std::span<double>{};
    share.tally.merge(share.worker.fill(begin, std::span(values_).subspan(begin, size), errors));
    progress.add(size);
  };
  in_parallel((count - 1) / tile + 1, source.threads(), [&] { return Share{TableSource::Worker(source)}; }, fill_tile,
              [&](const Share& share) { whole.merge(share.tally); });
  const TableSource::Interpolation interpolation = source.interpolation([&](std::size_t e) { return values_[e]; });

  worst_error_ = std::max(whole.worst_error, 0.0);
  worst_entry_ = whole.worst_entry;
  unconverged_ = whole.unconverged;
  divergent_ = whole.divergent;
  evaluations_ = whole.evaluations + interpolation.evaluations;
  interpolation_error_ = interpolation.error;
}

}  // namespace albedo
