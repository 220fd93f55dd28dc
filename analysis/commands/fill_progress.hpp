/// @file
/// How far a table is that threads and processes fill together.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <fstream>
#include <mutex>
#include <string>
#include <thread>

#include "analysis/files/tile_claims.hpp"
#include "analysis/text/progress.hpp"

namespace albedo::analysis {

/// A bar on a terminal, and in a log file a line at once, every 30 s and on request; from a thread of its own.
class FillProgress {
 public:
  /// @param log a file to append to; empty: none
  /// @throws WriteError if the log can't be opened
  FillProgress(TileClaims& claims, std::size_t total, const std::string& log);
  ~FillProgress();
  FillProgress(const FillProgress&) = delete;
  FillProgress& operator=(const FillProgress&) = delete;

  /// Throws the WriteError that this log would meet: to be called before anything else is written.
  static void check(const std::string& log);

  /// The thread ends, and the bar goes.
  void stop();

  /// Appends a line, after the time, to the log.
  void note(const std::string& line);

 private:
  void watch();
  void append(const std::string& line);

  TileClaims& claims_;
  std::size_t total_;
  std::ofstream log_;
  std::mutex mutex_;
  std::condition_variable woken_;
  bool is_stopped_ = false;
  std::thread thread_;
};

}  // namespace albedo::analysis
