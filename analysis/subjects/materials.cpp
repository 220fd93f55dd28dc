#include "analysis/subjects/materials.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <system_error>

#include "albedo/core/errors.hpp"
#include "core/text.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t largest_file = std::size_t{64} << 20U;
constexpr std::size_t largest_entry = std::size_t{1} << 20U;
constexpr std::size_t deepest_nesting = 32;
constexpr std::string_view blanks = " \t\r\n";

/// The text of one material, and where it begins.
struct Entry {
  std::string_view text;
  std::size_t line;
};

std::size_t count_lines(std::string_view text) { return static_cast<std::size_t>(std::ranges::count(text, '\n')); }

/// A name from the file, fit for a message of one line.
std::string quoted(const std::string& name) {
  std::string text = Json(name.substr(0, 60)).dump(-1, ' ', false, Json::error_handler_t::replace);
  std::ranges::replace(text, '\x7f', '?');  // the one control character that JSON leaves as it is
  return text;
}

/// What no name of a model or a parameter has, and a terminal may obey where a message cites it.
bool has_control_character(const std::string& text) {
  return std::ranges::any_of(text, [](unsigned char c) { return c < ' ' || c == 0x7f; });
}

/// Parses the entries of one file; every message begins with the file and the line.
class MaterialsParser {
 public:
  MaterialsParser(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  std::vector<Material> parse() {
    if (text_.starts_with("\xEF\xBB\xBF")) position_ = 3;  // the byte order mark of UTF-8
    skip_blanks();
    if (at_end()) throw FormatError("'" + file_ + "' is empty; it should hold materials");
    if (text_[position_] == '[') {
      parse_array();
    } else {
      parse_lines();
    }
    if (materials_.empty()) throw FormatError("'" + file_ + "' holds no materials");
    return std::move(materials_);
  }

 private:
  void parse_array() {
    advance(1);
    skip_blanks();
    bool is_closed = !at_end() && text_[position_] == ']';
    while (!is_closed) {
      const Entry entry = next_element();
      if (!entry.text.empty() || !at_end()) add(entry);
      if (at_end()) fail(entry.line, "the array has no end; is the file cut off?");
      is_closed = text_[position_] == ']';
      if (!is_closed) {
        advance(1);
        skip_blanks();
      }
    }
    advance(1);
    skip_blanks();
    if (!at_end()) fail(line_, "there is more text behind the end of the array");
  }

  /// The text up to the comma or bracket that ends an element of the outermost array.
  Entry next_element() {
    const std::size_t begin = position_;
    std::size_t depth = 0;
    bool in_string = false;
    std::size_t end = begin;
    for (; end < text_.size(); ++end) {
      const char c = text_[end];
      if (in_string) {
        if (c == '\\') {
          ++end;
        } else if (c == '"') {
          in_string = false;
        }
      } else if (c == '"') {
        in_string = true;
      } else if (c == '{' || c == '[') {
        ++depth;
      } else if (depth == 0 && (c == ',' || c == ']')) {
        break;
      } else if ((c == '}' || c == ']') && depth > 0) {
        --depth;
      }
    }
    const Entry entry{text_.substr(begin, end - begin), line_};
    advance(std::min(end, text_.size()) - begin);
    return entry;
  }

  void parse_lines() {
    while (!at_end()) {
      const std::size_t end = std::min(text_.find('\n', position_), text_.size());
      add({text_.substr(position_, end - position_), line_});
      advance(end - position_);
      skip_blanks();
    }
  }

  void add(const Entry& entry) {
    const Json json = parse_json(entry);
    if (!json.is_object()) fail(entry.line, R"(a material must be an object {"name", "model", "parameters"})");
    Material material{.name = text_member(json, "name", entry.line),
                      .model = text_member(json, "model", entry.line),
                      .parameters = {},
                      .line = entry.line};
    if (has_control_character(material.model)) fail(entry.line, "\"model\" has a control character");
    const auto parameters = json.find("parameters");
    if (parameters == json.end()) fail(entry.line, "the material has no \"parameters\"");
    if (!parameters->is_object()) fail(entry.line, "\"parameters\" must be an object");
    for (const auto& [name, value] : parameters->items()) {
      const std::optional<ParameterValue> parameter = parameter_value(value);
      if (!parameter) {
        fail(entry.line, "the parameter " + quoted(name) + " must be a number, a name or an array of three numbers");
      }
      const auto* const text = std::get_if<std::string>(&*parameter);
      if (has_control_character(name) || (text != nullptr && has_control_character(*text))) {
        fail(entry.line, "the parameter " + quoted(name) + " has a control character in its name or value");
      }
      material.parameters.emplace_back(name, *parameter);
    }
    read_number(json, "scale", entry.line, material.scale);
    read_number(json, "lambertian", entry.line, material.lambertian);
    materials_.push_back(std::move(material));
  }

  Json parse_json(const Entry& entry) const {
    if (entry.text.find_first_not_of(blanks) == std::string_view::npos) fail(entry.line, "an entry is missing");
    if (entry.text.size() > largest_entry) fail(entry.line, "the entry is longer than 1 MiB");

    std::vector<std::set<std::string>> keys;  // of the objects that are open
    const auto check = [&](int depth, Json::parse_event_t event, const Json& parsed) {
      if (depth > static_cast<int>(deepest_nesting)) fail(entry.line, "the entry is nested too deeply");
      if (event == Json::parse_event_t::object_start) keys.emplace_back();
      if (event == Json::parse_event_t::object_end) keys.pop_back();
      if (event == Json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second) {
        fail(entry.line, quoted(parsed.get<std::string>()) + " is given twice");
      }
      return true;
    };
    try {
      return Json::parse(entry.text, check);
    } catch (const Json::parse_error& error) {
      fail(entry.line, describe(error, entry));
    } catch (const Json::exception&) {
      fail(entry.line, "the entry holds a number beyond the range of a double");
    }
  }

  static std::string describe(const Json::parse_error& error, const Entry& entry) {
    if (error.byte > entry.text.size()) return "the entry ends too early; is the file cut off?";
    const std::string_view before = entry.text.substr(0, error.byte > 0 ? error.byte - 1 : 0);
    const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 = 0
    return fmt::format("the entry is not JSON (at line {}, byte {}{}", entry.line + count_lines(before),
                       before.size() - line_begin + 1, line_begin == 0 ? " of the entry)" : ")");
  }

  std::string text_member(const Json& json, const char* key, std::size_t line) const {
    const auto member = json.find(key);
    if (member == json.end()) fail(line, "the material has no " + quoted(key));
    if (!member->is_string() || member->get_ref<const std::string&>().empty()) {
      fail(line, quoted(key) + " must be a text that is not empty");
    }
    return member->get<std::string>();
  }

  void read_number(const Json& json, const char* key, std::size_t line, ParameterValue& target) const {
    const auto member = json.find(key);
    if (member == json.end()) return;
    const std::optional<ParameterValue> value = parameter_value(*member);
    if (!value || std::holds_alternative<std::string>(*value)) {
      fail(line, quoted(key) + " must be a number or an array of three numbers");
    }
    target = *value;
  }

  static std::optional<ParameterValue> parameter_value(const Json& json) {
    if (json.is_number()) return json.get<double>();
    if (json.is_string()) return json.get<std::string>();
    const bool is_rgb = json.is_array() && json.size() == 3 &&
                        std::ranges::all_of(json, [](const Json& item) { return item.is_number(); });
    if (is_rgb) return json.get<std::array<double, 3>>();
    return std::nullopt;
  }

  [[nodiscard]] bool at_end() const { return position_ == text_.size(); }

  void advance(std::size_t bytes) {
    line_ += count_lines(text_.substr(position_, bytes));
    position_ += bytes;
  }

  void skip_blanks() { advance(std::min(text_.find_first_not_of(blanks, position_), text_.size()) - position_); }

  [[noreturn]] void fail(std::size_t line, const std::string& problem) const {
    throw FormatError(fmt::format("'{}', line {}: {}", file_, line, problem));
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;  // of position_
  std::vector<Material> materials_;
};

[[noreturn]] void cannot_read(const std::string& path, const std::string& reason) {
  throw FormatError("cannot read '" + path + "': " + reason);
}

std::string read_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) cannot_read(path, std::generic_category().message(errno));
  std::string text;
  std::array<char, 1U << 16U> block;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
  while (const std::size_t size = std::fread(block.data(), 1, block.size(), file.get())) {
    if (text.size() + size > largest_file) cannot_read(path, "it is larger than 64 MiB");
    text.append(block.data(), size);
  }
  if (std::ferror(file.get()) != 0) cannot_read(path, std::generic_category().message(errno));
  return text;
}

}  // namespace

std::vector<Material> read_materials(const std::string& path) { return parse_materials(read_file(path), path); }

std::vector<Material> parse_materials(std::string_view text, const std::string& file) {
  return MaterialsParser(text, file).parse();
}

}  // namespace albedo::analysis
