#include "analysis/files/placed_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <boost/crc.hpp>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "analysis/files/atomic_file.hpp"

namespace albedo::analysis {
namespace {

[[noreturn]] void fail(const std::string& path, int error) {
  throw cannot_write(path, std::generic_category().message(error));
}

}  // namespace

PlacedFile::PlacedFile(std::string path, Mode mode) : path_(std::move(path)) {
  if (mode == Mode::create) ::unlink(path_.c_str());
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CLOEXEC | (mode == Mode::create ? O_CREAT | O_EXCL : 0), 0666);
  if (descriptor_ < 0) fail(path_, errno);
}

PlacedFile::~PlacedFile() { ::close(descriptor_); }

std::uint64_t PlacedFile::size() const {
  struct stat info {};
  if (::fstat(descriptor_, &info) != 0) fail(path_, errno);
  return static_cast<std::uint64_t>(info.st_size);
}

void PlacedFile::reserve(std::uint64_t size) {
  int result = 0;
  do {
    result = ::fallocate(descriptor_, 0, 0, static_cast<off_t>(size));
  } while (result != 0 && errno == EINTR);
  if (result == 0) return;
  if (errno != EOPNOTSUPP && errno != ENOSYS) fail(path_, errno);
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) fail(path_, errno);
}

void PlacedFile::lock() {
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  if (errno == EWOULDBLOCK) throw cannot_write(path_, "another process is writing it");
  if (errno != EOPNOTSUPP && errno != ENOLCK && errno != ENOSYS) fail(path_, errno);
}

void PlacedFile::check_in_place() const {
  struct stat opened {
  }, named{};
  if (::fstat(descriptor_, &opened) != 0) fail(path_, errno);
  const bool is_named = ::stat(path_.c_str(), &named) == 0;
  if (is_named && named.st_ino == opened.st_ino && named.st_dev == opened.st_dev) return;
  throw cannot_write(path_, "it was removed or replaced while it was being written");
}

void PlacedFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t count = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path_, errno);
    if (count == 0) throw cannot_write(path_, "it ends after " + std::to_string(offset) + " bytes");
    offset += static_cast<std::uint64_t>(count);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

void PlacedFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path_, errno);
    offset += static_cast<std::uint64_t>(count);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

void PlacedFile::synchronise() {
  // EINVAL: a file system without fsync.
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL) fail(path_, errno);
}

void synchronise_directory_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // a folder that may be written but not read
  static_cast<void>(::fsync(descriptor));
  ::close(descriptor);
}

std::uint64_t checksum(std::span<const std::byte> bytes) {
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693, ~std::uint64_t{0}, ~std::uint64_t{0}, true, true> crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

}  // namespace albedo::analysis
