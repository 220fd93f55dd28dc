#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <limits>

#include "analysis/claims/measure.hpp"

namespace albedo::analysis {
namespace {

constexpr std::array exponents{0.0, 1.0, 10.0, 100.0, 10000.0};

std::string label_of(double n_u, double n_v) { return "n_u=" + show(n_u) + " n_v=" + show(n_v); }

/// Exchanging n_u and n_v turns the surface by 90 degrees: one of both is enough where all azimuths are looked at.
std::vector<Case> all_exponents(const ModelSource& make, const Parameters& others) {
  std::vector<Case> cases;
  for (const double n_u : exponents) {
    for (const double n_v : exponents) {
      if (n_v < n_u) continue;
      Parameters parameters{{"n_u", n_u}, {"n_v", n_v}};
      parameters.insert(parameters.end(), others.begin(), others.end());
      cases.push_back({label_of(n_u, n_v), make("ashikhmin_shirley", parameters)});
    }
  }
  return cases;
}

/// r(k), the paper's bound of R(k)
double bound(double r_s, double cosine) {
  const double base = 1 - cosine / 2;
  return r_s + (1 - r_s) * square(square(base)) * base;
}

// --- A1 ---

Finding density_integrates_to_one(const ModelSource& make) {
  Finding finding;
  Worst worst;
  double error = 0;
  for (const Case& one : all_exponents(make, {})) {
    const Estimate integral = facet_integral(*one.model, 0);
    worst.look(std::abs(integral.value - 1), one.label);
    error = std::max(error, integral.error);
    finding.quantities.push_back(quantity("integral " + one.label, integral));
  }
  finding.verdict = error > 1e-6                  ? ClaimVerdict::undecided
                    : worst.value <= error + 1e-8 ? ClaimVerdict::holds
                                                  : ClaimVerdict::fails;
  finding.found = "its integral over the half vectors is within " + show(worst.value, 1) + " +- " + show(error, 1) +
                  " of 1 for all of " + std::to_string(finding.quantities.size()) + " pairs of exponents, 0 ... 10000";
  if (finding.verdict == ClaimVerdict::fails) finding.worst = worst.where, finding.repair = "p_h over its integral";
  return finding;
}

// --- A2, A7, A10: energy ---

Finding energy_of_all_exponents(const std::vector<Case>& cases, const std::string& what) {
  const Energies energies = energies_of(cases);
  Finding finding{.verdict = energies.conserved()};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    finding.quantities.push_back(quantity("largest albedo " + cases[i].label, energies.all[i].largest));
  }
  finding.found =
      what + ": largest albedo of " + std::to_string(cases.size()) + " materials " + largest_text(energies, cases);
  if (energies.above.empty()) return finding;
  finding.condition = "not " + list_of(energies.above);
  finding.worst = std::to_string(energies.above.size()) + " of " + std::to_string(cases.size()) + " pass 1";
  finding.repair = "a scale of " + show(1 / energies.all[energies.worst].largest.value, 6);
  return finding;
}

std::vector<Case> with_reflectances(const ModelSource& make, const std::vector<double>& all_r_s, double r_d) {
  std::vector<Case> cases;
  for (const double r_s : all_r_s) {
    for (Case& one : all_exponents(make, {{"r_s", r_s}, {"r_d", r_d}})) {
      cases.push_back({one.label + " R_s=" + show(r_s), std::move(one.model)});
    }
  }
  return cases;
}

Finding specular_conserves_energy(const ModelSource& make) {
  return energy_of_all_exponents(with_reflectances(make, {0.05, 1}, 0), "specular term");
}

Finding both_terms_conserve_energy(const ModelSource& make) {
  return energy_of_all_exponents(with_reflectances(make, {0, 0.05, 0.5}, 1), "both terms, R_d=1");
}

Finding other_normalisation_conserves_energy(const ModelSource& make) {
  Finding finding = energy_of_all_exponents(all_exponents(make, {{"normalization", std::string("projected")}}),
                                            "specular term with (n+2) in place of (n+1), R_s=1");
  return finding;
}

// --- A3 ---

Finding darkest_sphere(const ModelSource& make) {
  constexpr double claimed = 0.68, rounding = 0.005;
  const auto centre = [&](double n, double r_s) {
    return albedo_at(*make("ashikhmin_shirley", {{"n", n}, {"r_s", r_s}}), 0);
  };
  const Estimate found = centre(10, 1);
  Finding finding{.quantities = {quantity("albedo at normal incidence", found)}};
  const double off = std::abs(found.value - claimed);
  finding.verdict = off <= rounding + found.error ? ClaimVerdict::holds : ClaimVerdict::fails;
  finding.found = "a(0) = " + with_error(found) + " for n_u = n_v = 10, R_s = 1: " + show(100 * found.value, 4) + " %";
  if (finding.verdict == ClaimVerdict::holds) return finding;
  finding.worst = show(100 * off, 3) + " points off, where two digits are given";
  const double r_s = threshold([&](double r) { return centre(10, r).value > claimed; }, 0.5, 1);
  const double n = threshold([&](double e) { return centre(e, 1).value > claimed; }, 1, 100);
  finding.quantities.push_back({"R_s of 68 %", r_s, 1e-8});
  finding.quantities.push_back({"n of 68 %", n, 1e-8 * n});
  finding.repair = "68 % is R_s = " + show(r_s, 4) + " with n = 10, or n = " + show(n, 4) + " with R_s = 1";
  return finding;
}

// --- A4, A5: the bound of R ---

Finding approximation_is_a_bound(const ModelSource& make) {
  Worst worst;
  double error = 0;
  int directions = 0;
  for (const double r_s : {0.0, 0.05, 0.5, 1.0}) {
    for (const Case& one : all_exponents(make, {{"r_s", r_s}})) {
      for (const double theta : {0.0, 20.0, 40.0, 60.0, 75.0, 85.0, 89.0, 89.9}) {
        for (const double phi : {0.0, 45.0, 90.0}) {
          if (phi > 0 && one.model->claims().isotropic) continue;
          const Estimate a = albedo_at(*one.model, theta, phi);
          const double r = bound(r_s, Direction::from_degrees(theta).cos_theta);
          worst.look(a.value / r, one.label + " R_s=" + show(r_s) + ", " + degrees(theta) + ", azimuth " + show(phi));
          error = std::max(error, a.error / r);
          ++directions;
        }
      }
    }
  }
  Finding finding{.quantities = {{"largest R/r", worst.value, error}}};
  finding.verdict = worst.value <= 1 + 1e-12  ? ClaimVerdict::holds
                    : worst.value - error > 1 ? ClaimVerdict::fails
                                              : ClaimVerdict::undecided;
  finding.found = "largest R(k)/r(k) of " + std::to_string(directions) + " directions and materials " +
                  with_error(worst.value, error);
  finding.worst = worst.where;
  if (finding.verdict == ClaimVerdict::fails) finding.repair = "r(k) times " + show(worst.value, 6);
  return finding;
}

Finding least_half_vector_cosine(const ModelSource&) {
  double least_ratio = std::numeric_limits<double>::infinity(), furthest = 0;
  std::string where;
  for (int i = 0; i <= 120; ++i) {
    const double cosine = std::pow(10, -i / 20.0);
    const Direction k = Direction::from_cosine(cosine);
    const UnitVector<double> l = unit_vector<double>(k);
    const double formula = cosine / std::sqrt(2 * (1 + k.sin_theta));  // the same without cancellation
    double found = 1;
    for (int j = 0; j <= 64; ++j) {
      for (int turn = 0; turn <= 64; ++turn) {
        const auto v = unit_vector<double>(Direction::from_cosine(j / 64.0, 180.0 * turn / 64));
        found = std::min(found, direction_pair(l, v, l).cos_theta_d);
      }
    }
    furthest = std::max(furthest, std::abs(found / formula - 1));
    if (formula / (cosine / 2) < least_ratio) least_ratio = formula / (cosine / 2), where = "k.n = " + show(cosine, 3);
  }
  Finding finding{.quantities = {{"least (k.h)_min/((k.n)/2)", least_ratio, 0},
                                 {"(k.h)_min found, relative distance from the formula", furthest, 0}}};
  finding.verdict = least_ratio >= 1 - 1e-12 && furthest < 1e-9 ? ClaimVerdict::holds : ClaimVerdict::fails;
  finding.found = "least k.h over all k2, found on a grid, within " + show(furthest, 1) +
                  " of the formula; least (k.h)_min/((k.n)/2) = " + show(least_ratio, 10) + " at " + where +
                  " (6 decades of k.n)";
  return finding;
}

// --- A6 ---

Finding diffuse_constant(const ModelSource& make) {
  Finding finding;
  Worst worst, of_direction;
  for (const double r_s : {0.0, 0.05, 0.2, 0.5, 0.9}) {
    const auto diffuse = make("ashikhmin_shirley", {{"k_s", 0.0}, {"r_s", r_s}, {"r_d", 1.0}});
    const auto total = [&](double cosine) {
      return bound(r_s, cosine) +
             directional_albedo(*diffuse, Direction::from_cosine(cosine), {.tolerance = 1e-12}).value;
    };
    // polynomials of degree 6
    const double reflected = boost::math::quadrature::gauss<double, 10>::integrate(
        [&](double cosine) { return 2 * cosine * total(cosine); }, 0.0, 1.0);
    worst.look(std::abs(reflected - 1), "R_s=" + show(r_s));
    for (const double cosine : {1.0, 0.7, 0.4, 0.1, 0.01}) of_direction.look(std::abs(total(cosine) - 1), show(cosine));
    finding.quantities.push_back({"reflected R_s=" + show(r_s), reflected, 1e-12});
  }
  finding.verdict = worst.value <= 1e-9 ? ClaimVerdict::holds : ClaimVerdict::fails;
  finding.found = "reflected energy at R_d = 1, R = r, within " + show(worst.value, 1) + " of what comes in (" +
                  worst.where + "); of one direction within " + show(of_direction.value, 1);
  if (finding.verdict == ClaimVerdict::fails) finding.worst = worst.where;
  return finding;
}

// --- A8 ---

Finding sampling_is_right(const ModelSource& make) {
  std::vector<Case> cases;
  cases.push_back({"n=10", make("ashikhmin_shirley", {{"n", 10.0}})});
  cases.push_back({label_of(10, 1000), make("ashikhmin_shirley", {{"n_u", 10.0}, {"n_v", 1000.0}})});
  // eqs. 19, 20 in the first quadrant, which a quarter of the numbers goes to
  const auto furthest = [&](bool root) {
    Worst worst;
    const double n_u = 10, n_v = 1000;
    const Direction l = Direction::from_degrees(20, 30);
    const auto map = [&](double u, double v) {
      const double ratio = (n_u + 1) / (n_v + 1);
      const double phi = std::atan((root ? std::sqrt(ratio) : ratio) * std::tan(pi<double> * u / 2));
      const double e = n_u * square(std::cos(phi)) + n_v * square(std::sin(phi));
      return std::pair{std::acos(std::pow(1 - v, 1 / (e + 1))), phi};
    };
    for (const double u : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      for (const double v : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        const auto [theta, phi] = map(u, v);
        const double said = half_vector_density(*cases.back().model, l, theta, phi);
        worst.look(std::abs(density_of_map(map, u, v) / 4 / said - 1), "");
      }
    }
    return worst.value;
  };
  const double with_root = furthest(true), without_root = furthest(false);
  const SamplerSummary samplers = samplers_of(cases);
  Finding finding{.quantities = {{"density off, eqs. 19 and 20", with_root, 0},
                                 {"density off, eq. 19 without the root", without_root, 0},
                                 {"least p of chi-squared", samplers.least_p, 0},
                                 {"integral of p(k2) off 1", samplers.integral_off, 0},
                                 {"mean weight off the albedo, in standard errors", samplers.mean_weight_off, 0},
                                 {"largest part below the horizon", samplers.below_horizon, 0}}};
  const bool formula = with_root < 1e-6;
  finding.verdict = formula && samplers.pass ? ClaimVerdict::holds : ClaimVerdict::fails;
  finding.found =
      "density of eqs. 19, 20 within " + show(with_root, 1) + " of p_h (" + show(100 * without_root, 3) +
      " % off without the root of eq. 19); chi-squared of directions drawn: least p " + show(samplers.least_p, 2) +
      " of " + std::to_string(samplers.tests) + "; p(k2) integrates to 1 within " + show(samplers.integral_off, 1) +
      "; with weight 0 below the horizon (up to " + show(100 * samplers.below_horizon, 3) +
      " % of samples) the mean weight is the albedo within " + show(samplers.mean_weight_off, 2) + " standard errors";
  return finding;
}

// --- A9 ---

Finding mirror_in_the_limit(const ModelSource& make) {
  Finding finding;
  Worst worst;
  bool vanishes = true;
  constexpr std::array ns{1e6, 1e7, 1e8};
  for (const double theta : {0.0, 30.0, 60.0, 80.0, 89.0, 89.9}) {
    std::array<double, 3> lost{};
    for (std::size_t i = 0; i < ns.size(); ++i) {
      const Estimate a = albedo_at(*make("neumann_phong", {{"n", ns[i]}}), theta);
      lost[i] = 1 - a.value;
      if (i + 1 == ns.size())
        finding.quantities.push_back({"1 - R at " + degrees(theta) + ", n=1e8", lost[i], a.error});
    }
    worst.look(lost.back(), degrees(theta));
    // like n^-1/2 at least, or nothing to speak of
    vanishes = vanishes && (std::abs(lost[2]) < 1e-8 || lost[2] < 0.5 * lost[1]);
  }
  const Estimate grazing = albedo_at(*make("neumann_phong", {{"n", ns.back()}}), 90);
  finding.verdict = vanishes ? ClaimVerdict::holds : ClaimVerdict::fails;
  finding.found = "1 - R falls at least like n^-1/2 at 0 ... 89.9 degrees, to " + show(worst.value, 3) + " at " +
                  worst.where + " for n = 1e8; exactly at grazing R tends to " + with_error(grazing, 6);
  if (!vanishes) finding.found = "1 - R = " + show(worst.value, 3) + " at " + worst.where + " for n = 1e8";
  return finding;
}

}  // namespace

