#include "analysis/text/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

bool is_set(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

/// "40 s", "5 min", "3.5 h"
std::string duration_text(double seconds) {
  if (seconds < 90) return number_text(std::ceil(seconds), 3) + " s";
  if (seconds < 5400) return number_text(std::ceil(seconds / 60), 3) + " min";
  return number_text(seconds / 3600, 3) + " h";
}

}  // namespace

ProgressBar::ProgressBar()
    : is_wanted_(::isatty(STDERR_FILENO) == 1),
      is_coloured_(!is_set("NO_COLOR")),
      begin_(Clock::now()),
      next_(begin_ + std::chrono::seconds(1)) {}

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
  std::cerr << "\r[" << bar << "] " << text(done, total) << "\x1b[K" << std::flush;
  is_shown_ = true;
  next_ = Clock::now() + std::chrono::milliseconds(100);
}

std::string ProgressBar::text(std::size_t done, std::size_t total) const {
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  const double rate = static_cast<double>(done) / std::max(seconds, 1e-9);
  std::string result = std::to_string(100 * done / std::max<std::size_t>(total, 1)) + " %, " + std::to_string(done) +
                       " of " + std::to_string(total) + " at " +
                       number_text(rate < 100 ? rate : std::round(rate), rate < 100 ? 3 : 17) + " a second";
  if (done > 0 && done < total) result += ", " + duration_text(static_cast<double>(total - done) / rate) + " left";
  return result;
}

}  // namespace albedo::analysis
