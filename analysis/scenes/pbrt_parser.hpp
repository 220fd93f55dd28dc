/// @file
/// The text of pbrt-v4 scenes as directives.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace albedo::analysis {

/// "rgb reflectance" [ 0.1 0.2 0.3 ]
struct PbrtParameter {
  std::string type{}, name{};
  std::vector<std::string> values{};
  std::size_t line = 0;
};

/// Material "diffuse" "rgb reflectance" [ 0.1 0.2 0.3 ]
struct PbrtDirective {
  std::string name;                  ///< "Material"
  std::vector<std::string> texts{};  ///< in front of the parameters: "diffuse"
  std::vector<PbrtParameter> parameters{};
  std::size_t line = 0;

  [[nodiscard]] const PbrtParameter* find(std::string_view parameter) const;
};

/// Cuts a file's text into directives. Values of directives that say nothing of materials are skipped, not kept.
class PbrtParser {
 public:
  PbrtParser(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  /// The next one, or nothing at the end of the text. @throws FormatError
  std::optional<PbrtDirective> next();

 private:
  struct Token {
    std::string_view text;
    bool is_quoted = false;
    std::size_t line = 0;
  };

  std::optional<Token> peek();
  void take() { ahead_.reset(); }
  void read_values(PbrtParameter& parameter, bool keep);
  [[noreturn]] void fail(std::size_t line, const std::string& problem) const;

  std::string_view text_;
  std::string file_;
  std::size_t position_ = 0, line_ = 1;
  std::optional<Token> ahead_{};
};

}  // namespace albedo::analysis
