#include "analysis/commands/model_arguments.hpp"

#include <cmath>

#include "fuzz/fuzz.hpp"

ALBEDO_FUZZ_TARGET(model_arguments) {
  using namespace albedo;
  const std::vector<std::string> words = fuzz::words(input);
  fuzz::accepts<Error>([&] { analysis::split_models(words); }, fuzz::Cited::command);
  if (words.empty()) return;
  const analysis::ModelArguments arguments{.model = words.front(), .parameters = {words.begin() + 1, words.end()}};
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

#ifdef ALBEDO_LIBFUZZER
/// The nodes of rules are computed once, which isn't the first input's doing.
extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  albedo::analysis::ModelArguments{.model = "coupled", .parameters = {"ggx:alpha=0.2,f0=0.04"}}.make();
  return 0;
}
#endif
