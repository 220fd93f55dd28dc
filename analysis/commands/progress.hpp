/// @file
#pragma once

#include <chrono>
#include <cstddef>

namespace albedo::analysis {

/// A bar on standard error, if that is a terminal and the work takes longer than a second; coloured unless NO_COLOR is
/// set.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// To be called from one thread at a time.
  void update(std::size_t done, std::size_t total);

 private:
  using Clock = std::chrono::steady_clock;

  bool is_wanted_;
  bool is_coloured_;
  bool is_shown_ = false;
  Clock::time_point next_;
};

}  // namespace albedo::analysis
