#include "plots/data/lobe_fit.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/parallel.hpp"

namespace albedo::analysis {
namespace {

struct Sample {
  Direction l, v;
  double weight, target;  ///< of the square; f cosθ_L
};

std::vector<Sample> samples_of(const Model& target) {
  constexpr int azimuths = 12;
  const double degree = pi<double> / 180;
  std::vector<Sample> samples;
  for (double theta_l = 2.5; theta_l < 80; theta_l += 5) {
    for (double theta_v = 2.5; theta_v < 80; theta_v += 5) {
      for (int i = 0; i < azimuths; ++i) {
        const double t = (i + 0.5) / azimuths;  // closer together around the mirror direction
        const Direction l = Direction::from_degrees(theta_l), v = Direction::from_degrees(theta_v, 180 * (1 - t * t));
        samples.push_back({l, v, t * std::sin(theta_l * degree) * std::sin(theta_v * degree),
                           brdf<double>(target, l, v) * l.cos_theta});
      }
    }
  }
  return samples;
}

/// The best scale and Lambertian part of a lobe of scale 1.
LobeFit linear_fit(const std::vector<Sample>& samples, const std::string& model, const Parameters& parameters) {
  const auto lobe = make_model(model, parameters);
  double ff = 0, fc = 0, cc = 0, ft = 0, ct = 0, tt = 0, total = 0;
  for (const Sample& s : samples) {
    const double f = brdf<double>(*lobe, s.l, s.v) * s.l.cos_theta, c = s.l.cos_theta / pi<double>;
    ff += s.weight * f * f, fc += s.weight * f * c, cc += s.weight * c * c;
    ft += s.weight * f * s.target, ct += s.weight * c * s.target, tt += s.weight * s.target * s.target;
    total += s.weight;
  }
  const double determinant = ff * cc - fc * fc;
  LobeFit fit{.parameters = parameters,
              .scale = (ft * cc - ct * fc) / determinant,
              .diffuse = (ct * ff - ft * fc) / determinant};
  if (!(fit.diffuse >= 0)) fit.diffuse = 0, fit.scale = ft / ff;
  if (!(fit.scale >= 0)) fit.scale = 0, fit.diffuse = ct / cc;
  const double square_sum = tt - 2 * (fit.scale * ft + fit.diffuse * ct) + fit.scale * fit.scale * ff +
                            2 * fit.scale * fit.diffuse * fc + fit.diffuse * fit.diffuse * cc;
  fit.error = std::sqrt(std::max(square_sum, 0.0) / total);
  return fit;
}

}  // namespace

LobeFit fit_lobe(const Model& target, const std::string& model, const Parameters& fixed,
                 const std::vector<FitParameter>& searched, const FitScales& scales) {
  const std::vector<Sample> samples = samples_of(target);
  std::size_t starts = 1;
  for (const FitParameter& parameter : searched) starts *= parameter.starts.size();
  std::vector<LobeFit> fits(starts);
  in_parallel(starts, 0, [&](std::size_t start) {
    std::vector<double> place;
    std::size_t rest = start;
    for (const FitParameter& parameter : searched) {
      place.push_back(parameter.starts[rest % parameter.starts.size()]);
      rest /= parameter.starts.size();
    }
    const auto fit_at = [&](const std::vector<double>& values) {
      Parameters parameters = fixed;
      for (std::size_t i = 0; i < values.size(); ++i) parameters.emplace_back(searched[i].name, values[i]);
      return linear_fit(samples, model, parameters);
    };
    LobeFit best = fit_at(place);
    for (double step = 0.1; step > 1e-5;) {
      const double before = best.error;
      for (std::size_t i = 0; i < place.size(); ++i) {
        for (const double sign : {-1.0, 1.0}) {
          std::vector<double> there = place;
          const double minimum = searched[i].minimum, maximum = searched[i].maximum;
          there[i] = std::clamp(place[i] + sign * step * (maximum - minimum), minimum, maximum);
          LobeFit fit = fit_at(there);
          if (fit.error < best.error) best = std::move(fit), place = there;
        }
      }
      if (!(best.error < before * (1 - 1e-6))) step /= 2;
    }
    fits[start] = best;
  });
  LobeFit result = *std::ranges::min_element(fits, {}, &LobeFit::error);
  result.parameters.emplace_back(scales.scale, result.scale);
  result.parameters.emplace_back(scales.diffuse, result.diffuse);
  return result;
}

}  // namespace albedo::analysis
