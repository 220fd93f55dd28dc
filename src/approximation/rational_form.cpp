#include "albedo/rational_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "albedo/core/errors.hpp"
#include "albedo/curve.hpp"
#include "approximation/rational_trial.hpp"
#include "core/text.hpp"
#include "numerics/parallel.hpp"

namespace albedo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Place {
  double cos_theta;
  Estimate albedo{};
};

double theta_degrees(double cos_theta) { return Direction::from_cosine(cos_theta).theta_degrees(); }

void sort(std::vector<Place>& list) {
  std::ranges::sort(list, {}, &Place::cos_theta);
  const auto is_same = [](const Place& a, const Place& b) { return a.cos_theta == b.cos_theta; };
  list.erase(std::unique(list.begin(), list.end(), is_same), list.end());
}

/// Evenly over θ, over ln cosθ towards grazing incidence and over ln θ towards normal incidence, and crowded at the
/// ends, as nothing holds a fit from beyond them.
std::vector<Place> fitted_places(double last_theta) {
  constexpr int over_theta = 240, over_decades = 240, towards_normal = 200;
  const double last = Direction::from_degrees(last_theta).cos_theta;
  std::vector<Place> result{{1}, {last}};
  for (int i = 0; i < over_theta; ++i) {
    result.push_back({Direction::from_degrees(last_theta * (i + 0.5) / over_theta).cos_theta});
  }
  for (int i = 0; i < over_decades; ++i) result.push_back({std::pow(last, (i + 0.5) / over_decades)});
  for (int i = 0; i < towards_normal; ++i) {
    result.push_back({Direction::from_degrees(last_theta * std::pow(1e-3, (i + 0.5) / towards_normal)).cos_theta});
  }
  for (double distance = 1e-3; distance > 1e-6; distance /= 3) {
    result.push_back({std::pow(last, distance)});
    result.push_back({std::pow(last, 1 - distance)});
  }
  sort(result);
  return result;
}

/// A direction within each gap, at this part of it in ln cosθ.
std::vector<Place> places_between(const std::vector<Place>& list, double part) {
  std::vector<Place> result;
  for (std::size_t i = 1; i < list.size(); ++i) {
    const double from = list[i - 1].cos_theta, to = list[i].cos_theta;
    const double between = from * std::pow(to / from, part);
    if (between > from && between < to) result.push_back({between});
  }
  return result;
}

void integrate(const Model& model, const RationalOptions& options, std::vector<Place>& list, RationalFit& fit) {
  AlbedoOptions albedo = options.albedo;
  const double share = is_monte_carlo(albedo.rule) ? 2 : 100;
  albedo.tolerance = std::max(options.tolerance / share, std::min(1e-13, options.tolerance));
  in_parallel(list.size(), options.threads, [&](std::size_t i) {
    list[i].albedo = directional_albedo(model, Direction::from_cosine(list[i].cos_theta, options.phi_degrees), albedo);
  });
  for (const Place& place : list) {
    fit.evaluations += place.albedo.evaluations;
    if (place.albedo.status != Status::converged && fit.status != Status::non_finite) fit.status = place.albedo.status;
    fit.smallest = std::min(fit.smallest, place.albedo.value);
    fit.largest = std::max(fit.largest, std::abs(place.albedo.value));
  }
}

/// What errors are relative to.
double scale_of(double albedo, double largest) {
  const double least = AlbedoCurve::relative_floor * largest;
  return largest == 0 ? 1 : std::max(std::abs(albedo), least);
}

/// |form − albedo| with what the albedo may be off by, relative.
double error_at(const RationalForm& form, const Place& place, double largest) {
  return (std::abs(form(place.cos_theta) - place.albedo.value) + place.albedo.error) /
         scale_of(place.albedo.value, largest);
}

/// Takes the error of the form at these places into the fit's.
void measure(const std::vector<Place>& list, RationalFit& fit) {
  for (const Place& place : list) {
    const double error = error_at(fit.form, place, fit.largest);
    const double in_float =
        std::abs(static_cast<double>(fit.form(static_cast<float>(place.cos_theta))) - place.albedo.value) /
        scale_of(place.albedo.value, fit.largest);
    if (!(error <= fit.error)) fit.error = error, fit.worst_theta = theta_degrees(place.cos_theta);
    if (!(in_float <= fit.float_error)) fit.float_error = in_float;
  }
}

