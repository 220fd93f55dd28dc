/// @file
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

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

  /// "25 %, 1000 of 4000 at 100 a second, 30 s left"
  [[nodiscard]] std::string text(std::size_t done, std::size_t total) const;

 private:
  using Clock = std::chrono::steady_clock;

  bool is_wanted_;
  bool is_coloured_;
  bool is_shown_ = false;
  Clock::time_point begin_, next_;
};

}  // namespace albedo::analysis
