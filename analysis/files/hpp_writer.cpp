#include "analysis/files/hpp_writer.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <ostream>
#include <string_view>

#include "analysis/files/atomic_file.hpp"
#include "core/text.hpp"

namespace albedo::analysis {
namespace {

std::string identifier(const std::string& text) {
  std::string name = text;
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name.empty() || (name.front() >= '0' && name.front() <= '9') ? "_" + name : name;
}

std::string double_literal(double value) {
  if (std::isinf(value)) return std::string(value < 0 ? "-" : "") + "std::numeric_limits<double>::infinity()";
  std::string text;
  append_number(text, value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string string_literal(const std::string& text) {
  std::string literal = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::iscntrl(byte) != 0) {
      literal += '\\';
      for (const unsigned shift : {6U, 3U, 0U}) literal += static_cast<char>('0' + ((byte >> shift) & 7U));
    } else {
      if (c == '"' || c == '\\') literal += '\\';
      literal += c;
    }
  }
  return literal += '"';
}

/// Writes one constant array; `literal(i)` is its item i.
template <class Literal>
void write_array(std::ostream& out, std::string_view type, const std::string& name, std::size_t size, Literal literal) {
  constexpr std::size_t per_line = 4;
  out << "inline constexpr std::array<" << type << ", " << size << "> " << name << (size > 0 ? "{{" : "{");
  for (std::size_t i = 0; i < size; ++i) out << (i % per_line == 0 ? "\n    " : " ") << literal(i) << ',';
  out << (size > 0 ? "\n}};\n" : "};\n");
}

void write_axis(std::ostream& out, const std::string& name, const TableAxis& axis) {
  out << "\n/// Axis '" << comment_text(axis.name) << "'";
  if (!axis.unit.empty()) out << ", unit: " << comment_text(axis.unit);
  out << "\n";
  if (axis.is_categorical()) {
    write_array(out, "const char*", name, axis.size(), [&](std::size_t i) { return string_literal(axis.labels[i]); });
  } else {
    write_array(out, "double", name, axis.size(), [&](std::size_t i) { return double_literal(axis.values[i]); });
  }
}

}  // namespace

void write_hpp(const TableDocument& table, const std::string& path) {
  const std::string name = identifier(table.name);
  AtomicFile file(path);
  std::ostream& out = file.stream();

  out << "#pragma once\n\n";
  for (const auto& [key, item] : table.provenance.items()) out << "// " << key << ": " << comment_text(item) << '\n';
  out << "\n#include <array>\n#include <cstddef>\n#include <limits>\n\n";
  out << "/// The number of entries along each axis.\n";
  write_array(out, "std::size_t", name + "_shape", table.axes.size(),
              [&](std::size_t i) { return fmt::format("{}", table.axes[i].size()); });
  for (const TableAxis& axis : table.axes) write_axis(out, identifier(table.name + "_axis_" + axis.name), axis);
  out << "\n/// Entries in C order: the last axis runs fastest.\n";
  write_array(out, "double", name + "_values", table.size(),
              [&](std::size_t i) { return double_literal(table.values[i]); });
  file.commit();
}

}  // namespace albedo::analysis
