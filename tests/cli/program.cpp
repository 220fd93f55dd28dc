#include "cli/program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
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

using Words = std::vector<std::string>;

Words joined(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// The words that start the program as several ranks: more of them than processors, as root, and in a container without
/// a remote shell.
Words launched(int ranks, const Words& arguments) {
  const auto set = [](const char* name, const char* value) { ::setenv(name, value, 1); };
  set("OMPI_ALLOW_RUN_AS_ROOT", "1");
  set("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
  set("OMPI_MCA_rmaps_base_oversubscribe", "1");
  set("OMPI_MCA_hwloc_base_binding_policy", "none");
  set("OMPI_MCA_plm", "isolated");
  set("OMPI_MCA_btl_vader_single_copy_mechanism", "none");
  return joined({ALBEDO_MPIEXEC, "-n", std::to_string(ranks), ALBEDO_PROGRAM}, arguments);
}

/// Starts a program with its output going to two files.
pid_t start(Words words, const std::string& out, const std::string& err) {
  const std::string program = words.front();
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_TRUNC, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  pid_t child = 0;
  const int failure = ::posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw std::runtime_error("cannot start " + program);
  return child;
}

Outcome run(const Words& words, const std::string& out) {
  const TemporaryFile captured_out, captured_err;
  const pid_t child = start(words, out.empty() ? captured_out.path() : out, captured_err.path());
  int status = 0;
  if (::waitpid(child, &status, 0) != child) throw std::runtime_error("lost " + words.front());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, read_text(captured_out.path()), read_text(captured_err.path())};
}

}  // namespace

Outcome run_albedo(const Words& arguments, const std::string& out) {
  return run(joined({ALBEDO_PROGRAM}, arguments), out);
}

Outcome run_ranks(int ranks, const Words& arguments) { return run(launched(ranks, arguments), ""); }

bool has_mpi() { return *ALBEDO_MPIEXEC != '\0'; }

RunningAlbedo::RunningAlbedo(const Words& arguments, const std::string& err)
    : child_(start(joined({ALBEDO_PROGRAM}, arguments), "/dev/null", err)) {}

RunningAlbedo::RunningAlbedo(int ranks, const Words& arguments)
    : child_(start(launched(ranks, arguments), "/dev/null", "/dev/null")) {}

bool RunningAlbedo::has_ended() {
  if (child_ != 0 && ::waitpid(child_, nullptr, WNOHANG) == child_) child_ = 0;
  return child_ == 0;
}

void RunningAlbedo::kill(int signal) {
  if (has_ended()) return;
  ::kill(child_, signal);
  wait();
}

void RunningAlbedo::wait() {
  if (child_ != 0) ::waitpid(std::exchange(child_, 0), nullptr, 0);
}

std::vector<pid_t> RunningAlbedo::ranks() const {
  const std::string id = std::to_string(child_);
  std::ifstream children("/proc/" + id + "/task/" + id + "/children");
  return {std::istream_iterator<pid_t>(children), {}};
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