std::vector<Claim> ashikhmin_claims() {
  constexpr Paper p = Paper::ashikhmin;
  return {
      {"A1", p, "eq. 5", "p_h integrates to 1 over the half vectors, for all n_u, n_v", &density_integrates_to_one},
      {"A2", p, "eq. 9", "the specular term conserves energy for all n_u, n_v, R_s", &specular_conserves_energy},
      {"A3", p, "fig. 2", "the centre of the n_u = n_v = 10 furnace sphere is at about 68 %", &darkest_sphere},
      {"A4", p, "sec. 3", "r(k) = R_s + (1-R_s)(1-(k.n)/2)^5 bounds R(k) from above, for all n_u, n_v, R_s, k",
       &approximation_is_a_bound},
      {"A5", p, "below eq. 13", "(k.h)_min = sqrt((1-sqrt(1-(k.n)^2))/2) >= (k.n)/2", &least_half_vector_cosine},
      {"A6", p, "eq. 14",
       "28/(23 pi) makes total reflected energy equal the incident energy at R_d = 1 (with R approximated by r)",
       &diffuse_constant},
      {"A7", p, "sec. 3", "diffuse + specular together conserve energy for every direction",
       &both_terms_conserve_energy},
      {"A8", p, "eqs. 17-20", "eqs. 19-20 sample p_h; p(k2) = p_h/(4 k1.h); weight 0 below the horizon",
       &sampling_is_right},
      {"A9", p, "below eq. 2",
       "Neumann's form (eq. 2) tends to R(k) = 1 as n -> infinity for any k not exactly at grazing",
       &mirror_in_the_limit},
      {"A10", p, "Kurt sec. 2",
       "normalising as Pharr & Humphreys do (cos theta_h was left out of the integral) keeps the model "
       "energy-conserving",
       &other_normalisation_conserves_energy},
  };
}

}  // namespace albedo::analysis
