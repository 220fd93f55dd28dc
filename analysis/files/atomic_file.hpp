/// @file
/// A file that appears under its name only when it is whole.
#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <string_view>

#include "albedo/core/errors.hpp"

namespace albedo::analysis {

/// The one sentence of every failed output: "cannot write 'PATH': REASON".
[[nodiscard]] WriteError cannot_write(std::string_view path, std::string_view reason);

/// Writes to a temporary sibling of a path, which commit() renames to that path.
///
/// - Without a commit nothing is left behind, and a file of that name stays as it was.
/// - A new file's permissions follow the umask; a file that is replaced keeps its own.
/// - A symbolic link is followed: the file it names is written or replaced, not the link.
/// - "-" and "/dev/stdout" are standard output. That, and any target that is no regular file (a device, a pipe), is
///   written directly.
///
/// Every failure, also one met while writing to stream(), is a WriteError.
class AtomicFile {
 public:
  /// Opens the temporary file, or the target itself if that is no regular file.
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write; seekable if the target is. Blocks larger than its buffer of 1 MiB are passed on without a copy.
  [[nodiscard]] std::ostream& stream() { return stream_; }

  /// Brings everything to the disk under the temporary name, so that commit() is left with a rename only.
  void finish();

  /// Calls finish() if need be, and gives the file its name.
  void commit();

  /// Throws the WriteError that a file of this name would meet now: to be called before a long computation.
  static void check(const std::string& path);

  /// The path that is renamed to: symbolic links are followed.
  static std::string target_of(const std::string& path);

 private:
  class Buffer;

  std::string path_;       // as the user wrote it, for messages
  std::string target_;     // with symbolic links followed
  std::string temporary_;  // empty when the target is written directly, or once it is renamed
  std::unique_ptr<Buffer> buffer_;
  std::ostream stream_;
};

}  // namespace albedo::analysis
