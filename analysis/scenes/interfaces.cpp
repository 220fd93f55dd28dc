#include "analysis/scenes/interfaces.hpp"

#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <string_view>
#include <utility>

#include "albedo/microfacet/fresnel.hpp"

namespace albedo::analysis {

std::optional<ComplexIndex> metal_index(const std::string& name) {
  if (name == "Ag") return ComplexIndex{.eta = {0.1733, 0.1261, 0.1249}, .k = {4.6133, 2.9641, 2.0176}};
  if (name == "Al") return ComplexIndex{.eta = {1.6624, 0.9134, 0.5462}, .k = {8.9635, 6.1058, 4.7902}};
  if (name == "Au") return ComplexIndex{.eta = {0.1257, 0.3496, 1.4099}, .k = {4.3255, 2.2199, 1.5668}};
  if (name == "Cu") return ComplexIndex{.eta = {0.2128, 0.9197, 1.1036}, .k = {3.9212, 2.4572, 2.1353}};
  return std::nullopt;
}

std::optional<double> dielectric_index(const std::string& name) {
  static constexpr std::array<std::pair<std::string_view, double>, 21> known{
      {{"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
       {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
       {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
       {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
       {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
       {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
       {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"diamond", 2.419}}};
  for (const auto& [known_name, index] : known) {
    if (known_name == name) return index;
  }
  return std::nullopt;
}

double mean_fresnel(double eta) {
  const Fresnel fresnel{.kind = FresnelKind::conductor, .eta = eta, .k = 0};
  const auto weighted = [&](double mu) { return 2 * fresnel(mu) * mu; };
  using Rule = boost::math::quadrature::gauss<double, 30>;
  // inside, all light is reflected below the critical angle
  const double critical = eta < 1 ? std::sqrt(1 - eta * eta) : 0;
  // mu = critical + s² (1 − critical): Fresnel's factor has a square root there
  const auto beyond = [&](double s) { return weighted(critical + s * s * (1 - critical)) * 2 * s * (1 - critical); };
  return critical * critical + Rule::integrate(beyond, 0.0, 1.0);
}

SceneValue body_albedo(const SceneValue& rho, double eta, bool nonlinear) {
  const double outside = mean_fresnel(eta), inside = mean_fresnel(1 / eta);
  return rho.mapped(
      [&](double albedo) { return albedo * (1 - outside) * (1 - inside) / (1 - (nonlinear ? albedo : 1) * inside); });
}

}  // namespace albedo::analysis
