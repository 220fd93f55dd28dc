/// @file
/// The files of a scene: what an include may name, and how much of it is read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace albedo::analysis {

/// A name or a value from a file, in quotes and short enough for a message of one line.
std::string in_quotes(std::string_view text);

/// @throws FormatError "'file', line n: problem"
[[noreturn]] void fail_at(const std::string& file, std::size_t line, const std::string& problem);

/// A finite number, whole text. @throws FormatError naming `what`
double number_in(std::string_view what, std::string_view text, const std::string& file, std::size_t line);

/// Opens a scene file and those it includes. An include must lie in the scene file's directory or below, whatever links
/// and dots its path has; it may not include itself, directly or by way of others.
class SceneFiles {
 public:
  static constexpr std::size_t largest_file = std::size_t{64} << 20U;    ///< bytes
  static constexpr std::size_t largest_scene = std::size_t{256} << 20U;  ///< bytes, all includes together
  static constexpr std::size_t most_includes = 10'000, deepest_include = 32;

  /// @param path of the scene file
  explicit SceneFiles(const std::string& path);

  /// Reads the scene file itself. @throws FormatError
  std::string open();

  /// Reads an include, and counts it as open until close() is called.
  /// @param name as it stands in `file`, relative to the scene file's directory or to that of `file`
  /// @throws FormatError naming the file and the line of the include
  std::string open(const std::string& name, const std::string& file, std::size_t line);
  void close() { open_.pop_back(); }

  /// What messages and materials call the file that was opened last.
  [[nodiscard]] const std::string& name() const { return open_.back().name; }

 private:
  struct Open {
    std::filesystem::path path;  // canonical
    std::string name;
  };

  std::string read(const std::filesystem::path& path, const std::string& name);

  std::string path_;
  std::filesystem::path root_;
  std::vector<Open> open_;
  std::size_t bytes_ = 0, includes_ = 0;
};

}  // namespace albedo::analysis
