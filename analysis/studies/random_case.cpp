#include "analysis/studies/random_case.hpp"

#include <algorithm>
#include <cmath>

#include "albedo/core/parameter.hpp"
#include "analysis/files/table_document.hpp"
#include "rules/random.hpp"

namespace albedo::analysis {
namespace {

constexpr double largest_ratio = 1000;  // of the two widths of an anisotropic lobe

/// The random numbers of one case, one after the other.
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint64_t index) : stream_(seed), index_(index) {}

  double uniform() { return RandomStream::unit(bits()); }
  double uniform(double from, double to) { return from + (to - from) * uniform(); }
  double log_uniform(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }
  std::size_t below(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(uniform() * static_cast<double>(count)));
  }
  std::uint64_t bits() {
    constexpr std::uint32_t cases_stream = 0xCA5E5;
    return stream_.bits(
        {{static_cast<std::uint32_t>(index_), static_cast<std::uint32_t>(index_ >> 32), next_++, cases_stream}})[0];
  }

 private:
  RandomStream stream_;
  std::uint64_t index_;
  std::uint32_t next_ = 0;
};

bool is_reflectance(const ParameterInfo& parameter) {
  const auto [least, most] = parameter.range;
  return parameter.per_channel && least == 0 && (most == 1 || most == scale_range.maximum);
}

double random_number(const ParameterInfo& parameter, Dice& dice) {
  const auto [least, most] = parameter.range;
  if (is_reflectance(parameter)) return std::clamp(dice.uniform(-1.0 / 6, 7.0 / 6), 0.0, 1.0);
  if (least == 0 && most >= 100) return std::min(most, dice.log_uniform(1, 1 + most) - 1);
  if (least > 0 && most >= 100 * least) return std::clamp(dice.log_uniform(least, most), least, most);
  return dice.uniform(least, most);
}

/// Both parameters of the model's first shorthand: the same value, or apart by a random ratio.
void spread(const ModelInfo& info, Parameters& parameters, Dice& dice) {
  if (info.shorthands.empty() || info.shorthands.front().parameters.size() != 2) return;
  const std::vector<std::string>& names = info.shorthands.front().parameters;
  const auto value = [&parameters](const std::string& name) -> double& {
    return std::get<double>(std::ranges::find(parameters, name, &Parameters::value_type::first)->second);
  };
  const bool is_isotropic = dice.uniform() < 0.5;
  const double ratio = dice.log_uniform(1, largest_ratio), middle = value(names[0]);
  const double first = is_isotropic ? 1 : dice.uniform() < 0.5 ? std::sqrt(ratio) : 1 / std::sqrt(ratio);
  const Range range = info.find(names[0])->range;
  value(names[0]) = std::clamp(middle * first, range.minimum, range.maximum);
  value(names[1]) = std::clamp(middle / first, range.minimum, range.maximum);
}

}  // namespace

RandomCase random_case(std::uint64_t seed, std::uint64_t index, const std::vector<std::string>& models) {
  Dice dice(seed, index);
  RandomCase result{.model = models[dice.below(models.size())]};
  const ModelInfo& info = model_info(result.model);
  for (const ParameterInfo& parameter : info.parameters) {
    if (parameter.is_choice()) {
      result.parameters.emplace_back(parameter.name, parameter.choices[dice.below(parameter.choices.size())]);
    } else {
      result.parameters.emplace_back(parameter.name, random_number(parameter, dice));
    }
  }
  spread(info, result.parameters, dice);
  constexpr double nearest = 1e-10;  // degrees from grazing incidence
  result.theta_degrees = dice.uniform() < 0.5 ? dice.uniform(0, 90 - nearest) : 90 - dice.log_uniform(nearest, 90);
  result.phi_degrees = dice.uniform() < 0.25 ? 90 * static_cast<double>(dice.below(4)) : dice.uniform(0, 360);
  result.choice = dice.bits();
  return result;
}

std::string command_of(const RandomCase& question) {
  std::string text = "albedo at " + question.model;
  for (const auto& [name, value] : question.parameters) {
    text.append(" ").append(name).append("=");
    if (const auto* choice = std::get_if<std::string>(&value)) {
      text += *choice;
    } else {
      append_number(text, std::get<double>(value));
    }
  }
  append_number(text += " --theta ", question.theta_degrees);
  append_number(text += " --phi ", question.phi_degrees);
  return text;
}

}  // namespace albedo::analysis
