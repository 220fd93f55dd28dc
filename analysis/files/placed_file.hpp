/// @file
/// A file whose parts are read and written in place, by several threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace albedo::analysis {

/// An open file. Every failure is a WriteError with the path that was given and the reason.
class PlacedFile {
 public:
  enum class Mode { create, reuse };

  /// Opens for reading and writing: a new, empty file (one of that name is unlinked, so that nobody who has it open
  /// writes to the new one), or one that exists.
  PlacedFile(std::string path, Mode mode);
  ~PlacedFile();
  PlacedFile(const PlacedFile&) = delete;
  PlacedFile& operator=(const PlacedFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const;

  /// Takes the place on the disk for this many bytes, where the file system can: a disk that is too small says so now.
  void reserve(std::uint64_t size);

  /// Refuses a file that another process has locked; held until the file is closed or the process ends.
  void lock();

  /// @throws WriteError if the file was removed or replaced since it was opened: what is written is lost
  void check_in_place() const;

  /// Reads all of the bytes. @throws WriteError also if the file ends before
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;

  /// Writes all of the bytes, however many the system takes at a time.
  void write(std::uint64_t offset, std::span<const std::byte> bytes);

  /// Returns when what was written is on the disk.
  void synchronise();

 private:
  std::string path_;
  int descriptor_;
};

/// Returns when the names of the folder that this file is in are on the disk, where the file system can tell.
void synchronise_directory_of(const std::string& path);

/// CRC-64/XZ (ECMA-182, reflected).
[[nodiscard]] std::uint64_t checksum(std::span<const std::byte> bytes);

}  // namespace albedo::analysis
