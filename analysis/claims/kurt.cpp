#include <algorithm>
#include <limits>
#include <random>

#include "albedo/microfacet/sampling.hpp"
#include "analysis/claims/measure.hpp"
#include "analysis/claims/variants.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

constexpr std::array roughnesses{0.01, 0.05, 0.1, 0.3, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 20.0, 100.0};

std::vector<Case> over_roughness(const std::function<std::unique_ptr<Model>(double m)>& make) {
  std::vector<Case> cases;
  for (const double m : roughnesses) cases.push_back({"m=" + show(m), make(m)});
  return cases;
}

/// From the limit integral where that is known, to more digits than a fit's.
double exponent_of(const Grazing& grazing) {
  return grazing.limit.status == Status::converged ? grazing.limit.exponent : grazing.fit.exponent;
}

bool creates_energy(const EnergyAudit& energy) { return energy.largest.value - energy.largest.error > 1 + 1e-12; }

void append(std::vector<Quantity>& quantities, const std::string& name, const Energies& energies,
            const std::vector<Case>& cases) {
  for (std::size_t i = 0; i < cases.size(); ++i) {
    quantities.push_back(quantity(name + " " + cases[i].label, energies.all[i].largest));
  }
}

/// Where between the last m without an excess and the first with one it begins.
double roughness_limit(const std::vector<Case>& cases, const Energies& energies,
                       const std::function<std::unique_ptr<Model>(double m)>& make) {
  for (std::size_t i = 1; i < cases.size(); ++i) {
    if (!creates_energy(energies.all[i]) || creates_energy(energies.all[i - 1])) continue;
    return threshold([&](double m) { return creates_energy(energy_of(*make(m))); }, roughnesses[i - 1], roughnesses[i]);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// --- K1, K8: what a distribution integrates to ---

Finding distribution_is_normalised(const ModelSource& make) {
  Finding finding;
  Worst worst;
  double error = 0;
  for (const double m_x : {0.01, 0.1, 1.0, 10.0}) {
    for (const double m_y : {0.01, 0.1, 1.0, 10.0}) {
      const std::string label = "m_x=" + show(m_x) + " m_y=" + show(m_y);
      const Estimate integral = facet_integral(*make("kurt", {{"m_x", m_x}, {"m_y", m_y}}), 1);
      worst.look(std::abs(integral.value - 1), label);
      error = std::max(error, integral.error);
      finding.quantities.push_back(quantity("integral " + label, integral));
    }
  }
  finding.verdict = error > 1e-6                  ? ClaimVerdict::undecided
                    : worst.value <= error + 1e-8 ? ClaimVerdict::holds
                                                  : ClaimVerdict::fails;
  finding.found = "the integral of D cos theta_h is within " + show(worst.value, 1) + " +- " + show(error, 1) +
                  " of 1 for all of 16 pairs m_x, m_y, 0.01 ... 10";
  if (finding.verdict == ClaimVerdict::fails) finding.worst = worst.where, finding.repair = "D over its integral";
  return finding;
}

Finding ashikhmin_shirley_is_not_normalised(const ModelSource& make) {
  Finding finding;
  Worst as_density, as_heights;
  std::vector<std::string> parts;
  for (const double n : {0.0, 1.0, 10.0, 100.0, 1000.0}) {
    const auto model = make("ashikhmin_shirley", {{"n", n}});
    const Estimate density = facet_integral(*model, 0), heights = facet_integral(*model, 1);
    as_density.look(std::abs(density.value - 1), "n=" + show(n));
    as_heights.look(std::abs(heights.value - 1), "n=" + show(n));
    finding.quantities.push_back(quantity("integral of p_h n=" + show(n), density));
    finding.quantities.push_back(quantity("integral of p_h cos theta_h n=" + show(n), heights));
    parts.push_back(show(heights.value, 4) + " (n=" + show(n) + ")");
  }
  const bool is_density = as_density.value < 1e-7, is_heights = as_heights.value < 1e-7;
  finding.verdict = is_density && is_heights   ? ClaimVerdict::fails
                    : is_density || is_heights ? ClaimVerdict::holds_if
                                               : ClaimVerdict::holds;
  finding.found = "the integral of p_h is within " + show(as_density.value, 1) + " of 1, that of p_h cos theta_h is " +
                  list_of(parts);
  if (finding.verdict != ClaimVerdict::holds_if) return finding;
  finding.condition = is_density ? "the measure is projected area (eq. 7); in solid angle it is a normalised density, "
                                   "which is what its authors' proof of energy conservation needs"
                                 : "the measure is solid angle";
  const Worst& worst = is_density ? as_heights : as_density;
  finding.worst = "the other integral is " + show(worst.value, 4) + " from 1 for " + worst.where;
  finding.repair = "(n+2) for (n+1) in eq. 5, as Pharr & Humphreys do: then A10 applies";
  return finding;
}

// --- K2, K3, K4: energy over m ---

Finding bound_suffices(const ModelSource& make) {
  const auto with = [](double density) {
    return over_roughness([density](double m) { return make_model<KurtBound>({{"m", m}, {"density", density}}); });
  };
  const std::vector<Case> cases = with(0), repaired = with(1);
  const Energies energies = energies_of(cases), after = energies_of(repaired);
  Finding finding{.verdict = energies.above.empty() ? energies.conserved() : ClaimVerdict::fails};
  append(finding.quantities, "largest albedo", energies, cases);
  append(finding.quantities, "largest albedo with D cos theta_h", after, repaired);
  finding.found = "with equality and F = 1 the largest albedo is " + largest_text(energies, cases) + ", " +
                  with_error(energies.all[2].largest) + " for m=0.1";
  if (energies.above.empty()) return finding;
  finding.worst = "passes 1 for " + list_of(energies.above) + "; the integral of D without the cosine is " +
                  with_error(facet_integral(*make("kurt", {{"m", 0.1}}), 0), 6) + " for m=0.1, more than 1";
  finding.repair = "D cos theta_h for D in eq. 8: largest albedo " + largest_text(after, repaired) +
                   (after.above.empty() ? ", none above 1" : ", still above 1");
  return finding;
}

Finding equation_9_is_plausible(const ModelSource& make) {
  const auto eq_9 = [&](double m) { return make("kurt", {{"m", m}, {"equation", "9"}}); };
  const auto with_cosine = [](double m) { return make_model<KurtMax>({{"m", m}, {"density", 1.0}}); };
  const std::vector<Case> cases = over_roughness(eq_9), repaired = over_roughness(with_cosine);
  const Energies energies = energies_of(cases), after = energies_of(repaired);
  const double asymmetry = audit(*cases[2].model).reciprocity.asymmetry;
  Finding finding{.verdict = energies.conserved(), .quantities = {{"asymmetry", asymmetry, 0}}};
  append(finding.quantities, "largest albedo", energies, cases);
  append(finding.quantities, "largest albedo with D cos theta_h", after, repaired);
  finding.found = "reciprocal (asymmetry " + show(asymmetry, 1) + "); largest albedo " + largest_text(energies, cases);
  if (asymmetry > 1e-12) finding.verdict = ClaimVerdict::fails;
  if (energies.above.empty()) return finding;
  const double limit = roughness_limit(cases, energies, eq_9);
  finding.quantities.push_back({"m at which it passes 1", limit, 1e-6});
  finding.condition = "m <= " + show(limit, 5);
  finding.worst = "passes 1 for " + list_of(energies.above) + ", " + largest_text(energies, cases);
  finding.repair = "D cos theta_h for D in eq. 9: largest albedo " + largest_text(after, repaired) +
                   (after.above.empty() ? ", none above 1" : ", still above 1");
  return finding;
}

Finding without_alpha_is_plausible(const ModelSource& make) {
  const std::vector<Case> cases = over_roughness([&](double m) { return make("kurt", {{"m", m}, {"exponent", 0.0}}); });
  const Energies energies = energies_of(cases);
  const double asymmetry = audit(*cases[2].model).reciprocity.asymmetry;
  Finding finding{.verdict = energies.conserved(), .quantities = {{"asymmetry", asymmetry, 0}}};
  append(finding.quantities, "largest albedo", energies, cases);
  if (asymmetry > 1e-12) finding.verdict = ClaimVerdict::fails;
  finding.found = "reciprocal (asymmetry " + show(asymmetry, 1) + "); largest albedo over m = 0.01 ... 100 " +
                  largest_text(energies, cases);
  if (energies.above.empty()) return finding;
  finding.condition = "not " + list_of(energies.above);
  finding.worst = "passes 1 for " + list_of(energies.above);
  finding.repair = "a scale of " + show(1 / energies.all[energies.worst].largest.value, 6);
  return finding;
}

// --- K5 ---

Finding with_alpha_is_plausible(const ModelSource& make) {
  Finding finding;
  bool exponent_is_alpha = true, unknown = false;
  double furthest = 0, earliest = 90;
  std::string earliest_label;
  std::vector<std::string> bounded, map;
  Worst repaired;
  for (const double m : {0.05, 0.1, 0.3, 1.0}) {
    std::vector<std::string> row;
    for (const double alpha : {0.01, 0.1, 0.25, 0.5, 0.75}) {
      const std::string label = "m=" + show(m) + " alpha=" + show(alpha);
      const auto model = make("kurt", {{"m", m}, {"exponent", alpha}});
      const PowerLaw fit = grazing_behaviour(*model).fit;
      unknown = unknown || fit.status != Status::converged;
      furthest = std::max(furthest, std::abs(fit.exponent - alpha));
      exponent_is_alpha = exponent_is_alpha && std::abs(fit.exponent - alpha) < 1e-3;
      const Crossing crossing = critical_angle(*model);
      finding.quantities.push_back({"exponent " + label, fit.exponent, fit.exponent_error});
      if (fit.exponent < 1e-3 && !crossing.exists) bounded.push_back(label);
      if (crossing.exists) {
        const double theta = Direction::from_cosine(crossing.cos_theta).theta_degrees();
        finding.quantities.push_back({"passes 1 (degrees) " + label, theta, crossing.error});
        if (theta < earliest) earliest = theta, earliest_label = label;
        row.push_back(theta < 89.9995 ? show(theta, 5) : "90-" + show(crossing.cos_theta * 180 / pi<double>, 1));
      } else {
        row.emplace_back("-");
      }
      const EnergyAudit after = energy_of(*make_model<KurtMax>({{"m", m}, {"power", std::min(2 * alpha, 1.0)}}));
      repaired.look(after.largest.value, label);
    }
    map.push_back("m=" + show(m) + ": " + list_of(row));
  }
  finding.verdict = unknown ? ClaimVerdict::undecided : bounded.empty() ? ClaimVerdict::fails : ClaimVerdict::holds_if;
  finding.found = exponent_is_alpha ? "a ~ C (N.L)^-alpha at grazing incidence (fitted exponents within " +
                                          show(furthest, 1) + "): infinite for every alpha > 0"
                                    : "fitted exponents are up to " + show(furthest, 3) + " from alpha";
  if (!bounded.empty()) finding.condition = list_of(bounded);
  finding.worst = "passes 1 first at " + degrees(earliest) + " (" + earliest_label +
                  "). Degrees at which it does for alpha = 0.01, 0.1, 0.25, 0.5, 0.75 (-: closer to 90 than 1e-60): ";
  for (std::size_t i = 0; i < map.size(); ++i) finding.worst += (i > 0 ? "; " : "") + map[i];
  finding.repair = "max(w_i.n, w_o.n)^min(2 alpha, 1) for ((w_i.n)(w_o.n))^alpha: largest albedo " +
                   show(repaired.value, 8) + " (" + repaired.where + ")";
  return finding;
}

// --- K6 ---

struct Fit {
  const char* name;
  std::array<double, 3> k_d, k_s;
  double f0, m_x, m_y, alpha;
};

/// Kurt et al. 2010, table 2
constexpr std::array fits{
    Fit{"brushed aluminum", {0.0036, 0.0034, 0.0026}, {0.0115, 0.0105, 0.0075}, 0.999, 0.035, 0.129, 0.005},
    Fit{"purple satin", {0.0026, 0.0004, 0.0011}, {0.1404, 0.0522, 0.0711}, 0.055, 0.339, 1.256, 0},
    Fit{"red velvet", {0.0048, 0.0005, 0}, {0.1938, 0.0333, 0.0267}, 0.041, 2.337, 2.644, 0},
    Fit{"yellow satin", {0.0066, 0.0022, 0.0004}, {0.0542, 0.0345, 0.0131}, 0.207, 0.129, 1.084, 0.197}};

Finding fits_are_plausible(const ModelSource& make) {
  Finding finding;
  std::vector<std::string> plausible, others, parts, repairs;
  for (const Fit& fit : fits) {
    // the same channel has both: no other is brighter anywhere
    const double k_s = *std::ranges::max_element(fit.k_s), k_d = *std::ranges::max_element(fit.k_d);
    const auto material = [&](double scale, double diffuse, double alpha) {
      return make("kurt", {{"equation", "11"},
                           {"m_x", fit.m_x},
                           {"m_y", fit.m_y},
                           {"exponent", alpha},
                           {"f0", fit.f0},
                           {"k_s", scale},
                           {"k_d", diffuse}});
    };
    const EnergyAudit energy = energy_of(*material(k_s, k_d, fit.alpha));
    const bool above = creates_energy(energy) || std::isinf(energy.largest.value);
    // of the lobe alone: beside a Lambertian part a small power shows far beyond the angles of a fit
    const double exponent = exponent_of(grazing_behaviour(*material(k_s, 0, fit.alpha)));
    finding.quantities.push_back(
        {std::string("largest albedo ") + fit.name, energy.largest.value, energy.largest.error});
    finding.quantities.push_back({std::string("grazing exponent ") + fit.name, exponent, 1e-4});
    std::string text = std::string(fit.name) + " ";
    if (above) {
      others.emplace_back(fit.name);
      const EnergyAudit repaired = energy_of(*material(k_s, k_d, 0));
      repairs.push_back(std::string(fit.name) + " " + with_error(repaired.largest, 4));
      text += "diverges like (N.L)^-" + show(exponent, 3) +
              (energy.critical ? ", above 1 from cos theta = " + show(energy.critical->cos_theta, 2)
                               : ", above 1 only below cos theta = 1e-60");
    } else {
      plausible.push_back(std::string(fit.name) + " (alpha = " + show(fit.alpha) + ")");
      text += "at most " + show(energy.largest.value, 4);
    }
    parts.push_back(text);
  }
  finding.verdict = others.empty()      ? ClaimVerdict::holds
                    : plausible.empty() ? ClaimVerdict::fails
                                        : ClaimVerdict::holds_if;
  finding.found = "albedo (eq. 11, brightest channel): " + list_of(parts);
  if (others.empty()) return finding;
  if (!plausible.empty()) finding.condition = "the material is " + list_of(plausible);
  finding.worst = "not plausible, if far from any measured angle: " + list_of(others);
  finding.repair = "alpha = 0: then at most " + list_of(repairs);
  return finding;
}

// --- K7 ---

Finding sampling_is_right(const ModelSource& make) {
  const double m_x = 0.1, m_y = 0.4, alpha = 0.25, f0 = 0.25;  // exact in double, as their differences from 1
  const auto kurt = [&](double x, double y) {
    return make("kurt", {{"m_x", x}, {"m_y", y}, {"exponent", alpha}, {"f0", f0}});
  };
  std::vector<Case> cases;
  cases.push_back({"m=0.15", kurt(0.15, 0.15)});
  cases.push_back({"m=0.1,0.4", kurt(m_x, m_y)});
  const Model& model = *cases.back().model;

  // the weight, in 113 bits
  std::mt19937_64 engine(4);
  const auto uniform = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  Worst weight_off;
  for (int i = 0; i < 400; ++i) {
    const Direction direction = Direction::from_cosine(uniform(), 360 * uniform());
    const double u = uniform(), v = uniform();
    const auto drawn = model.quad().sample(0, unit_vector<Quad>(direction), Quad(u), Quad(v));
    const DirectionPair<Quad>& d = drawn.pair;
    if (!(d.cos_theta_v > 0)) continue;
    const Quad schlick = f0 + (1 - Quad(f0)) * fifth_power(Quad(1 - d.cos_theta_d));
    const Quad claimed =
        schlick * pow(d.cos_theta_v, Quad(1 - Quad(alpha))) / (d.cos_theta_h * pow(d.cos_theta_l, Quad(alpha)));
    const Quad weight = model.quad().evaluate(0, d) * d.cos_theta_v / drawn.density;
    weight_off.look(std::abs(static_cast<double>(weight / claimed - 1)), "");
  }

  // the density of eqs. 16, 17, with the arctangent in the quadrant of 2 pi xi_2 and as printed
  const auto phi_of = [&](double v, bool quadrant) {
    const double s = m_y * std::sin(2 * pi<double> * v), c = m_x * std::cos(2 * pi<double> * v);
    return quadrant ? std::atan2(s, c) : std::atan(s / c);
  };
  Worst density_off;
  int backwards_printed = 0, backwards = 0, forwards = 0;
  for (const double u : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    for (const double v : {0.05, 0.15, 0.3, 0.45, 0.6, 0.85}) {
      const auto map = [&](double a, double b) {
        const double phi = phi_of(b, true);
        const double scaled = square(std::cos(phi) / m_x) + square(std::sin(phi) / m_y);
        return std::pair{std::atan(std::sqrt(-std::log(a) / scaled)), phi};
      };
      const auto [theta, phi] = map(u, v);
      const double said = half_vector_density(model, Direction::from_degrees(30, 20), theta, phi);
      density_off.look(std::abs(density_of_map(map, u, v) / said - 1), "");
      (std::cos(phi) < 0 ? backwards : forwards) += 1;
      backwards_printed += std::cos(phi_of(v, false)) < 0 ? 1 : 0;
    }
  }
  const SamplerSummary samplers = samplers_of(cases);
  Finding finding{.quantities = {{"density off", density_off.value, 0},
                                 {"weight off", weight_off.value, 0},
                                 {"least p of chi-squared", samplers.least_p, 0},
                                 {"integral off 1 with |w_o.h|", samplers.integral_off, 0}}};
  const bool right = density_off.value < 1e-6 && weight_off.value < 1e-25 && samplers.pass;
  const bool covers = backwards_printed == backwards;
  // Eq. 20 has w_o.h, not its magnitude: facets that face away count negative.
  const Estimate away = facing_away(*kurt(0.5, 0.5), 85);
  const bool sign_matters = away.value > away.error + 1e-9;
  finding.quantities.push_back(
      {"integral of eq. 20 with the sign of w_o.h, m=0.5, 85 degrees", 1 - 2 * away.value, 2 * away.error});
  finding.verdict = !right                    ? ClaimVerdict::fails
                    : covers && !sign_matters ? ClaimVerdict::holds
                                              : ClaimVerdict::holds_if;
  finding.found = "eq. 20 is the density of eqs. 16-19 within " + show(density_off.value, 1) +
                  "; eq. 21 is f cos/p within " + show(weight_off.value, 1) +
                  "; chi-squared of directions drawn: least p " + show(samplers.least_p, 2) + " of " +
                  std::to_string(samplers.tests);
  std::vector<std::string> conditions, worst, repairs;
  if (!covers) {
    conditions.emplace_back("the arctangent of eq. 17 is taken in the quadrant of 2 pi xi_2");
    worst.push_back("with eq. 17 as printed " + std::to_string(backwards_printed) + " of " +
                    std::to_string(backwards + forwards) + " half vectors have cos phi_h < 0, and " +
                    std::to_string(backwards) + " should");
    repairs.emplace_back("phi_h = atan2(m_y sin 2 pi xi_2, m_x cos 2 pi xi_2)");
  }
  if (sign_matters) {
    conditions.emplace_back("w_o.h in eq. 20 is read as |w_o.h|");
    worst.push_back("with its sign eq. 20 integrates to " + show(1 - 2 * away.value, 5) + " at 85 degrees, m=0.5");
    repairs.emplace_back("|w_o.h|");
  }
  finding.condition = joined(conditions, ", and ");
  finding.worst = joined(worst, "; ");
  finding.repair = joined(repairs, ", ");
  return finding;
}

// --- K9 ---

Finding ward_and_duer_are_not_plausible(const ModelSource& make) {
  Finding finding;
  std::vector<std::string> plausible, parts;
  for (const char* name : {"ward", "ward_duer"}) {
    const auto model = make(name, {{"alpha", 0.1}});
    const Audit found = audit(*model);
    const bool above = creates_energy(found.energy) || std::isinf(found.energy.largest.value);
    if (!above && found.reciprocity.asymmetry < 1e-12) plausible.emplace_back(name);
    const PowerLaw& fit = found.grazing->fit;
    finding.quantities.push_back({std::string("exponent ") + name, fit.exponent, fit.exponent_error});
    std::string text = std::string(name) + ": asymmetry " + show(found.reciprocity.asymmetry, 1) + ", a ~ (N.L)^-" +
                       with_error(fit.exponent, fit.exponent_error, 6);
    if (found.energy.critical) {
      const double theta = Direction::from_cosine(found.energy.critical->cos_theta).theta_degrees();
      finding.quantities.push_back({std::string("passes 1 (degrees) ") + name, theta, found.energy.critical->error});
      text += ", above 1 beyond " + degrees(theta);
    }
    parts.push_back(text);
  }
  finding.verdict = plausible.empty()       ? ClaimVerdict::holds
                    : plausible.size() == 2 ? ClaimVerdict::fails
                                            : ClaimVerdict::holds_if;
  finding.found = "alpha=0.1: " + joined(parts, "; ");
  if (!plausible.empty()) finding.condition = "not " + list_of(plausible);
  return finding;
}

}  // namespace

std::vector<Claim> kurt_claims() {
  constexpr Paper p = Paper::kurt;
  return {
      {"K1", p, "eq. 7", "D of eq. 5 obeys eq. 7: the integral of D cos theta_h is 1", &distribution_is_normalised},
      {"K2", p, "eq. 8", "f <= F D/(4 (w_o.h)(w_i.n)) suffices for energy conservation", &bound_suffices},
      {"K3", p, "eq. 9, fig. 2", "eq. 9 is physically plausible whenever D is normalised, for all m",
       &equation_9_is_plausible},
      {"K4", p, "sec. 4", "eq. 10 with alpha = 0 is exactly physically plausible for all m",
       &without_alpha_is_plausible},
      {"K5", p, "sec. 4, fig. 3", "eq. 10 with alpha > 0 is plausible for suitable m and alpha",
       &with_alpha_is_plausible},
      {"K6", p, "table 2", "the four fits of table 2 are plausible materials", &fits_are_plausible},
      {"K7", p, "eqs. 16-21", "eq. 20 is the density of eqs. 16-19; the weight is eq. 21", &sampling_is_right},
      {"K8", p, "sec. 2", "the Ashikhmin-Shirley distribution is not strictly normalised",
       &ashikhmin_shirley_is_not_normalised},
      {"K9", p, "sec. 2", "Ward's and Duer's models are not physically plausible", &ward_and_duer_are_not_plausible},
  };
}

}  // namespace albedo::analysis
