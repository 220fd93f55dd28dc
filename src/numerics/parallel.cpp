#include "numerics/parallel.hpp"

#include <omp.h>

namespace albedo {

int thread_count(int asked) { return asked > 0 ? asked : omp_get_max_threads(); }

void in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& task,
                 const ProgressCallback& progress) {
  struct NoState {};
  std::atomic<std::size_t> done = 0;
  const auto counted = [&](std::size_t i, NoState) {
    task(i);
    const std::size_t so_far = ++done;
    if (progress && omp_get_thread_num() == 0) progress(so_far, count);
  };
  in_parallel(
      count, threads, [] { return NoState{}; }, counted, [](NoState) {});
}

}  // namespace albedo
