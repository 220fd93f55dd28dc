#include "analysis/files/table_document.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string_view>

#include "albedo/core/errors.hpp"
#include "analysis/files/atomic_file.hpp"
#include "analysis/files/csv_writer.hpp"
#include "analysis/files/exr_writer.hpp"
#include "analysis/files/hpp_writer.hpp"
#include "analysis/files/json_writer.hpp"
#include "analysis/files/npy_writer.hpp"
#include "core/text.hpp"

namespace albedo::analysis {
namespace {

struct Format {
  std::string_view ending;
  void (*write)(const TableDocument&, const std::string& path);
};

constexpr std::array formats{Format{".csv", write_csv}, Format{".json", write_json}, Format{".npy", write_npy},
                             Format{".exr", write_exr}, Format{".hpp", write_hpp}};

const Format& format_of(const std::string& path) {
  if (path == "-") return formats.front();
  const auto* const found = std::ranges::find(formats, ending_of(path), &Format::ending);
  if (found != formats.end()) return *found;

  const std::string ending = std::filesystem::path(path).extension().string();
  std::vector<std::string> endings;
  for (const Format& format : formats) endings.emplace_back(format.ending);
  throw ParameterError(fmt::format("output: '{}' has {}; valid are {}", path,
                                   ending.empty() ? "no ending" : fmt::format("the unknown ending '{}'", ending),
                                   joined(endings)));
}

void check_entries(const TableDocument& table, const std::string& path) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double value = table.values[i];
    if (std::isfinite(value) || value == std::numeric_limits<double>::infinity()) continue;
    std::string entry;
    append_number(entry, value);
    throw cannot_write(path, "the entry at " + describe_entry(table, i) + " is " + entry);
  }
}

}  // namespace

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

std::size_t TableDocument::size() const { return entry_count(axes); }

void write_table(const TableDocument& table, const std::string& path) {
  const Format& format = format_of(path);
  if (format.write == write_exr) check_exr_axes(table.axes);
  check_entries(table, path);
  format.write(table, path);
}

void check_table_path(const std::string& path, const std::vector<TableAxis>& axes) {
  const Format& format = format_of(path);
  if (format.write == write_exr) check_exr_axes(axes);
  AtomicFile::check(path);
  if (format.write == write_npy) AtomicFile::check(sidecar_path(path));
}

void append_number(std::string& text, double value) {
  std::array<char, 32> digits;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
  const auto end = std::to_chars(digits.begin(), digits.end(), value, std::chars_format::general, 17);
  text.append(digits.data(), end.ptr);
}

std::string axis_text(const TableAxis& axis, std::size_t index) {
  if (axis.is_categorical()) return axis.labels[index];
  std::string text;
  append_number(text, axis.values[index]);
  return text;
}

std::string describe_entry(const TableDocument& table, std::size_t entry) {
  std::string text;
  std::size_t block = table.size();
  for (const TableAxis& axis : table.axes) {
    block /= axis.size();
    if (!text.empty()) text += ", ";
    text.append(axis.name).append("=").append(comment_text(axis_text(axis, entry / block)));
    entry %= block;
  }
  return text;
}

std::string comment_text(const nlohmann::ordered_json& item) {
  if (item.is_string()) {
    const auto& text = item.get_ref<const std::string&>();
    // A line break would end the comment, a backslash at its end would continue it.
    const bool stays_on_line =
        std::ranges::none_of(text, [](unsigned char c) { return std::iscntrl(c) != 0 || c == '\\'; });
    if (stays_on_line) return text;
  }
  return item.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace albedo::analysis
