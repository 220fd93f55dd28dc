#include "analysis/studies/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "albedo/core/errors.hpp"
#include "analysis/studies/methods.hpp"
#include "analysis/studies/textbook_form.hpp"

namespace albedo::analysis {
namespace {

constexpr double nearest = 1e-10;  // degrees from grazing incidence
constexpr Range roughnesses{1e-5, 5}, exponents{0, 1e7};

/// The name of what makes a model's lobe wider or narrower: a shorthand for two parameters where there is one.
std::string width_parameter(const ModelInfo& info) {
  for (const Shorthand& shorthand : info.shorthands) {
    if (shorthand.parameters.size() == 2) return shorthand.name;
  }
  const auto is_width = [](const ParameterInfo& p) {
    const bool spans_decades = p.range.minimum >= 0 && p.range.maximum >= 1e3 * std::max(p.range.minimum, 1e-3);
    return !p.is_choice() && !p.per_channel && spans_decades;
  };
  const auto found = std::ranges::find_if(info.parameters, is_width);
  if (found != info.parameters.end()) return found->name;
  throw ParameterError(info.name + " has no roughness or exponent to make an axis of");
}

/// From the narrowest lobe to the widest, evenly in the logarithm of the roughness or of 1 + exponent.
std::vector<double> width_values(const Range& range, bool is_exponent, std::size_t count) {
  const Range wanted = is_exponent ? exponents : roughnesses;
  const double least = std::max(wanted.minimum, range.minimum), most = std::min(wanted.maximum, range.maximum);
  const double shift = is_exponent ? 1 : 0;
  const double from = std::log(least + shift), to = std::log(most + shift);
  std::vector<double> values{least};
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    values.push_back(std::exp(from + (to - from) * share) - shift);
  }
  values.push_back(most);
  if (is_exponent) std::ranges::reverse(values);
  return values;
}

std::vector<Surface> surfaces_of(const AtlasOptions& options) {
  constexpr double oblique = 30;  // degrees of azimuth from an anisotropic lobe's axis
  std::vector<Surface> surfaces;
  for (const std::string& name : options.models) {
    const ModelInfo& info = model_info(name);
    Surface surface{.model = name, .parameter = width_parameter(info)};
    const std::vector<std::string> parameters = info.resolve(surface.parameter);
    const Range& range = info.find(parameters.front())->range;
    surface.is_exponent = range.maximum >= 1e3;
    surface.values = width_values(range, surface.is_exponent, options.widths);
    surface.has_samplers = has_samplers(*make_model(name));
    const bool is_anisotropic = parameters.size() == 2 && options.anisotropy > 1;
    if (options.isotropic || !is_anisotropic) surfaces.push_back(surface);
    if (is_anisotropic) {
      surface.anisotropy = options.anisotropy;
      surface.phi_degrees = oblique;
      surfaces.push_back(surface);
    }
  }
  return surfaces;
}

std::vector<double> gaps(std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    values.push_back(i + 1 == count ? nearest : 90 * std::pow(nearest / 90, share));
  }
  return values;
}

AtlasOptions completed(AtlasOptions options) {
  if (options.rules.empty()) options.rules.assign(all_rules.begin(), all_rules.end());
  if (options.warps.empty()) options.warps.assign(all_warps.begin(), all_warps.end());
  if (options.forms.empty()) options.forms.assign(all_forms.begin(), all_forms.end());
  if (options.incidences < 2 || options.widths < 2) throw ParameterError("the grid must be at least 2x2");
  return options;
}

double tolerance_of(const AtlasOptions& options, Rule rule) {
  return is_monte_carlo(rule) ? options.random_tolerance : options.tolerance;
}

