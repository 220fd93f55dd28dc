#include "analysis/files/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <iostream>
#include <optional>
#include <streambuf>
#include <system_error>
#include <utility>
#include <vector>

namespace albedo::analysis {
namespace {

WriteError cannot_write(std::string_view path, int error) {
  return analysis::cannot_write(path, std::generic_category().message(error));
}

bool is_standard_output(const std::string& path) { return path == "-" || path == "/dev/stdout"; }

/// What stands at a path now: its mode, or nothing. Throws if it could not be written or replaced.
std::optional<mode_t> existing_mode(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) {
    if (errno == ENOENT && !path.empty()) return std::nullopt;
    throw cannot_write(path, errno);
  }
  if (S_ISDIR(info.st_mode)) throw cannot_write(path, EISDIR);
  if (::access(path.c_str(), W_OK) != 0) throw cannot_write(path, errno);
  return info.st_mode;
}

/// The path that a chain of symbolic links ends at; nothing need stand there. stat() has shown that it is no circle.
std::string follow_links(const std::string& path) {
  std::filesystem::path target = path;
  std::error_code failure;
  while (std::filesystem::is_symlink(target, failure)) {
    const std::filesystem::path link = std::filesystem::read_symlink(target, failure);
    if (failure) throw cannot_write(path, failure.value());
    target.replace_filename(link);
  }
  return target.string();
}

/// A name beside `target` that no other thread or process uses.
std::string temporary_name(const std::string& target) {
  static std::atomic<unsigned> serial = 0;
  const std::string name = ".albedo-" + std::to_string(::getpid()) + "-" + std::to_string(serial++) + ".tmp";
  return std::filesystem::path(target).replace_filename(name).string();
}

std::string explain_missing(const std::string& target, int error) {
  const std::filesystem::path directory = std::filesystem::path(target).parent_path();
  std::error_code ignored;
  if (error == ENOENT && !directory.empty() && !std::filesystem::exists(directory, ignored)) {
    return "the directory '" + directory.string() + "' does not exist";
  }
  return std::generic_category().message(error);
}

}  // namespace

WriteError cannot_write(std::string_view path, std::string_view reason) {
  return WriteError("cannot write '" + std::string(path) + "': " + std::string(reason));
}

/// A large output buffer over a file descriptor that throws the reason of a failure.
class AtomicFile::Buffer : public std::streambuf {
 public:
  Buffer(int descriptor, std::string path) : descriptor_(descriptor), path_(std::move(path)), space_(1U << 20U) {
    setp(space_.data(), space_.data() + space_.size());
  }
  ~Buffer() override {
    if (is_open()) ::close(descriptor_);
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }

  void close(bool synchronise) {
    // A library that writes through the stream may have swallowed the failure: it is not forgotten here.
    if (error_ != 0) throw cannot_write(path_, error_);
    drain();
    // EINVAL: a file system without fsync.
    if (synchronise && ::fsync(descriptor_) != 0 && errno != EINVAL) fail();
    if (::close(std::exchange(descriptor_, -1)) != 0) fail();
  }

 protected:
  int_type overflow(int_type next) override {
    drain();
    if (!traits_type::eq_int_type(next, traits_type::eof())) sputc(traits_type::to_char_type(next));
    return traits_type::not_eof(next);
  }

  int sync() override {
    drain();
    return 0;
  }

  std::streamsize xsputn(const char* data, std::streamsize size) override {
    if (size < epptr() - pbase()) return std::streambuf::xsputn(data, size);
    drain();
    write_all(data, static_cast<std::size_t>(size));
    return size;
  }

  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode which) override {
    const off_type here = drained_ + (pptr() - pbase());
    if (from == std::ios_base::end) return {off_type(-1)};
    const off_type place = from == std::ios_base::cur ? here + offset : offset;
    return place == here ? pos_type(here) : seekpos(place, which);
  }

  pos_type seekpos(pos_type place, std::ios_base::openmode /*which*/) override {
    drain();
    if (::lseek(descriptor_, place, SEEK_SET) < 0) fail();
    drained_ = place;
    return place;
  }

 private:
  [[noreturn]] void fail() {
    error_ = errno;
    throw cannot_write(path_, error_);
  }

  void drain() {
    write_all(pbase(), static_cast<std::size_t>(pptr() - pbase()));
    setp(pbase(), epptr());
  }

  void write_all(const char* data, std::size_t size) {
    while (size > 0) {
      const ssize_t written = ::write(descriptor_, data, size);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail();
      data += written;
      size -= static_cast<std::size_t>(written);
      drained_ += written;
    }
  }

  int descriptor_;
  int error_ = 0;
  off_type drained_ = 0;  // the place in the file at which the buffer begins
  std::string path_;
  std::vector<char> space_;
};

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), target_(path_), stream_(nullptr) {
  int descriptor = -1;
  if (is_standard_output(path_)) {
    std::cout.flush();
    descriptor = ::dup(STDOUT_FILENO);
  } else if (const auto mode = existing_mode(path_); mode && !S_ISREG(*mode)) {
    descriptor = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    target_ = follow_links(path_);
    do {
      temporary_ = temporary_name(target_);
      descriptor = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor < 0 && errno == EEXIST);
    if (descriptor >= 0 && mode) static_cast<void>(::fchmod(descriptor, *mode & 0777U));
  }
  if (descriptor < 0) throw analysis::cannot_write(path_, explain_missing(target_, errno));
  buffer_ = std::make_unique<Buffer>(descriptor, path_);
  stream_.rdbuf(buffer_.get());
  stream_.exceptions(std::ios_base::badbit);  // passes the buffer's WriteError on
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::finish() {
  if (buffer_->is_open()) buffer_->close(!temporary_.empty());
}

void AtomicFile::commit() {
  finish();
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) throw cannot_write(path_, errno);
  temporary_.clear();
}

void AtomicFile::check(const std::string& path) {
  if (is_standard_output(path)) return;
  // A pipe must not be opened twice: its reader would take the first closing for the end.
  if (const auto mode = existing_mode(path); mode && !S_ISREG(*mode)) return;
  const AtomicFile probe(path);
}

std::string AtomicFile::target_of(const std::string& path) { return follow_links(path); }

}  // namespace albedo::analysis
