#include "analysis/commands/model_arguments.hpp"

#include <cmath>

#include "fuzz/fuzz.hpp"

ALBEDO_FUZZ_TARGET(model_arguments) {
  using namespace albedo;
  const std::vector<std::string> words = fuzz::words(input);
  fuzz::accepts<Error>([&] { analysis::split_models(words); }, fuzz::Cited::command);
  if (words.empty()) return;
  const analysis::ModelArguments arguments{.model = words.front(), .parameters = {words.begin() + 1, words.end()}};
  if (arguments.model == "coupled") return;  // which integrates when it is made: half a second under the sanitizers
  fuzz::accepts<Error>(
      [&] {
        for (const std::string& channel : arguments.channels()) {
          for (const auto& [name, value] : arguments.make(channel)->parameters()) {
            const double* const number = std::get_if<double>(&value);
            fuzz::require(number == nullptr || std::isfinite(*number), name + " isn't finite");
          }
        }
      },
      fuzz::Cited::command);
}
