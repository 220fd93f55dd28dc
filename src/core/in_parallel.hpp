/// @file
#pragma once

#include <omp.h>

#include <atomic>
#include <cstddef>
#include <exception>

namespace albedo {

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

}  // namespace albedo
