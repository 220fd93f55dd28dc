#include "analysis/text/assertion.hpp"

#include <cmath>
#include <limits>

#include "fuzz/fuzz.hpp"

ALBEDO_FUZZ_TARGET(assertion) {
  using namespace albedo;
  input = fuzz::argument(input);
  using fuzz::require;
  fuzz::accepts<ParameterError>(
      [&] {
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        const analysis::Facts none{.at = [](double, double) { return nan; },
                                   .max = nan,
                                   .min = nan,
                                   .mean = nan,
                                   .error = nan,
                                   .evaluations = nan};
        for (const analysis::Assertion& assertion : analysis::parse_assertions(input)) {
          require(assertion.theta >= 0 && assertion.theta <= 90 && assertion.tolerance >= 0 &&
                      std::isfinite(assertion.value) && std::isfinite(assertion.phi),
                  "an assertion outside of its ranges");
          require(!analysis::evaluate(assertion, none).holds, "an assertion that NaN satisfies");
        }
      },
      fuzz::Cited::command);
}
