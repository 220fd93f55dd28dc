#include "analysis/commands/fill_progress.hpp"

#include <cerrno>
#include <ctime>
#include <system_error>

#include "analysis/files/atomic_file.hpp"

namespace albedo::analysis {
namespace {

using Clock = std::chrono::steady_clock;

std::string utc_time() {
  const std::time_t now = std::time(nullptr);
  std::tm fields{};
  ::gmtime_r(&now, &fields);
  std::string text(32, '\0');
  text.resize(std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &fields));
  return text;
}

std::ofstream opened(const std::string& log) {
  if (log.empty()) return {};
  std::ofstream file(log, std::ios::app);
  if (!file) throw cannot_write(log, std::generic_category().message(errno));
  return file;
}

}  // namespace

void FillProgress::check(const std::string& log) { opened(log); }

FillProgress::FillProgress(TileClaims& claims, std::size_t total, const std::string& log)
    : claims_(claims), total_(total), log_(opened(log)) {
  thread_ = std::thread([this] { watch(); });
}

FillProgress::~FillProgress() { stop(); }

void FillProgress::stop() {
  {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
  }
  woken_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void FillProgress::note(const std::string& line) {
  const std::lock_guard lock(mutex_);
  append(line);
}

void FillProgress::append(const std::string& line) {
  if (log_.is_open()) log_ << utc_time() << ' ' << line << std::endl;
}

void FillProgress::watch() {
  constexpr std::chrono::milliseconds look{100};
  constexpr std::chrono::seconds line{30};
  ProgressBar bar;
  auto next_line = Clock::now() + line;
  std::unique_lock lock(mutex_);
  while (!woken_.wait_for(lock, look, [this] { return is_stopped_; })) {
    const std::size_t done = claims_.add_done(0);
    bar.update(done, total_);
    if (Clock::now() < next_line) continue;
    next_line += line;
    append(bar.text(done, total_));
  }
}

}  // namespace albedo::analysis
