#include "analysis/text/text.hpp"

#include <algorithm>
#include <cmath>

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

void append_json(std::string& text, const Json& value) {
  const bool is_list_of_objects = value.is_array() && !value.empty() && value.front().is_object();
  const char* separator = "";
  switch (value.type()) {
    case Json::value_t::object:
      text += '{';
      for (const auto& [key, item] : value.items()) {
        text.append(separator).append(json_text(Json(key))).append(": ");
        append_json(text, item);
        separator = ", ";
      }
      text += '}';
      break;
    case Json::value_t::array:
      text += '[';
      for (const Json& item : value) {
        text.append(separator).append(is_list_of_objects ? "\n  " : "");
        append_json(text, item);
        separator = is_list_of_objects ? "," : ", ";
      }
      text += ']';
      break;
    case Json::value_t::number_float:
      if (std::isfinite(value.get<double>())) {
        text += number_text(value.get<double>());
      } else {
        text += "null";
      }
      break;
    default:
      text += value.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
}

}  // namespace

std::string json_text(const Json& value) {
  std::string text;
  append_json(text, value);
  return text;
}

void print_columns(std::ostream& out, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      out << (i > 0 ? "  " : "") << std::string(widths[i] - row[i].size(), ' ') << row[i];
    }
    out << '\n';
  }
}

}  // namespace albedo::analysis
