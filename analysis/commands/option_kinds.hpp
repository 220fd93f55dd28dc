/// @file
/// Kinds of options: one name of several, some of them, whole and real numbers within a range. A value that is
/// malformed or out of range throws a ParameterError while parsing; targets must outlive the parsing.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "albedo/core/errors.hpp"
#include "albedo/core/suggestion.hpp"
#include "analysis/commands/syntax.hpp"
#include "analysis/studies/methods.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {

/// The names of values that have a name_of().
template <class E, std::size_t N>
std::vector<std::string> names_of(const std::array<E, N>& all) {
  std::vector<std::string> names;
  for (const E value : all) names.emplace_back(name_of(value));
  return names;
}

/// The value of a name. @throws ParameterError that says which there are
template <class E, std::size_t N>
E value_of(const std::array<E, N>& all, const std::string& option, const std::string& text) {
  const std::vector<std::string> names = names_of(all);
  const auto found = std::ranges::find(names, text);
  if (found != names.end()) return all[static_cast<std::size_t>(found - names.begin())];
  const std::string close = suggestion(text, names);
  throw ParameterError(option + " is '" + text + "' and must be one of " + joined(names, ", ") +
                       (close.empty() ? "" : "; did you mean '" + close + "'?"));
}

/// An option that takes one of several names.
template <class E, std::size_t N>
void add_choice(const Syntax& command, const std::string& option, const std::array<E, N>& all, E& target,
                const std::string& description) {
  const auto set = [all, &target, option](const std::string& text) { target = value_of(all, option, text); };
  command.parsed(option, set, description)
      .type_name(joined(names_of(all), "|"))
      .default_text(std::string(name_of(target)));
}

/// An option that takes some of several names, with commas between them; given again, it adds to them.
template <class E, std::size_t N>
void add_choices(const Syntax& command, const std::string& option, const std::array<E, N>& all, std::vector<E>& target,
                 const std::string& description) {
  const auto set = [all, &target, option](const std::vector<std::string>& lists) {
    for (const std::string& list : lists) {
      std::istringstream stream(list.empty() ? "," : list);
      for (std::string name; std::getline(stream, name, ',');) {
        const E value = value_of(all, option, name);
        if (std::ranges::find(target, value) == target.end()) target.push_back(value);
      }
    }
  };
  command.parsed_each(option, set, description).type_name(joined(names_of(all), "|") + "[,...]").one_at_a_time();
}

/// A whole number within [least, most].
template <class Integer>
Integer parse_integer(const std::string& option, const std::string& text, Integer least, Integer most) {
  Integer value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && value >= least && value <= most) return value;
  throw ParameterError(option + " is '" + text + "' and must be a whole number within [" + std::to_string(least) +
                       ", " + std::to_string(most) + "]");
}

/// An option that takes a whole number within [least, most].
template <class Integer>
OptionSyntax add_integer(const Syntax& command, const std::string& option, Integer& target, Integer least, Integer most,
                         const std::string& description) {
  const auto set = [&target, option, least, most](const std::string& text) {
    target = parse_integer(option, text, least, most);
  };
  return command.parsed(option, set, description).type_name("N");
}

/// An option that takes a number within [least, most]; its target's value is the default.
OptionSyntax add_real(const Syntax& command, const std::string& option, double& target, double least, double most,
                      const std::string& description);

}  // namespace albedo::analysis
