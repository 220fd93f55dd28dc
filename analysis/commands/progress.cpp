#include "analysis/commands/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string>

namespace albedo::analysis {
namespace {

bool is_set(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

}  // namespace

ProgressBar::ProgressBar()
    : is_wanted_(::isatty(STDERR_FILENO) == 1),
      is_coloured_(!is_set("NO_COLOR")),
      next_(Clock::now() + std::chrono::seconds(1)) {}

ProgressBar::~ProgressBar() {
  if (is_shown_) std::cerr << "\r\x1b[K" << std::flush;
}

void ProgressBar::update(std::size_t done, std::size_t total) {
  if (!is_wanted_ || total == 0 || Clock::now() < next_) return;
  constexpr double width = 40;
  const double fraction = std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
  const std::string full(static_cast<std::size_t>(width * fraction), '#');
  const std::string rest(static_cast<std::size_t>(width) - full.size(), '.');
  const std::string bar = is_coloured_ ? "\x1b[36m" + full + "\x1b[0m" + rest : full + rest;
  std::cerr << "\r[" << bar << "] " << static_cast<int>(100 * fraction) << " %" << std::flush;
  is_shown_ = true;
  next_ = Clock::now() + std::chrono::milliseconds(100);
}

}  // namespace albedo::analysis
