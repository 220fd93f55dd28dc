#include "analysis/commands/interruption.hpp"

#include <unistd.h>

#include <array>
#include <csignal>

namespace albedo::analysis {
namespace {

constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};

// A handler can reach nothing else.
std::string notice;                                   // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
std::array<struct sigaction, signals.size()> before;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

extern "C" void say_and_end(int signal) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, notice.data(), notice.size());
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (signals[i] == signal) ::sigaction(signal, &before[i], nullptr);
  }
  ::raise(signal);
}

}  // namespace

InterruptionNotice::InterruptionNotice(const std::string& sentence) {
  notice = "albedo: " + sentence + '\n';
  struct sigaction action {};
  action.sa_handler = say_and_end;
  ::sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < signals.size(); ++i) {
    ::sigaction(signals[i], nullptr, &before[i]);
    // What the caller wants ignored (nohup), stays ignored.
    if (before[i].sa_handler != SIG_IGN) ::sigaction(signals[i], &action, nullptr);
  }
}

InterruptionNotice::~InterruptionNotice() {
  for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &before[i], nullptr);
}

}  // namespace albedo::analysis
