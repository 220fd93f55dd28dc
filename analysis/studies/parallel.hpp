/// @file
#pragma once

#include <cstddef>
#include <functional>

namespace albedo::analysis {

/// How far a study is; called from one thread.
using ProgressCallback = std::function<void(std::size_t done, std::size_t total)>;

/// Runs task(i) for every i < count, in any order, on so many threads (0: as many as OpenMP would use). Tasks must not
/// depend on one another. An exception of a task ends the work and is thrown on.
void in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& task,
                 const ProgressCallback& progress = {});

}  // namespace albedo::analysis
