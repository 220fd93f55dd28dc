#include "cli/program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace albedo::test {
namespace {

/// A file that is gone with its owner.
class TemporaryFile {
 public:
  TemporaryFile() : path_((std::filesystem::temp_directory_path() / "albedo-cli-XXXXXX").string()) {
    const int descriptor = ::mkstemp(path_.data());
    if (descriptor < 0) throw std::runtime_error("no temporary file");
    ::close(descriptor);
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Starts the program with its output going to two files.
pid_t start(const std::vector<std::string>& arguments, const std::string& out, const std::string& err) {
  std::vector<std::string> words{"albedo"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_TRUNC, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_TRUNC, 0);
  pid_t child = 0;
  const int failure = ::posix_spawn(&child, ALBEDO_PROGRAM, &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw std::runtime_error("cannot start " ALBEDO_PROGRAM);
  return child;
}

}  // namespace

Outcome run_albedo(const std::vector<std::string>& arguments, const std::string& out) {
  const TemporaryFile captured_out, captured_err;
  const pid_t child = start(arguments, out.empty() ? captured_out.path() : out, captured_err.path());
  int status = 0;
  if (::waitpid(child, &status, 0) != child) throw std::runtime_error("lost " ALBEDO_PROGRAM);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, read_text(captured_out.path()), read_text(captured_err.path())};
}

RunningAlbedo::RunningAlbedo(const std::vector<std::string>& arguments)
    : child_(start(arguments, "/dev/null", "/dev/null")) {}

bool RunningAlbedo::has_ended() {
  if (child_ != 0 && ::waitpid(child_, nullptr, WNOHANG) == child_) child_ = 0;
  return child_ == 0;
}

void RunningAlbedo::kill(int signal) {
  if (has_ended()) return;
  ::kill(child_, signal);
  ::waitpid(std::exchange(child_, 0), nullptr, 0);
}

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::size_t line_count(const std::string& text) { return static_cast<std::size_t>(std::ranges::count(text, '\n')); }

void CliTest::SetUp() {
  before_ = std::filesystem::current_path();
  std::string name = (std::filesystem::temp_directory_path() / "albedo-cli-XXXXXX").string();
  ASSERT_NE(::mkdtemp(name.data()), nullptr);
  directory_ = name;
  std::filesystem::current_path(directory_);
}

void CliTest::TearDown() {
  std::filesystem::current_path(before_);
  std::filesystem::remove_all(directory_);
}

std::vector<std::string> CliTest::files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(".")) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace albedo::test
