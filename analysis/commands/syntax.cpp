#include "analysis/commands/syntax.hpp"

#include <CLI/CLI.hpp>

#include "albedo/core/errors.hpp"
#include "albedo/core/suggestion.hpp"

namespace albedo::analysis {
namespace {

/// Refuses what no option or subcommand has taken.
void check_remaining(const CLI::App& app, const std::vector<std::string>& candidates, const std::string& kind) {
  const std::vector<std::string> left = app.remaining();
  if (left.empty()) return;
  const std::string& word = left.front();
  const std::string close = suggestion(word, candidates);
  throw ParameterError("unknown " + kind + " '" + word + "'" +
                       (close.empty() ? "" : "; did you mean '" + close + "'?"));
}

}  // namespace

OptionSyntax OptionSyntax::type_name(const std::string& name) const {
  option_->type_name(name);
  return *this;
}
OptionSyntax OptionSyntax::description(const std::string& text) const {
  option_->description(text);
  return *this;
}
OptionSyntax OptionSyntax::default_text(const std::string& text) const {
  option_->default_str(text);
  return *this;
}
OptionSyntax OptionSyntax::required() const {
  option_->required();
  return *this;
}
OptionSyntax OptionSyntax::needs(OptionSyntax other) const {
  option_->needs(other.option_);
  return *this;
}
OptionSyntax OptionSyntax::excludes(OptionSyntax other) const {
  option_->excludes(other.option_);
  return *this;
}
OptionSyntax OptionSyntax::one_at_a_time() const {
  option_->allow_extra_args(false);
  return *this;
}

OptionSyntax Syntax::text(const std::string& names, std::string& target, const std::string& description) const {
  return OptionSyntax(app_->add_option(names, target, description));
}
OptionSyntax Syntax::texts(const std::string& names, std::vector<std::string>& target,
                           const std::string& description) const {
  return OptionSyntax(app_->add_option(names, target, description));
}
OptionSyntax Syntax::parsed(const std::string& names, const std::function<void(const std::string&)>& set,
                            const std::string& description) const {
  return OptionSyntax(app_->add_option_function<std::string>(names, set, description));
}
OptionSyntax Syntax::parsed_each(const std::string& names,
                                 const std::function<void(const std::vector<std::string>&)>& set,
                                 const std::string& description) const {
  return OptionSyntax(app_->add_option_function<std::vector<std::string>>(names, set, description));
}
OptionSyntax Syntax::flag(const std::string& names, bool& target, const std::string& description) const {
  return OptionSyntax(app_->add_flag(names, target, description));
}
OptionSyntax Syntax::option(const std::string& name) const { return OptionSyntax(app_->get_option(name)); }
void Syntax::footer(const std::string& text) const { app_->footer(text); }

std::string Syntax::name() const { return app_->get_name(); }
bool Syntax::was_given() const { return app_->parsed(); }

void Syntax::check_understood() const {
  std::vector<std::string> names;
  for (const CLI::Option* option : app_->get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  check_remaining(*app_, names, "option");
}

ProgramSyntax::ProgramSyntax(const std::string& description, const std::string& name, const std::string& version)
    : app_(std::make_unique<CLI::App>(description, name)) {
  app_->set_version_flag("--version", version);
  app_->require_subcommand(0, 1);
  app_->allow_extras();
}
ProgramSyntax::~ProgramSyntax() = default;

Syntax ProgramSyntax::subcommand(const std::string& name, const std::string& description) {
  CLI::App* const command = app_->add_subcommand(name, description);
  command->allow_extras();  // so that check_remaining() words the error
  names_.push_back(name);
  return Syntax(command);
}

void ProgramSyntax::footer(const std::string& text) { app_->footer(text); }

bool ProgramSyntax::parse(int argc, const char* const* argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    app_->exit(help_or_version);
    return true;
  } catch (const CLI::Error& error) {
    throw ParameterError(error.what());
  }
  check_remaining(*app_, names_, "subcommand");
  return false;
}

std::string ProgramSyntax::help() const { return app_->help(); }

}  // namespace albedo::analysis
