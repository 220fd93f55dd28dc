#include "analysis/files/rational_writer.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "albedo/core/errors.hpp"
#include "analysis/files/atomic_file.hpp"
#include "analysis/files/table_document.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

std::string identifier(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return text;
}

/// What one language writes for a number and for sqrt.
struct Language {
  int digits;
  std::string before, after, square_root;  ///< around a number's digits

  [[nodiscard]] std::string number(double value) const {
    std::string text = number_text(value, digits);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return before + text + after;
  }

  /// "x - 0.5" or "x + 0.5"
  [[nodiscard]] std::string from(double value) const {
    return "(x " + std::string(value < 0 ? "+ " : "- ") + number(std::abs(value)) + ")";
  }

  [[nodiscard]] std::string square(double u, double v2) const {
    return "(" + from(u) + " * " + from(u) + " + " + number(v2) + ")";
  }
};

/// The factors as a product over lines of text, after `first`.
std::string product(const RealFactors& factors, const Language& language, std::string first) {
  std::vector<std::string> terms;
  if (!first.empty()) terms.push_back(std::move(first));
  for (const double root : factors.roots) terms.push_back(language.from(root));
  for (const auto& [u, v2] : factors.pairs) terms.push_back(language.square(u, v2));
  return terms.empty() ? language.number(1) : joined(terms, "\n      * ");
}

/// x of cos_theta, and before it what it needs.
std::string variable_text(const RationalForm& form, const Language& language, const std::string& type) {
  const auto root = [&](const std::string& of) { return language.square_root + "(" + of + ")"; };
  const std::string c = "cos_theta", one = language.number(1),
                    sine2 = "(" + one + " - " + c + ") * (" + one + " + " + c + ")";
  std::string x, before;
  switch (form.variable) {
    case RationalVariable::cosine:
      x = c;
      break;
    case RationalVariable::square_root:
      x = root(c);
      break;
    case RationalVariable::fourth_root:
      x = root(root(c));
      break;
    case RationalVariable::half_elevation:
      x = c + " / (" + one + " + " + root(sine2) + ")";
      break;
    case RationalVariable::cotangent:
      x = c + " / (" + c + " + " + root(sine2) + ")";
      break;
    case RationalVariable::shifted_root:
      x = root(c + " + " + language.number(form.shift));
      break;
    case RationalVariable::scaled_slope:
      x = c + " / " + root(c + " * " + c + " + " + language.number(form.shift) + " * (" + sine2 + ")");
      break;
    case RationalVariable::scaled_half:
      before = "  " + type + " rest = " + language.number(form.shift) + " * (" + sine2 + ");\n  " + type +
               " w = " + root(c + " * " + c + " + rest") + ";\n";
      x = c + " / (w + " + root("rest * w / (w + " + c + ")") + ")";
      break;
  }
  return before + "  " + type + " x = " + x + ";\n";
}

std::string function_text(const RationalForm& form, const Language& language, const std::string& type,
                          const std::string& head) {
  const std::string& root = language.square_root;
  std::string result = "p / q";
  for (int exponent = form.exponent; exponent > 1; exponent /= 2) result = root + "(" + result + ")";
  for (int i = 0; i < std::abs(form.power); ++i) result += (form.power > 0 ? " * " : " / ") + root + "(cos_theta)";
  return head + " {\n" + variable_text(form, language, type) + "  " + type +
         " p = " + product(form.p, language, language.number(form.gain)) + ";\n  " + type +
         " q = " + product(form.q, language, "") + ";\n  return " + result + ";\n}\n";
}

std::string_view name_of(RationalVariable variable) {
  switch (variable) {
    case RationalVariable::cosine:
      return "c";
    case RationalVariable::square_root:
      return "c^(1/2)";
    case RationalVariable::fourth_root:
      return "c^(1/4)";
    case RationalVariable::half_elevation:
      return "c/(1+s)";
    case RationalVariable::cotangent:
      return "c/(c+s)";
    case RationalVariable::shifted_root:
      return "(c+d)^(1/2)";
    case RationalVariable::scaled_slope:
      return "c/(c^2+d*s^2)^(1/2)";
    case RationalVariable::scaled_half:
      return "1-(1-c/(c^2+d*s^2)^(1/2))^(1/2)";
  }
  return "";
}

std::string comments(const Json& provenance) {
  std::string text;
  for (const auto& [key, item] : provenance.items()) text += "// " + key + ": " + comment_text(item) + '\n';
  return text;
}

Json pairs_json(const std::vector<RealFactors::Pair>& pairs) {
  Json list = Json::array();
  for (const auto& [u, v2] : pairs) list.push_back(Json::array({u, v2}));
  return list;
}

}  // namespace

Json rational_json(const RationalForm& form) {
  return {{"variable", name_of(form.variable)},
          {"d", form.shift},
          {"exponent", form.exponent},
          {"power", form.power},
          {"gain", form.gain},
          {"zeros", form.p.roots},
          {"zero_pairs", pairs_json(form.p.pairs)},
          {"poles", form.q.roots},
          {"pole_pairs", pairs_json(form.q.pairs)}};
}

std::string rational_cpp(const RationalForm& form, const std::string& name, const Json& provenance) {
  const Language language{17, "T(", ")", "std::sqrt"};
  return "#pragma once\n\n" + comments(provenance) + "\n#include <cmath>\n\ntemplate <class T>\n" +
         function_text(form, language, "const T", "T " + identifier(name) + "(T cos_theta)");
}

std::string rational_glsl(const RationalForm& form, const std::string& name, const Json& provenance) {
  const Language language{9, "", "", "sqrt"};
  return comments(provenance) + '\n' +
         function_text(form, language, "float", "float " + identifier(name) + "(float cos_theta)");
}

void write_rational(const RationalForm& form, const std::string& name, const Json& provenance,
                    const std::string& path) {
  const std::string ending = ending_of(path);
  AtomicFile file(path);
  if (ending == ".json") {
    Json document = provenance;
    document["form"] = rational_json(form);
    file.stream() << json_text(document) << '\n';
  } else {
    file.stream() << (ending == ".glsl" ? rational_glsl(form, name, provenance) : rational_cpp(form, name, provenance));
  }
  file.commit();
}

void check_rational_path(const std::string& path) {
  const std::string ending = ending_of(path);
  if (path != "-" && ending != ".hpp" && ending != ".glsl" && ending != ".json") {
    throw ParameterError("the output '" + path + "' of a rational form must end in .hpp, .glsl or .json");
  }
  AtomicFile::check(path);
}

}  // namespace albedo::analysis
