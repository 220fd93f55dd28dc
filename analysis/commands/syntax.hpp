/// @file
/// What a subcommand takes on the command line. The parser behind it, CLI11, is read by syntax.cpp alone.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace albedo::analysis {

/// One option, to say more about it.
class OptionSyntax {
 public:
  explicit OptionSyntax(CLI::Option* option) : option_(option) {}

  /// What stands for the value in the help; nothing for a positional argument.
  OptionSyntax type_name(const std::string& name) const;
  OptionSyntax description(const std::string& text) const;
  /// The default as the help shows it.
  OptionSyntax default_text(const std::string& text) const;
  OptionSyntax required() const;
  OptionSyntax needs(OptionSyntax other) const;
  OptionSyntax excludes(OptionSyntax other) const;
  /// Given several times it takes one value each time.
  OptionSyntax one_at_a_time() const;

 private:
  CLI::Option* option_;
};

/// A subcommand. Targets must outlive the parsing; what a setter throws ends it.
class Syntax {
 public:
  explicit Syntax(CLI::App* app) : app_(app) {}

  OptionSyntax text(const std::string& names, std::string& target, const std::string& description) const;
  OptionSyntax texts(const std::string& names, std::vector<std::string>& target, const std::string& description) const;
  OptionSyntax parsed(const std::string& names, const std::function<void(const std::string&)>& set,
                      const std::string& description) const;
  OptionSyntax parsed_each(const std::string& names, const std::function<void(const std::vector<std::string>&)>& set,
                           const std::string& description) const;
  OptionSyntax flag(const std::string& names, bool& target, const std::string& description) const;
  /// One that there is.
  [[nodiscard]] OptionSyntax option(const std::string& name) const;
  /// What stands below the options in the help.
  void footer(const std::string& text) const;

  [[nodiscard]] std::string name() const;
  [[nodiscard]] bool was_given() const;
  /// Refuses a word that nothing has taken, with a suggestion. @throws ParameterError
  void check_understood() const;

 private:
  CLI::App* app_;
};

/// The program and its subcommands.
class ProgramSyntax {
 public:
  ProgramSyntax(const std::string& description, const std::string& name, const std::string& version);
  ~ProgramSyntax();
  ProgramSyntax(const ProgramSyntax&) = delete;
  ProgramSyntax& operator=(const ProgramSyntax&) = delete;

  Syntax subcommand(const std::string& name, const std::string& description);
  void footer(const std::string& text);

  /// Reads the command line; true if it only asked for --help or --version, which are printed.
  /// @throws ParameterError for what can't be understood, with a suggestion
  [[nodiscard]] bool parse(int argc, const char* const* argv);
  [[nodiscard]] std::string help() const;

 private:
  std::unique_ptr<CLI::App> app_;
  std::vector<std::string> names_;
};

}  // namespace albedo::analysis
