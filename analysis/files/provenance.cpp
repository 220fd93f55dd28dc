#include "analysis/files/provenance.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "albedo/version.hpp"

namespace albedo::analysis {
namespace {

bool is_plain(unsigned char c) {
  return std::isalnum(c) != 0 || std::string_view("_-+=:,./@%").find(static_cast<char>(c)) != std::string_view::npos;
}

std::string shell_quoted(std::string_view word) {
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return std::string(word);
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::string program_name(int argc, const char* const* argv) {
  const std::string_view path = argc > 0 ? argv[0] : "";
  const std::string_view name = path.substr(path.rfind('/') + 1);  // npos + 1 = 0
  return std::string(name.empty() ? "albedo" : name);
}

std::string quoted_command_line(int argc, const char* const* argv) {
  std::string text = shell_quoted(program_name(argc, argv));
  for (int i = 1; i < argc; ++i) text += ' ' + shell_quoted(argv[i]);
  return text;
}

nlohmann::ordered_json begin_provenance(const std::string& command_line) {
  return {{"generator", "albedo " + std::string(version)}, {"command", command_line}};
}

nlohmann::ordered_json describe_axes(const std::vector<TableAxis>& axes) {
  auto object = nlohmann::ordered_json::object();
  for (const TableAxis& axis : axes) {
    if (axis.is_categorical()) {
      object[axis.name] = {{"count", axis.size()}};
    } else {
      object[axis.name] = {{"from", axis.values.front()}, {"to", axis.values.back()}, {"count", axis.size()}};
    }
  }
  return object;
}

}  // namespace albedo::analysis
