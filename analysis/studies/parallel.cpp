#include "analysis/studies/parallel.hpp"

#include <omp.h>

#include <atomic>
#include <exception>

namespace albedo::analysis {

void in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& task,
                 const ProgressCallback& progress) {
  std::exception_ptr thrown;
  std::atomic<bool> failed = false;
  std::atomic<std::size_t> done = 0;
#pragma omp parallel for schedule(dynamic) num_threads(threads > 0 ? threads : omp_get_max_threads())
  for (std::size_t i = 0; i < count; ++i) {
    if (failed) continue;
    try {
      task(i);
      const std::size_t so_far = ++done;
      if (progress && omp_get_thread_num() == 0) progress(so_far, count);
    } catch (...) {
#pragma omp critical(albedo_study)
      if (!failed.exchange(true)) thrown = std::current_exception();
    }
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace albedo::analysis
