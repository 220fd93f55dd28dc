#include "analysis/commands/options.hpp"

#include "analysis/commands/checks.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "fuzz/fuzz.hpp"

ALBEDO_FUZZ_TARGET(options) {
  using namespace albedo;
  std::vector<std::string> words = fuzz::words(input);
  CLI::App app("options");
  analysis::ComputeOptions compute;
  analysis::ModelArguments arguments;
  std::vector<analysis::Assertion> assertions;
  analysis::add_compute_options(app, compute);
  analysis::add_model_arguments(app, arguments);
  analysis::add_assert_option(app, assertions);
  app.allow_extras();
  std::ranges::reverse(words);  // as CLI11 takes them
  try {
    app.parse(words);
  } catch (const CLI::Error&) {  // --help too
    return;
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
