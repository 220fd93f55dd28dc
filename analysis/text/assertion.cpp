#include "analysis/text/assertion.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "albedo/core/errors.hpp"

namespace albedo::analysis {
namespace {

/// A parser by recursive descent; its position is always behind what has been understood.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  std::vector<Assertion> conditions() {
    std::vector<Assertion> result;
    do {
      result.push_back(condition());
    } while (accept(",") || accept("&&"));
    skip_blanks();
    if (position_ != text_.size()) expected("',', '&&' or the end");
    return result;
  }

 private:
  Assertion condition() {
    skip_blanks();
    const std::size_t begin = position_;
    Assertion result;
    result.quantity = quantity();
    if (result.quantity == Quantity::at) direction(result);
    result.relation = relation();
    result.value = number("a finite number");
    if (result.relation == Relation::equal) {
      if (!accept("±") && !accept("+-")) expected("'±' or '+-' and a tolerance");
      result.tolerance = number("a tolerance of 0 or more", 0);
    }
    result.text = text_.substr(begin, position_ - begin);
    return result;
  }

  Quantity quantity() {
    using Entry = std::pair<std::string_view, Quantity>;
    constexpr std::array names{Entry{"max", Quantity::max},
                               Entry{"min", Quantity::min},
                               Entry{"mean", Quantity::mean},
                               Entry{"error", Quantity::error},
                               Entry{"evaluations", Quantity::evaluations},
                               Entry{"at", Quantity::at}};
    const auto* const end = std::find_if(text_.begin() + position_, text_.end(),
                                         [](unsigned char c) { return std::isalnum(c) == 0 && c != '_'; });
    const std::string_view word(text_.begin() + position_, end);
    const auto* const found = std::ranges::find(names, word, &Entry::first);
    if (found == names.end()) expected("max, min, mean, error, evaluations or at(THETA[,PHI])");
    position_ += word.size();
    return found->second;
  }

  void direction(Assertion& result) {
    if (!accept("(")) expected("'(' and an angle");
    result.theta = number("an angle from 0 to 90 degrees", 0, 90);
    if (accept(",")) result.phi = number("an angle in degrees");
    if (!accept(")")) expected("')'");
  }

  Relation relation() {
    if (accept("<=")) return Relation::less_or_equal;
    if (accept(">=")) return Relation::greater_or_equal;
    if (accept("==")) return Relation::equal;
    if (accept("<")) return Relation::less;
    if (accept(">")) return Relation::greater;
    expected("one of < <= > >= ==");
  }

  double number(std::string_view description, double least = -infinity, double most = infinity) {
    skip_blanks();
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + position_, text_.data() + text_.size(), value);
    if (error != std::errc() || !std::isfinite(value) || value < least || value > most) expected(description);
    position_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  bool accept(std::string_view token) {
    skip_blanks();
    if (!text_.substr(position_).starts_with(token)) return false;
    position_ += token.size();
    return true;
  }

  void skip_blanks() { position_ = std::min(text_.find_first_not_of(" \t\n\r", position_), text_.size()); }

  [[noreturn]] void expected(std::string_view what) const {
    // Counted in characters: the bytes that continue one in UTF-8 are left out.
    const auto before = text_.substr(0, position_);
    const auto characters = std::ranges::count_if(before, [](unsigned char c) { return (c & 0xC0U) != 0x80U; });
    throw ParameterError("assert: '" + std::string(text_) + "' needs " + std::string(what) + " at character " +
                         std::to_string(characters + 1));
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();

  std::string_view text_;
  std::size_t position_ = 0;
};

double actual_value(const Assertion& assertion, const Facts& facts) {
  switch (assertion.quantity) {
    case Quantity::max:
      return facts.max;
    case Quantity::min:
      return facts.min;
    case Quantity::mean:
      return facts.mean;
    case Quantity::error:
      return facts.error;
    case Quantity::evaluations:
      return facts.evaluations;
    case Quantity::at:
      return facts.at(assertion.theta, assertion.phi);
  }
  throw std::logic_error("an assertion of no known quantity");
}

/// A NaN fails every one of these comparisons by itself.
bool holds(const Assertion& assertion, double actual) {
  switch (assertion.relation) {
    case Relation::less:
      return actual < assertion.value;
    case Relation::less_or_equal:
      return actual <= assertion.value;
    case Relation::greater:
      return actual > assertion.value;
    case Relation::greater_or_equal:
      return actual >= assertion.value;
    case Relation::equal:
      return std::abs(actual - assertion.value) <= assertion.tolerance;
  }
  throw std::logic_error("an assertion of no known relation");
}

}  // namespace

std::vector<Assertion> parse_assertions(std::string_view text) { return Parser(text).conditions(); }

Outcome evaluate(const Assertion& assertion, const Facts& facts) {
  Outcome outcome;
  outcome.actual = actual_value(assertion, facts);
  outcome.holds = holds(assertion, outcome.actual);
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.begin(), digits.end(), outcome.actual);
  outcome.text = "assertion '" + assertion.text + (outcome.holds ? "' holds" : "' fails") + ": the value is " +
                 std::string(digits.data(), end.ptr);
  return outcome;
}

}  // namespace albedo::analysis
