#include "analysis/scenes/scene_files.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <system_error>

#include "albedo/core/errors.hpp"

namespace albedo::analysis {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_read(const std::string& name, const std::string& reason) {
  throw FormatError("cannot read '" + name + "': " + reason);
}

bool lies_within(const fs::path& path, const fs::path& directory) {
  return std::mismatch(directory.begin(), directory.end(), path.begin(), path.end()).first == directory.end();
}

}  // namespace

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string result = "'";
  for (const char c : text.substr(0, longest)) result += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? '?' : c;
  return result + (text.size() > longest ? "...'" : "'");
}

void fail_at(const std::string& file, std::size_t line, const std::string& problem) {
  throw FormatError("'" + file + "', line " + std::to_string(line) + ": " + problem);
}

double number_in(std::string_view what, std::string_view text, const std::string& file, std::size_t line) {
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc() && end == digits.data() + digits.size() && std::isfinite(value)) return value;
  fail_at(file, line, std::string(what) + " = " + in_quotes(text) + " is not a finite number");
}

SceneFiles::SceneFiles(const std::string& path) : path_(path) {
  std::error_code error;
  const fs::path canonical = fs::canonical(path, error);
  if (error) cannot_read(path, error.message());
  root_ = canonical.parent_path();
}

std::string SceneFiles::open() { return read(fs::canonical(path_), path_); }

std::string SceneFiles::open(const std::string& name, const std::string& file, std::size_t line) {
  const std::string what = "the include " + in_quotes(name);
  if (++includes_ > most_includes) fail_at(file, line, "the scene includes more than 10000 files");
  if (open_.size() >= deepest_include) fail_at(file, line, what + " is nested more than 32 deep");
  std::error_code error;
  fs::path path = fs::weakly_canonical(root_ / name, error);
  if (!error && !fs::exists(path, error)) path = fs::weakly_canonical(open_.back().path.parent_path() / name, error);
  // the place is judged before the file is looked at, so that nothing is told of what lies outside
  if (error || !lies_within(path, root_)) {
    fail_at(file, line, what + " is outside of the scene's directory, " + in_quotes(root_.string()));
  }
  if (std::ranges::any_of(open_, [&](const Open& open) { return open.path == path; })) {
    fail_at(file, line, what + " includes itself");
  }
  if (!fs::exists(path, error)) fail_at(file, line, what + " doesn't exist");
  const fs::path shown = fs::path(path_).parent_path() / path.lexically_relative(root_);
  return read(path, shown.string());
}

std::string SceneFiles::read(const fs::path& path, const std::string& name) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) cannot_read(name, "it is not a regular file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) cannot_read(name, std::generic_category().message(errno));
  std::string text;
  std::vector<char> block(std::size_t{1} << 16U);
  while (const std::size_t size = std::fread(block.data(), 1, block.size(), file.get())) {
    if (text.size() + size > largest_file) cannot_read(name, "it is larger than 64 MiB");
    text.append(block.data(), size);
  }
  if (std::ferror(file.get()) != 0) cannot_read(name, std::generic_category().message(errno));
  bytes_ += text.size();
  if (bytes_ > largest_scene) cannot_read(name, "the scene's files together are larger than 256 MiB");
  if (text.starts_with("\x1f\x8b")) cannot_read(name, "it is compressed; unpack it first");
  const std::size_t zero = text.find('\0');
  if (zero != std::string::npos) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(zero);
    fail_at(name, 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n')), "there is a NUL byte in the text");
  }
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  open_.push_back({path, name});
  return text;
}

}  // namespace albedo::analysis
