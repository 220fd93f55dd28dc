/// @file
/// The conditions of `--assert`, for continuous integration: "max<=1", "error<=1e-6", "at(60)==0.488988±1e-6".
///
///     conditions = condition { ("," | "&&") condition }
///     condition  = quantity ("<" | "<=" | ">" | ">=") number | quantity "==" number ("±" | "+-") number
///     quantity   = "max" | "min" | "mean" | "error" | "evaluations" | "at" "(" theta [ "," phi ] ")"
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace albedo::analysis {

enum class Quantity { max, min, mean, error, evaluations, at };
enum class Relation { less, less_or_equal, greater, greater_or_equal, equal };

/// One condition: quantity relation value, and ± tolerance if the relation is `equal`.
struct Assertion {
  Quantity quantity = Quantity::max;
  double theta = 0;  ///< of `at`: degrees in [0, 90]
  double phi = 0;    ///< of `at`: degrees
  Relation relation = Relation::less;
  double value = 0;
  double tolerance = 0;
  std::string text;  ///< as written, without the blanks around it
};

/// What a computation found.
struct Facts {
  std::function<double(double theta_deg, double phi_deg)> at;
  double max = 0;
  double min = 0;
  double mean = 0;
  double error = 0;        ///< the largest
  double evaluations = 0;  ///< the most for one result
};

struct Outcome {
  bool holds = false;
  double actual = 0;
  std::string text;  ///< a sentence with the condition and the actual value
};

/// @throws ParameterError that says at which character what was expected
std::vector<Assertion> parse_assertions(std::string_view text);

/// Holds a condition against the facts. A value that is NaN satisfies none.
Outcome evaluate(const Assertion& assertion, const Facts& facts);

}  // namespace albedo::analysis