/// Directions on either side of every place where the error has a maximum that is not much less than the largest.
std::vector<Place> around_peaks(const std::vector<Place>& list, const RationalFit& fit) {
  constexpr double considered = 0.7;
  std::vector<double> errors;
  for (const Place& place : list) errors.push_back(error_at(fit.form, place, fit.largest));
  std::vector<Place> result;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, list.size() - 1);
    if (errors[i] < considered * fit.error || errors[i] < errors[before] || errors[i] < errors[after]) continue;
    const std::vector<Place> gaps(list.begin() + static_cast<std::ptrdiff_t>(before),
                                  list.begin() + static_cast<std::ptrdiff_t>(after) + 1);
    for (const double part : {0.25, 0.5, 0.75})
      std::ranges::copy(places_between(gaps, part), std::back_inserter(result));
  }
  sort(result);
  return result;
}

/// Every way to write the albedo, those with a shift apart: they are tried last.
std::vector<RationalForm> shapes(bool is_positive, const std::set<int>& powers, bool has_shift) {
  using enum RationalVariable;
  std::vector<RationalForm> result;
  const auto add = [&](RationalVariable variable, double shift) {
    for (const int exponent : {1, 2, 4}) {
      for (const int power : powers) {
        if (exponent > 1 && !is_positive) continue;
        result.push_back({.variable = variable, .shift = shift, .exponent = exponent, .power = power});
      }
    }
  };
  if (!has_shift) {
    for (const auto variable : {square_root, cosine, fourth_root, half_elevation, cotangent}) add(variable, 0);
    return result;
  }
  constexpr int shifts_per_decade = 10;
  for (int i = 0; i <= 3 * shifts_per_decade; ++i) {
    const double shift = std::pow(10, -static_cast<double>(i) / shifts_per_decade);
    add(scaled_slope, shift * shift);
    add(scaled_half, shift * shift);
    add(shifted_root, shift);
  }
  return result;
}

/// The degrees that make a form of exactly so many coefficients.
std::vector<RationalType> types_of(std::size_t coefficients, bool has_shift) {
  const int degrees = static_cast<int>(coefficients) - 1 - (has_shift ? 1 : 0);
  std::vector<RationalType> types;
  for (const int excess : {0, 1, -1, 3, -3}) {
    if ((degrees - excess) % 2 != 0 || std::abs(excess) > degrees || (has_shift && excess != 0)) continue;
    types.emplace_back((degrees + excess) / 2, (degrees - excess) / 2);
  }
  return types;
}

std::vector<int> mean(std::vector<int> own, const std::vector<int>& other) {
  if (own.size() != other.size()) return other;
  for (std::size_t i = 0; i < own.size(); ++i) own[i] = (own[i] + other[i]) / 2;
  return own;
}

/// Fits all of them, each from what it knows, then those that have not converged from what the others have found: the
/// directions at which errors alternate differ little from one variable to another.
void fit_all(std::vector<RationalTrial>& trials, const std::vector<RationalType>& types, int threads) {
  constexpr std::size_t most_references = 6;
  for (const RationalType& type : types) {
    in_parallel(trials.size(), threads, [&](std::size_t i) { trials[i].attempt(type); });
    std::vector<Minimax> known;
    for (RationalTrial& trial : trials) {
      if (trial.best(type).converged) known.push_back(trial.best(type));
    }
    std::ranges::stable_sort(known, {}, &Minimax::error);
    known.resize(std::min(known.size(), most_references));
    in_parallel(trials.size(), threads, [&](std::size_t i) {
      for (const Minimax& one : known) trials[i].attempt(type, one.reference);
      for (const Minimax& one : known) trials[i].attempt(type, mean(trials[i].best(type).reference, one.reference));
    });
  }
}

/// What is worse of the error, and of the part of the float's that may be twice as large.
double merit(const RationalFit& fit) { return std::max(fit.error, fit.float_error / 2); }

/// The best of these forms at places that are integrated, added to what `fit` knows of the albedo.
RationalFit best_of(std::vector<RationalTrial>& trials, const std::vector<RationalType>& types,
                    const std::vector<Place>& list, const RationalFit& fit) {
  RationalFit best = fit;
  best.error = best.float_error = infinity;
  for (RationalTrial& trial : trials) {
    for (const RationalType& type : types) {
      if (!(trial.best(type).error < merit(best) * trial.shape().exponent * 2)) continue;
      const std::optional<RationalForm> form = trial.form(type);
      if (!form) continue;
      RationalFit here = fit;
      here.form = *form, here.least = trial.best(type).least;
      measure(list, here);
      if (merit(here) < merit(best)) best = std::move(here);
    }
  }
  return best;
}

