#include "analysis/commands/options.hpp"

#include "analysis/commands/checks.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "fuzz/fuzz.hpp"

ALBEDO_FUZZ_TARGET(options) {
  using namespace albedo;
  const std::vector<std::string> words = fuzz::words(input);
  std::vector<const char*> arguments_of_main{"albedo", "options"};
  for (const std::string& word : words) arguments_of_main.push_back(word.c_str());
  analysis::ProgramSyntax program("fuzzed", "albedo", "albedo");
  const analysis::Syntax command = program.subcommand("options", "");
  analysis::ComputeOptions compute;
  analysis::ModelArguments arguments;
  std::vector<analysis::Assertion> assertions;
  analysis::add_compute_options(command, compute);
  analysis::add_model_arguments(command, arguments);
  analysis::add_assert_option(command, assertions);
  try {
    if (program.parse(static_cast<int>(arguments_of_main.size()), arguments_of_main.data())) return;  // --help
    command.check_understood();
  } catch (const ParameterError& error) {
    fuzz::require(!std::string_view(error.what()).empty(), "a message without text");
    return;
  }
  const AlbedoOptions options = compute.albedo();
  fuzz::require(options.tolerance > 0 && options.tolerance < 1 && options.budget > 0 && compute.threads >= 0 &&
                    arguments.corrections.rho >= 0 && arguments.corrections.rho <= 1 &&
                    arguments.corrections.pump.times >= 0,
                "an option outside of its range");
}
