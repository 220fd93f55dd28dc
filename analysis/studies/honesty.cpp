#include "analysis/studies/honesty.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "albedo/core/errors.hpp"
#include "analysis/files/table_document.hpp"
#include "analysis/studies/methods.hpp"
#include "rules/stratified.hpp"

namespace albedo::analysis {
namespace {

constexpr std::size_t worst_count = 10;
constexpr double far = 10;

/// All that is known of one case.
struct Answers {
  Estimate reference{};
  std::vector<std::optional<Estimate>> by_rule{};  // none where the paper warp can't be had
  std::optional<Estimate> second{};                // opinion on the reference, where that contradicts it
  std::optional<Estimate> quad{};
};

std::unique_ptr<Model> model_of(const RandomCase& question) { return make_model(question.model, question.parameters); }

/// The true error in units of the reported one, the reference's own error granted.
double ratio_of(const Estimate& answer, const Estimate& reference) {
  const double off = std::abs(answer.value - reference.value);
  return off == 0 ? 0 : off / (answer.error + reference.error);
}

Answers answers_of(const RandomCase& question, std::uint64_t index, const HonestyOptions& options) {
  const auto model = model_of(question);
  const Direction l = Direction::from_degrees(question.theta_degrees, question.phi_degrees);
  Answers answers{.reference = directional_albedo(*model, l, {.tolerance = 1e-12, .budget = 20'000'000})};
  const Estimate second =
      directional_albedo(*model, l, {.rule = Rule::kronrod, .tolerance = 1e-10, .budget = 1'000'000});
  if (second.status == Status::converged && ratio_of(second, answers.reference) > 1) {
    answers.second = second;
    answers.reference.error = std::abs(second.value - answers.reference.value);
    answers.reference.status = Status::rounding_limited;
  }
  for (const Rule rule : options.rules) {
    std::optional<Estimate>& answer = answers.by_rule.emplace_back();
    if (options.warp == Warp::paper && !has_samplers(*model)) continue;
    answer = directional_albedo(*model, l, options_of(rule, question, options));
  }
  if (options.quad_every > 0 && index % options.quad_every == 0) {
    answers.quad = directional_albedo(*model, l, {.precision = Precision::quad, .tolerance = 1e-13, .budget = 100'000});
  }
  return answers;
}

void keep_worst(std::vector<Worst>& list, const Worst& candidate) {
  const auto place = std::ranges::upper_bound(list, candidate.ratio, std::ranges::greater{}, &Worst::ratio);
  list.insert(place, candidate);
  if (list.size() > worst_count) list.pop_back();
}

void judge(RuleHonesty& result, const Estimate& answer, const Estimate& reference, std::uint64_t index) {
  // a reference that is no better than the answer can't tell
  if (reference.error > 0.1 * answer.error && reference.status != Status::converged) return;
  ++result.judged;
  const double ratio = ratio_of(answer, reference);
  if (answer.status != Status::converged) {
    result.unconverged_honest += ratio <= 1 ? 1 : 0;
    result.non_finite += answer.status == Status::non_finite ? 1 : 0;
    return;
  }
  ++result.converged;
  result.honest += ratio <= 1 ? 1 : 0;
  result.far_off += ratio <= far ? 0 : 1;
  const double resolution = 10 * reference.error;
  if (answer.error <= resolution && std::abs(answer.value - reference.value) <= resolution) {
    ++result.undecidable;
  } else {
    for (std::size_t k = 0; k < result.covered.size(); ++k) {
      result.covered[k] += ratio <= static_cast<double>(k + 1) ? 1 : 0;
    }
  }
  const double notable = is_monte_carlo(result.rule) ? 5 : 1;
  if (!(ratio <= notable)) keep_worst(result.worst, {index, ratio, answer, reference});
}

void check_reference(Honesty& result, const Answers& answers, std::uint64_t index) {
  if (!answers.quad || answers.quad->status != Status::converged) return;
  if (answers.reference.status != Status::converged) return;
  ++result.quad_checks;
  const double ratio = ratio_of(answers.reference, *answers.quad);
  if (ratio <= 1) return;
  ++result.quad_refuted;
  keep_worst(result.refuted, {index, ratio, answers.reference, *answers.quad});
}

HonestyOptions completed(HonestyOptions options) {
  if (options.rules.empty()) options.rules.assign(all_rules.begin(), all_rules.end());
  if (options.models.empty()) {
    for (const ModelInfo& info : model_infos()) {
      if (!info.needs_input()) options.models.push_back(info.name);
    }
  }
  for (const std::string& model : options.models) static_cast<void>(model_info(model));
  if (options.warp == Warp::paper) {
    std::erase_if(options.models, [](const std::string& model) { return !has_samplers(*make_model(model)); });
    if (options.models.empty()) throw ParameterError("warp is 'paper' and none of the models has a sampler");
  }
  return options;
}

}  // namespace

AlbedoOptions options_of(Rule rule, const RandomCase& question, const HonestyOptions& options) {
  const std::size_t draw = question.choice % honesty_tolerances.size();
  return {.rule = rule,
          .warp = options.warp,
          .tolerance = is_monte_carlo(rule) ? honesty_random_tolerances[draw] : honesty_tolerances[draw],
          .budget = rule == Rule::gauss ? 10 * options.budget : options.budget,
          .seed = question.choice >> 32};
}

Honesty study_honesty(const HonestyOptions& options, const ProgressCallback& progress) {
  Honesty result{.options = completed(options)};
  for (const Rule rule : result.options.rules) result.rules.push_back({.rule = rule});
  std::vector<Answers> all(result.options.cases);
  in_parallel(
      all.size(), result.options.threads,
      [&](std::size_t i) {
        all[i] = answers_of(random_case(result.options.seed, i, result.options.models), i, result.options);
      },
      progress);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].reference.status != Status::converged) ++result.without_reference;
    for (std::size_t r = 0; r < result.rules.size(); ++r) {
      if (all[i].by_rule[r]) judge(result.rules[r], *all[i].by_rule[r], all[i].reference, i);
    }
    check_reference(result, all[i], i);
    if (!all[i].second) continue;
    ++result.disputed;
    const double relative = all[i].reference.error / std::abs(all[i].reference.value);
    keep_worst(result.disputes, {i, relative, all[i].reference, *all[i].second});
  }
  return result;
}

double nominal_coverage(Rule rule, int k) {
  if (rule == Rule::monte_carlo) return 2 * cdf(boost::math::normal{}, k) - 1;
  return 2 * cdf(boost::math::students_t(replicate_count - 1), k) - 1;
}

std::string command_of(const RandomCase& question, Rule rule, const HonestyOptions& options) {
  const AlbedoOptions answer = options_of(rule, question, options);
  std::string text = command_of(question);
  if (rule != Rule::gauss) text.append(" --rule ").append(name_of(rule));
  if (options.warp != Warp::lobe) text.append(" --warp ").append(name_of(options.warp));
  append_number(text += " --tolerance ", answer.tolerance);
  text.append(" --budget ").append(std::to_string(answer.budget));
  if (is_monte_carlo(rule)) text.append(" --seed ").append(std::to_string(answer.seed));
  return text;
}

}  // namespace albedo::analysis
