#include <algorithm>
#include <iostream>
#include <memory>

#include "albedo/core/model.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::string name;
  bool json = false, markdown = false;
};

/// What a model claims with its default parameters, as words.
std::string claims_text(const ModelInfo& info) {
  const Claims claims = info.claims;
  std::vector<std::string> words;
  if (claims.reciprocal) words.emplace_back("reciprocal");
  if (claims.conserves_energy) words.emplace_back("energy-conserving");
  if (claims.bounded) words.emplace_back("bounded");
  if (claims.isotropic) words.emplace_back("isotropic");
  if (claims.distribution == Measure::solid_angle) words.emplace_back("∫D = 1");
  if (claims.distribution == Measure::projected) words.emplace_back("∫D cosθ_h = 1");
  if (claims.consistent_masking) words.emplace_back("∫G₁D(L·H)₊ = N·L");
  return words.empty() ? "nothing" : joined(words, ", ");
}

std::string name_of(Measure measure) {
  if (measure == Measure::none) return "none";
  return measure == Measure::solid_angle ? "solid_angle" : "projected";
}

std::string default_text(const ParameterInfo& parameter) {
  if (parameter.is_text) return "FILE";
  if (parameter.is_choice()) return parameter.choices.at(static_cast<std::size_t>(parameter.default_value));
  return number_text(parameter.default_value, 6);
}

std::string range_text(const ParameterInfo& parameter) {
  if (parameter.is_text) return "must be given";
  if (parameter.is_choice()) return joined(parameter.choices, "|");
  return "[" + number_text(parameter.range.minimum, 6) + ", " + number_text(parameter.range.maximum, 6) + "]";
}

void print_text(const ModelInfo& info) {
  std::cout << info.name << ": " << info.title << "\n  source     " << info.source << "\n  deviation  "
            << info.deviation << "\n  claims     " << claims_text(info) << '\n';
  std::size_t name_width = 0, range_width = 0;
  for (const ParameterInfo& parameter : info.parameters) {
    name_width = std::max(name_width, parameter.name.size() + 1 + default_text(parameter).size());
    range_width = std::max(range_width, range_text(parameter).size());
  }
  const auto padded = [](std::string text, std::size_t width) {
    text.resize(std::max(width, text.size()), ' ');
    return text + "  ";
  };
  for (const ParameterInfo& parameter : info.parameters) {
    std::cout << "    " << padded(parameter.name + "=" + default_text(parameter), name_width)
              << padded(range_text(parameter), range_width) << parameter.meaning
              << (!parameter.per_channel  ? ""
                  : parameter.is_choice() ? "; all of them where it isn't given"
                                          : " (may be RGB)")
              << '\n';
  }
  for (const Shorthand& shorthand : info.shorthands) {
    std::cout << "    " << shorthand.name << " sets " << joined(shorthand.parameters, " and ") << '\n';
  }
}

Json parameter_json(const ParameterInfo& parameter) {
  Json object{{"name", parameter.name}, {"meaning", parameter.meaning}};
  if (parameter.is_text) {
    object["text"] = true;
  } else if (parameter.is_choice()) {
    object["default"] = default_text(parameter);
    object["choices"] = parameter.choices;
  } else {
    object["default"] = parameter.default_value;
    object["range"] = {parameter.range.minimum, parameter.range.maximum};
    object["per_channel"] = parameter.per_channel;
  }
  return object;
}

Json model_json(const ModelInfo& info) {
  Json object{{"name", info.name}, {"title", info.title}, {"source", info.source}, {"deviation", info.deviation}};
  object["parameters"] = Json::array();
  for (const ParameterInfo& parameter : info.parameters) object["parameters"].push_back(parameter_json(parameter));
  object["shorthands"] = Json::object();
  for (const Shorthand& shorthand : info.shorthands) object["shorthands"][shorthand.name] = shorthand.parameters;
  const Claims claims = info.claims;
  object["claims"] = {{"reciprocal", claims.reciprocal},
                      {"conserves_energy", claims.conserves_energy},
                      {"bounded", claims.bounded},
                      {"isotropic", claims.isotropic},
                      {"distribution", name_of(claims.distribution)},
                      {"consistent_masking", claims.consistent_masking}};
  return object;
}

using ModelInfos = std::vector<std::reference_wrapper<const ModelInfo>>;

void print_markdown(const ModelInfos& infos) {
  std::cout << "| model | title | parameters | claims | source |\n|---|---|---|---|---|\n";
  for (const ModelInfo& info : infos) {
    std::vector<std::string> parameters;
    for (const ParameterInfo& parameter : info.parameters) {
      parameters.push_back("`" + parameter.name + "=" + default_text(parameter) + "`");
    }
    std::cout << "| `" << info.name << "` | " << info.title << " | " << joined(parameters, " ") << " | "
              << claims_text(info) << " | " << info.source << " |\n";
  }
}

int run(const Arguments& arguments) {
  const bool is_list = arguments.name.empty();
  const ModelInfos infos = is_list ? model_infos() : ModelInfos{model_info(arguments.name)};
  if (arguments.markdown) {
    print_markdown(infos);
  } else if (arguments.json) {
    Json list = Json::array();
    for (const ModelInfo& info : infos) list.push_back(model_json(info));
    std::cout << json_text(is_list ? list : list.front()) << '\n';
  } else {
    for (const ModelInfo& info : infos) {
      if (&info != &infos.front().get()) std::cout << '\n';
      print_text(info);
    }
  }
  return exit_code::done;
}

}  // namespace

Command add_models(ProgramSyntax& program) {
  const auto arguments = std::make_shared<Arguments>();
  const Syntax app =
      program.subcommand("models", "the models: source, parameters, claims (for the default parameters)");
  app.text("NAME", arguments->name, "only this model").type_name("");
  const OptionSyntax json = app.flag("--json", arguments->json, "print JSON");
  app.flag("--markdown", arguments->markdown, "print a table for a text in Markdown").excludes(json);
  app.footer("Example: what are Ward's parameters?\n  albedo models ward");
  return {app, [arguments](const std::string&) { return run(*arguments); }};
}

}  // namespace albedo::analysis