Answer answer_of(const Model& model, const Direction& l, const AtlasMethod& method, const Estimate& reference,
                 const AtlasOptions& options) {
  const double tolerance = tolerance_of(options, method.rule);
  const AlbedoOptions asked{.rule = method.rule,
                            .warp = method.warp,
                            .precision = method.form == Form::float64 ? Precision::float64 : Precision::float32,
                            .tolerance = tolerance,
                            .budget = options.budget,
                            .seed = options.seed};
  Answer answer;
  answer.estimate = method.form == Form::textbook_float ? directional_albedo(TextbookModel(model), l, asked)
                                                        : directional_albedo(model, l, asked);
  answer.verdict =
      judge(answer.estimate, reference, is_monte_carlo(method.rule) ? random_slack * tolerance : tolerance);
  const double off = answer.estimate.value - reference.value;
  answer.relative_error = off == 0 ? 0 : off / std::abs(reference.value);
  return answer;
}

}  // namespace

std::string_view name_of(Form form) {
  constexpr std::array<std::string_view, all_forms.size()> names{"double", "float", "textbook_float"};
  return names[static_cast<std::size_t>(form)];
}

std::string_view name_of(Verdict verdict) {
  constexpr std::array<std::string_view, all_verdicts.size()> names{"right", "right_unconverged", "unconverged",
                                                                    "wrong", "non_finite",        "unknown"};
  return names[static_cast<std::size_t>(verdict)];
}

Parameters Surface::parameters(double value) const {
  if (anisotropy == 1) return {{parameter, value}};
  const ModelInfo& info = model_info(model);
  const std::vector<std::string> names = info.resolve(parameter);
  const Range& range = info.find(names[1])->range;
  const double other = is_exponent ? (value + 1) * anisotropy - 1 : value / anisotropy;
  return {{names[0], value}, {names[1], std::clamp(other, range.minimum, range.maximum)}};
}

std::size_t Atlas::cell(std::size_t surface, std::size_t width, std::size_t incidence) const {
  return (surface * options.widths + width) * from_grazing.size() + incidence;
}

Verdict judge(const Estimate& answer, const Estimate& reference, double tolerance) {
  const double allowed = tolerance * std::abs(reference.value);
  if (!std::isfinite(reference.value) || !(reference.error <= 0.1 * allowed)) return Verdict::unknown;
  if (!std::isfinite(answer.value) || answer.status == Status::non_finite) return Verdict::non_finite;
  const bool claims = answer.status == Status::converged;
  if (std::abs(answer.value - reference.value) <= allowed + reference.error) {
    return claims ? Verdict::right : Verdict::right_unconverged;
  }
  return claims ? Verdict::wrong : Verdict::unconverged;
}

Atlas compute_atlas(const AtlasOptions& options, const ProgressCallback& progress) {
  Atlas atlas{.options = completed(options)};
  atlas.surfaces = surfaces_of(atlas.options);
  atlas.from_grazing = gaps(atlas.options.incidences);
  for (const Rule rule : atlas.options.rules) {
    for (const Warp warp : atlas.options.warps) {
      for (const Form form : atlas.options.forms) atlas.methods.push_back({rule, warp, form});
    }
  }
  const std::size_t cells = atlas.cell(atlas.surfaces.size(), 0, 0);
  atlas.references.resize(cells);
  atlas.answers.resize(cells * atlas.methods.size());
  in_parallel(
      cells, atlas.options.threads,
      [&](std::size_t cell) {
        const std::size_t incidence = cell % atlas.from_grazing.size(), rest = cell / atlas.from_grazing.size();
        const Surface& surface = atlas.surfaces[rest / atlas.options.widths];
        const auto model = make_model(surface.model, surface.parameters(surface.values[rest % atlas.options.widths]));
        const Direction l = Direction::from_degrees(90 - atlas.from_grazing[incidence], surface.phi_degrees);
        Estimate& reference = atlas.references[cell];
        reference = directional_albedo(*model, l, {.tolerance = 1e-12, .budget = 20'000'000});
        for (std::size_t m = 0; m < atlas.methods.size(); ++m) {
          if (!atlas.applies(rest / atlas.options.widths, m)) continue;
          atlas.answers[cell * atlas.methods.size() + m] =
              answer_of(*model, l, atlas.methods[m], reference, atlas.options);
        }
      },
      progress);
  return atlas;
}

}  // namespace albedo::analysis
