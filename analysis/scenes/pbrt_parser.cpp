#include "analysis/scenes/pbrt_parser.hpp"

#include <algorithm>
#include <cctype>

#include "analysis/scenes/scene_files.hpp"

namespace albedo::analysis {
namespace {

constexpr std::size_t most_parameters = 1000, most_values = 10'000;

/// Whether a word that isn't quoted starts a directive, and is no number or boolean.
bool is_directive(std::string_view word) {
  return std::isalpha(static_cast<unsigned char>(word[0])) != 0 && word != "true" && word != "false" && word != "nan" &&
         word != "inf";
}

}  // namespace

const PbrtParameter* PbrtDirective::find(std::string_view parameter) const {
  const auto found =
      std::ranges::find_if(parameters, [&](const PbrtParameter& candidate) { return candidate.name == parameter; });
  return found == parameters.end() ? nullptr : &*found;
}

std::optional<PbrtParser::Token> PbrtParser::peek() {
  if (ahead_) return ahead_;
  for (; position_ < text_.size(); ++position_) {
    const char c = text_[position_];
    if (c == '#') position_ = std::min(text_.find('\n', position_), text_.size() - 1);
    if (text_[position_] == '\n') ++line_;
    if (c != '#' && c != ' ' && (c < '\t' || c > '\r')) break;
  }
  if (position_ >= text_.size()) return std::nullopt;
  const std::size_t begin = position_;
  const char first = text_[begin];
  Token token{.text = {}, .is_quoted = first == '"', .line = line_};
  if (token.is_quoted) {
    std::size_t end = begin + 1;
    while (end < text_.size() && text_[end] != '"' && text_[end] != '\n') end += text_[end] == '\\' ? 2U : 1U;
    if (end >= text_.size() || text_[end] != '"') fail(line_, "a quotation mark has no partner");
    token.text = text_.substr(begin + 1, end - begin - 1);
    position_ = end + 1;
  } else {
    position_ = first == '[' || first == ']' ? begin + 1
                                             : std::min(text_.find_first_of(" \t\n\v\f\r\"[]#", begin), text_.size());
    token.text = text_.substr(begin, position_ - begin);
  }
  ahead_ = token;
  return ahead_;
}

std::optional<PbrtDirective> PbrtParser::next() {
  const std::optional<Token> head = peek();
  if (!head) return std::nullopt;
  if (head->is_quoted || !is_directive(head->text)) {
    fail(head->line, "a directive is expected, not " + in_quotes(head->text));
  }
  take();
  PbrtDirective directive{.name = std::string(head->text), .line = head->line};
  const std::string& name = directive.name;
  const bool keep = name == "Material" || name == "MakeNamedMaterial" || name == "Texture";
  const std::size_t texts = name == "Texture" ? 3 : 1;
  for (auto token = peek(); token && (token->is_quoted || !is_directive(token->text)); token = peek()) {
    take();
    if (!token->is_quoted) continue;  // the numbers of a transformation
    if (directive.texts.size() < texts) {
      directive.texts.emplace_back(token->text);
      continue;
    }
    PbrtParameter parameter{.line = token->line};
    const std::string_view declared = token->text;
    const std::size_t type_end = std::min(declared.find_first_of(" \t"), declared.size());
    const std::size_t begin = std::min(declared.find_first_not_of(" \t", type_end), declared.size());
    const std::size_t end = std::min(declared.find_first_of(" \t", begin), declared.size());
    parameter.type = declared.substr(0, type_end);
    parameter.name = declared.substr(begin, end - begin);
    read_values(parameter, keep);
    if (!keep) continue;
    if (directive.parameters.size() == most_parameters)
      fail(parameter.line, "a directive has more than 1000 parameters");
    directive.parameters.push_back(std::move(parameter));
  }
  return directive;
}

void PbrtParser::read_values(PbrtParameter& parameter, bool keep) {
  const auto incomplete = [&]() {
    fail(parameter.line,
         "the parameter " + in_quotes(parameter.type + " " + parameter.name) + " has no end; is the file cut off?");
  };
  std::optional<Token> token = peek();
  if (!token) incomplete();
  take();
  const bool is_list = !token->is_quoted && token->text == "[";
  while (is_list) {
    token = peek();
    if (!token) incomplete();
    take();
    if (!token->is_quoted && token->text == "]") return;
    if (!keep) continue;
    if (parameter.values.size() == most_values) fail(token->line, "a material's parameter has more than 10000 values");
    parameter.values.emplace_back(token->text);
  }
  if (keep) parameter.values.emplace_back(token->text);
}

void PbrtParser::fail(std::size_t line, const std::string& problem) const { fail_at(file_, line, problem); }

}  // namespace albedo::analysis
