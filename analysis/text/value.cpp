#include "analysis/text/value.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>

#include "albedo/core/errors.hpp"

namespace albedo::analysis {
namespace {

constexpr std::size_t largest_count = 1'000'000;  // 8 MB

/// "what: 'text' problem"
ParameterError refused(std::string_view what, std::string_view text, std::string_view problem) {
  return ParameterError(std::string(what) + ": '" + std::string(text) + "' " + std::string(problem));
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t end = text.find(separator); end != std::string_view::npos; end = text.find(separator)) {
    parts.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  parts.push_back(text);
  return parts;
}

std::size_t parse_count(std::string_view what, std::string_view text) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 1 || count > largest_count) {
    throw refused(what, text, "is not a count from 1 to " + std::to_string(largest_count));
  }
  return count;
}

}  // namespace

double parse_number(std::string_view what, std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = end == text.data() + text.size();
  if (error == std::errc::result_out_of_range && is_whole) {
    throw refused(what, text, "is not a finite number that a double can hold");
  }
  if (error != std::errc() || !is_whole || !std::isfinite(value)) throw refused(what, text, "is not a finite number");
  return value;
}

Assignment parse_assignment(std::string_view argument) {
  const std::size_t equals = argument.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw ParameterError("'" + std::string(argument) + "' is not of the form NAME=VALUE");
  }
  return {std::string(argument.substr(0, equals)), std::string(argument.substr(equals + 1))};
}

std::vector<double> RangeAxis::values(std::string_view what) const {
  std::vector<double> result(count);
  const double steps = static_cast<double>(std::max<std::size_t>(count - 1, 1));
  const double log_from = log ? std::log10(from) : 0;
  const double log_to = log ? std::log10(to) : 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / steps;
    // Logarithms to base 10, so that decades come out as they are written.
    result[i] = log ? std::pow(10.0, std::lerp(log_from, log_to, t)) : std::lerp(from, to, t);
  }
  result.front() = from;
  result.back() = to;
  const auto out_of_order = [&](double a, double b) { return from < to ? a >= b : a <= b; };
  if (std::ranges::adjacent_find(result, out_of_order) != result.end()) {
    throw ParameterError(std::string(what) + ": " + std::to_string(count) +
                         " numbers in that range are too close together for a double");
  }
  return result;
}

bool is_range(std::string_view text) { return text.find(':') != std::string_view::npos; }

RangeAxis parse_range(std::string_view what, std::string_view text) {
  const std::vector<std::string_view> parts = split(text, ':');
  const bool has_form = parts.size() == 3 || (parts.size() == 4 && parts[3] == "log");
  if (!has_form) throw refused(what, text, "is not of the form FROM:TO:COUNT or FROM:TO:COUNT:log");
  const RangeAxis range{.from = parse_number(what, parts[0]),
                        .to = parse_number(what, parts[1]),
                        .count = parse_count(what, parts[2]),
                        .log = parts.size() == 4};
  if (range.count == 1 && range.from != range.to) throw refused(what, text, "has a count of 1 for two different ends");
  if (range.count > 1 && range.from == range.to)
    throw refused(what, text, "has equal ends, which only a count of 1 can have");
  if (range.log && !(range.from > 0 && range.to > 0))
    throw refused(what, text, "is logarithmic and needs ends above 0");
  return range;
}

std::vector<double> parse_values(std::string_view what, std::string_view text) {
  if (is_range(text)) return parse_range(what, text).values(what);
  std::vector<double> values;
  for (const std::string_view part : split(text, ',')) values.push_back(parse_number(what, part));
  return values;
}

std::vector<double> parse_angles(std::string_view what, std::string_view text) {
  std::vector<double> angles;
  for (const std::string_view part : split(text, ',')) {
    angles.push_back(parse_number(what, part));
    if (!(angles.back() >= 0 && angles.back() <= 90)) throw refused(what, part, "is outside [0, 90] degrees");
  }
  return angles;
}

}  // namespace albedo::analysis
