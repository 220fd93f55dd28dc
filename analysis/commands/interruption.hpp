/// @file
#pragma once

#include <string>

namespace albedo::analysis {

/// While it lives, SIGINT, SIGTERM and SIGHUP end the process as they would have, and a sentence on standard error says
/// what is left. One at a time.
class InterruptionNotice {
 public:
  explicit InterruptionNotice(const std::string& sentence);
  ~InterruptionNotice();
  InterruptionNotice(const InterruptionNotice&) = delete;
  InterruptionNotice& operator=(const InterruptionNotice&) = delete;
};

}  // namespace albedo::analysis
