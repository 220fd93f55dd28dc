#include "analysis/commands/model_arguments.hpp"

#include <cmath>

#include "fuzz/fuzz.hpp"

ALBEDO_FUZZ_TARGET(model_arguments) {
  using namespace albedo;
  if (std::ranges::any_of(input, [](unsigned char c) { return (c < ' ' && c != '\n') || c == 0x7f; })) return;
  const std::vector<std::string> words = fuzz::words(input);
  fuzz::accepts<Error>([&] { analysis::split_models(words); });
  if (words.empty()) return;
  const analysis::ModelArguments arguments{.model = words.front(), .parameters = {words.begin() + 1, words.end()}};
  fuzz::accepts<Error>([&] {
    for (const std::string& channel : arguments.channels()) {
      for (const auto& [name, value] : arguments.make(channel)->parameters()) {
        const double* const number = std::get_if<double>(&value);
        fuzz::require(number == nullptr || std::isfinite(*number), name + " isn't finite");
      }
    }
  });
}
