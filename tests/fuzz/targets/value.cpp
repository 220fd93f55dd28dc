#include "analysis/text/value.hpp"

#include <cmath>

#include "analysis/commands/option_kinds.hpp"
#include "fuzz/fuzz.hpp"

ALBEDO_FUZZ_TARGET(value) {
  using namespace albedo;
  input = fuzz::argument(input);
  using fuzz::accepts, fuzz::require;
  const auto are_finite = [](const std::vector<double>& values) {
    require(!values.empty() && std::ranges::all_of(values, [](double v) { return std::isfinite(v); }),
            "values that aren't finite");
  };
  accepts<ParameterError>([&] { are_finite({analysis::parse_number("x", input)}); }, fuzz::Cited::command);
  accepts<ParameterError>([&] { are_finite(analysis::parse_values("x", input)); }, fuzz::Cited::command);
  accepts<ParameterError>([&] { are_finite(analysis::parse_angles("x", input)); }, fuzz::Cited::command);
  accepts<ParameterError>([&] { analysis::parse_integer<int>("--n", std::string(input), -3, 1000); },
                          fuzz::Cited::command);
  accepts<ParameterError>(
      [&] {
        const analysis::Assignment assignment = analysis::parse_assignment(input);
        require(assignment.name + "=" + assignment.text == input && !assignment.name.empty(),
                "an assignment that lost text");
        are_finite(analysis::parse_values(assignment.name, assignment.text));
      },
      fuzz::Cited::command);
}
