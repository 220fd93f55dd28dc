#include "analysis/commands/checks.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <limits>

#include "albedo/core/errors.hpp"
#include "analysis/commands/commands.hpp"

namespace albedo::analysis {

void add_assert_option(const Syntax& command, std::vector<Assertion>& assertions) {
  const auto parse = [&assertions](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) std::ranges::move(parse_assertions(text), std::back_inserter(assertions));
  };
  command
      .parsed_each("--assert", parse,
                   "conditions on max, min, mean, error, evaluations and at(THETA[,PHI]); exit code 1 if one fails")
      .type_name("EXPR")
      .one_at_a_time();
}

void check_answerable(const std::vector<Assertion>& assertions,
                      const std::function<bool(double theta, double phi)>& can_answer, const std::string& reason) {
  for (const Assertion& assertion : assertions) {
    if (assertion.quantity != Quantity::at || can_answer(assertion.theta, assertion.phi)) continue;
    throw ParameterError("assert: '" + assertion.text + "' can't be answered: " + reason);
  }
}

Extent extent_of(const std::vector<double>& values) {
  return extent_of(values.size(), [&](std::size_t i) { return values[i]; });
}

Extent extent_of(std::size_t size, const std::function<double(std::size_t)>& value_at) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Extent extent{.max = -infinity, .min = infinity, .mean = 0};
  for (std::size_t i = 0; i < size; ++i) {
    const double value = value_at(i);
    extent.max = std::max(extent.max, value);
    extent.min = std::min(extent.min, value);
    extent.mean += value;
  }
  extent.mean /= static_cast<double>(size);
  if (std::isnan(extent.mean)) extent.max = extent.min = extent.mean;  // the comparisons above pass over NaN
  return extent;
}

int concluding_exit_code(const std::vector<Assertion>& assertions, const Facts& facts, const Convergence& convergence) {
  int code = exit_code::done;
  if (convergence.missed > 0) {
    std::cerr << "albedo: " << convergence.missed << " of " << convergence.results
              << (convergence.results == 1 ? " result" : " results") << " did not reach the tolerance\n";
    code = exit_code::not_converged;
  }
  for (const Assertion& assertion : assertions) {
    const Outcome outcome = evaluate(assertion, facts);
    if (outcome.holds) continue;
    std::cerr << "albedo: " << outcome.text << '\n';
    code = exit_code::check_failed;
  }
  return code;
}

}  // namespace albedo::analysis
