#include <algorithm>
#include <cmath>

#include "albedo/microfacet/sampling.hpp"
#include "audit/parts.hpp"
#include "numerics/function_integrand.hpp"
#include "rules/kronrod.hpp"

namespace albedo {
namespace {

constexpr RuleOptions options{.tolerance = 1e-10, .budget = 1'000'000, .seed = 1};
constexpr double slack = 1e-8;

/// The lobe of half vectors that the distribution is of.
const SlopeLobe* facet_lobe(const std::vector<Lobe>& lobes) {
  const auto found = std::ranges::find_if(lobes, &Lobe::is<SlopeLobe>);
  return found == lobes.end() ? nullptr : &found->slopes();
}

/// ∫ D(H) (N·H)^power dω_H over slopes (width_x r cosφ, width_y r sinφ), r = u/(1 − u), dω_H = cos³θ_H d²slope.
Estimate integral(const Model& model, const SlopeLobe& lobe, int power) {
  const UnitVector<double> normal{0, 0, 1};
  const auto integrand = [&](int, double u, double v) {
    const double r = u / (1 - u), phi = pi<double> / 2 * v;
    // all quadrants are alike
    const DirectionPair<double> d =
        reflected(normal, lobe.width_x * r * std::cos(phi), lobe.width_y * r * std::sin(phi));
    const double cos3 = d.cos_theta_h * d.cos_theta_h * d.cos_theta_h;
    const double area = lobe.width_x * lobe.width_y * r / square(1 - u);
    return 2 * pi<double> * model.facet_distribution(d) * std::pow(d.cos_theta_h, power) * cos3 * area;
  };
  return kronrod(FunctionIntegrand({Panel{}}, integrand), options);
}

/// ∫ G₁ D (L·H)₊ dω_H/(N·L) over slopes in units of the lobe's widths, along the light (panels between the places where
/// L·H = 0 and where V-cavities begin to shade) and across it, both as a sinh.
Estimate furnace(const Model& model, const SlopeLobe& lobe, const Direction& direction) {
  constexpr double reach = 40;  // sinh of it: what GGX's tail has beyond is 1e-17
  const UnitVector<double> l = unit_vector<double>(direction);
  const double x = lobe.width_x * l.x, y = lobe.width_y * l.y;
  const double lean = std::hypot(x, y);  // L·H/N·H = L_z + lean · along
  const double ex = lean > 0 ? x / lean : 1, ey = lean > 0 ? y / lean : 0;
  const double edge = lean > 0 ? std::min(std::asinh(l.z / lean), reach) : reach;
  std::vector<double> edges{-edge, 0};
  if (edge < reach) edges.push_back(edge);
  edges.push_back(reach);
  const auto integrand = [&](int panel, double u, double v) {
    const auto i = static_cast<std::size_t>(panel / 2);
    const double width = edges[i + 1] - edges[i];
    const double p = edges[i] + width * u, q = (panel % 2 == 0 ? reach : -reach) * v;
    const double along = std::sinh(p), across = std::sinh(q);
    const double facing = l.z + lean * along;
    if (!(facing > 0)) return 0.0;
    const DirectionPair<double> d =
        reflected(l, lobe.width_x * (along * ex - across * ey), lobe.width_y * (along * ey + across * ex));
    const double area = lobe.width_x * lobe.width_y * std::cosh(p) * std::cosh(q) * width * reach;
    const double cos4 = square(square(d.cos_theta_h));
    return model.facet_masking(d) * model.facet_distribution(d) * facing * cos4 * area / l.z;
  };
  return kronrod(FunctionIntegrand(std::vector<Panel>(2 * (edges.size() - 1)), integrand), options);
}

}  // namespace

DistributionAudit audit_distribution(const Model& model) {
  const std::vector<Lobe> lobes = model.lobes();
  const SlopeLobe* lobe = facet_lobe(lobes);
  if (!model.has_facet_distribution() || lobe == nullptr) return {};
  DistributionAudit audit{.projected = integral(model, *lobe, 1), .solid_angle = integral(model, *lobe, 0)};
  const Measure claimed = model.claims().distribution;
  const Estimate& one = claimed == Measure::solid_angle ? audit.solid_angle : audit.projected;
  audit.verdict = claimed == Measure::none                       ? Verdict::not_claimed
                  : std::abs(one.value - 1) <= one.error + slack ? Verdict::pass
                  : one.status == Status::converged              ? Verdict::fails
                                                                 : Verdict::undecided;
  return audit;
}

MaskingAudit audit_masking(const Model& model) {
  const std::vector<Lobe> lobes = model.lobes();
  const SlopeLobe* lobe = facet_lobe(lobes);
  if (!model.has_facet_masking() || lobe == nullptr) return {};
  MaskingAudit audit{.furthest = {.value = 1}};
  double furthest = -1;
  bool doubtful = false;
  for (const double phi : azimuths_of(model)) {
    for (const double theta : {0.0, 30.0, 60.0, 80.0, 89.0, 89.99}) {
      const Estimate one = furnace(model, *lobe, Direction::from_degrees(theta, phi));
      doubtful = doubtful || one.status != Status::converged;
      const double distance = std::abs(one.value - 1);
      if (distance <= furthest || std::isnan(furthest)) continue;
      furthest = distance;
      audit.furthest = one;
      audit.theta_degrees = theta;
      audit.phi_degrees = phi;
    }
  }
  const bool is_one = furthest <= audit.furthest.error + slack;  // not where it is NaN
  const bool known = is_one ? !doubtful || audit.furthest.error <= 100 * slack
                            : audit.furthest.status == Status::converged || audit.furthest.status == Status::non_finite;
  audit.verdict = !model.claims().consistent_masking ? Verdict::not_claimed
                  : !known                           ? Verdict::undecided
                  : is_one                           ? Verdict::pass
                                                     : Verdict::fails;
  return audit;
}

}  // namespace albedo
