/// @file
/// The one parallel loop.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>

namespace albedo {

/// How far a computation is; called from one thread.
using ProgressCallback = std::function<void(std::size_t done, std::size_t total)>;

/// As many threads as are asked for; 0: as many as OpenMP would use.
int thread_count(int asked);

/// Runs task(i, state) for i < count, each thread with a state of its own from make_state(), which merge() gets at the
/// end, one at a time. What a task throws ends the work and is thrown again here.
template <class MakeState, class Task, class Merge>
void in_parallel(std::size_t count, int threads, const MakeState& make_state, const Task& task, const Merge& merge) {
  std::exception_ptr thrown;
  std::atomic<bool> failed = false;
#pragma omp parallel num_threads(thread_count(threads))
  {
    auto state = make_state();
#pragma omp for schedule(dynamic)
    for (std::size_t i = 0; i < count; ++i) {
      if (failed) continue;
      try {
        task(i, state);
      } catch (...) {
#pragma omp critical(albedo_parallel)
        if (!failed.exchange(true)) thrown = std::current_exception();
      }
    }
#pragma omp critical(albedo_parallel)
    merge(state);
  }
  if (thrown) std::rethrow_exception(thrown);
}

/// Runs task(i) for every i < count, in any order. Tasks must not depend on one another.
void in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& task,
                 const ProgressCallback& progress = {});

}  // namespace albedo