void check(const RationalOptions& options) {
  if (options.most_coefficients < 3) {
    throw ParameterError(fmt::format("most_coefficients is {} and must be at least 3", options.most_coefficients));
  }
  if (!(options.tolerance > 0 && options.tolerance < 1)) {
    throw ParameterError(fmt::format("tolerance is {:g} and must be within (0, 1)", options.tolerance));
  }
  if (!(options.last_theta >= 1 && options.last_theta < 90)) {
    throw ParameterError(fmt::format("last_theta is {:g} and must be within [1, 90)", options.last_theta));
  }
}

}  // namespace

RationalFit rational_form(const Model& model, const RationalOptions& options) {
  check(options);
  constexpr double golden = 0.6180339887498949;
  RationalFit fit;
  fit.smallest = infinity, fit.largest = 0;
  const std::vector<Place> nodes = [&] {
    std::vector<Place> list = fitted_places(options.last_theta);
    integrate(model, options, list, fit);
    return list;
  }();
  std::vector<Place> all = places_between(nodes, golden);
  integrate(model, options, all, fit);
  const auto finish = [&](RationalFit result) {
    result.fitted = static_cast<int>(nodes.size()), result.verified = static_cast<int>(all.size() - nodes.size());
    result.evaluations = fit.evaluations, result.smallest = fit.smallest, result.largest = fit.largest;
    result.status = fit.status;
    return result;
  };
  all.insert(all.end(), nodes.begin(), nodes.end());
  sort(all);
  if (fit.status == Status::non_finite || fit.status == Status::divergent || !std::isfinite(fit.largest)) {
    fit.form.gain = std::numeric_limits<double>::quiet_NaN();
    fit.error = fit.float_error = infinity;
    if (fit.status == Status::converged) fit.status = Status::non_finite;
    return finish(fit);
  }

  std::vector<RationalSample> samples;
  for (const auto& [cos_theta, albedo] : nodes) {
    samples.push_back({cos_theta, albedo.value, scale_of(albedo.value, fit.largest)});
  }
  const RationalSample &last = samples[0], &before = samples[8];
  const double slope = std::log(last.value / before.value) / std::log(last.cos_theta / before.cos_theta);
  const int power = std::isfinite(slope) ? static_cast<int>(std::lround(std::clamp(2 * slope, -8.0, 8.0))) : 0;
  const auto trials_of = [&](bool has_shift) {
    std::vector<RationalTrial> trials;
    for (RationalForm& shape : shapes(fit.smallest > 0, {0, power}, has_shift)) {
      trials.emplace_back(std::move(shape), samples);
    }
    return trials;
  };

  RationalFit best = fit;
  best.error = best.float_error = infinity;
  /// Whether the best of these meets the tolerance: it is verified once more, where its error is largest.
  const auto suffice = [&](std::vector<RationalTrial>& trials, std::size_t coefficients, bool has_shift) {
    const std::vector<RationalType> types = types_of(coefficients, has_shift);
    fit_all(trials, types, options.threads);
    RationalFit here = best_of(trials, types, all, fit);
    if (!(merit(here) < merit(best))) return false;
    constexpr double rounding = 1e-12;  // has no peaks
    if (here.error > rounding && (here.error <= options.tolerance || coefficients == options.most_coefficients)) {
      std::vector<Place> more = around_peaks(all, here);
      integrate(model, options, more, fit);
      measure(more, here);
      all.insert(all.end(), more.begin(), more.end());
      sort(all);
    }
    if (merit(here) < merit(best)) best = std::move(here);
    return best.error <= options.tolerance;
  };
  std::vector<RationalTrial> trials = trials_of(false);
  bool is_enough = false;
  for (std::size_t count = 1; count <= options.most_coefficients && !is_enough; ++count) {
    is_enough = suffice(trials, count, false);
  }
  if (!is_enough && options.most_coefficients % 2 == 0) {
    std::vector<RationalTrial> shifted = trials_of(true);
    suffice(shifted, options.most_coefficients, true);
  }
  best = finish(std::move(best));
  if (best.status == Status::converged && !(best.error <= options.tolerance)) best.status = Status::budget_exhausted;
  return best;
}

}  // namespace albedo
