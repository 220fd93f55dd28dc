#include <algorithm>

#include "albedo/reference.hpp"
#include "analysis/claims/measure.hpp"
#include "analysis/claims/neumann_pumping.hpp"
#include "analysis/claims/variants.hpp"

namespace albedo::analysis {
namespace {

std::vector<Case> cook_torrance(const ModelSource& make, const std::string& masking) {
  std::vector<Case> cases;
  for (const double m : {0.05, 0.1, 0.2, 0.5, 1.0}) {
    cases.push_back({"m=" + show(m), make("cook_torrance", {{"m", m}, {"masking", masking}})});
  }
  return cases;
}

std::string exponents_text(const GrazingLaws& laws, const std::vector<Case>& cases) {
  const PowerLaw& fit = laws.all[laws.worst].fit;
  return with_error(fit.exponent, fit.exponent_error, 6) + " (" + cases[laws.worst].label + ")";
}

std::vector<Quantity> exponents(const GrazingLaws& laws, const std::vector<Case>& cases) {
  std::vector<Quantity> all;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& [limit, fit] = laws.all[i];
    all.push_back({"exponent " + cases[i].label, fit.exponent, fit.exponent_error});
    all.push_back({"constant " + cases[i].label, limit.constant, limit.constant_error});
  }
  return all;
}

ClaimVerdict verdict_of(const GrazingLaws& laws) {
  if (laws.unknown) return ClaimVerdict::undecided;
  return laws.others.empty()     ? ClaimVerdict::holds
         : laws.agreeing.empty() ? ClaimVerdict::fails
                                 : ClaimVerdict::holds_if;
}

// --- N1 ---

double asymmetry_of(const Model& model) { return audit(model).reciprocity.asymmetry; }

Finding first_versions_are_not_reciprocal(const ModelSource& make) {
  constexpr double same = 1e-12;
  Finding finding;
  bool first_differ = true, later_same = true;
  std::vector<std::string> parts;
  for (const char* name : {"phong_original", "blinn_original", "phong", "blinn"}) {
    const double asymmetry = asymmetry_of(*make(name, {{"n", 20.0}}));
    finding.quantities.push_back({"asymmetry " + std::string(name), asymmetry, 0});
    parts.push_back(std::string(name) + " " + show(asymmetry, 3));
    const bool is_first = std::string(name).ends_with("original");
    if (is_first) first_differ = first_differ && asymmetry > same;
    if (!is_first) later_same = later_same && asymmetry <= same;
  }
  finding.verdict = first_differ && later_same ? ClaimVerdict::holds : ClaimVerdict::fails;
  finding.found = "largest |f(L,V) - f(V,L)| in parts of the larger one (n=20, 113 bits): " + list_of(parts);
  return finding;
}

// --- N2 ---

/// The p of a = cos^p theta, and how far it is from one number over angles to 85 degrees.
Quantity cosine_power(const Model& model) {
  double least = 1e9, most = -1e9;
  for (int theta = 15; theta <= 85; theta += 10) {
    const double power = std::log(albedo_at(model, theta).value) / std::log(Direction::from_degrees(theta).cos_theta);
    least = std::min(least, power), most = std::max(most, power);
  }
  return {"", (least + most) / 2, (most - least) / 2};
}

Finding albedo_follows_the_cosine(const ModelSource& make) {
  constexpr double largest_exponent = 1e8;
  Finding finding;
  std::vector<std::string> agreeing, parts;
  bool settled = true;
  for (const char* name : {"phong", "blinn"}) {
    const Quantity before = cosine_power(*make(name, {{"n", largest_exponent / 100}}));
    Quantity power = cosine_power(*make(name, {{"n", largest_exponent}}));
    const double change = std::abs(power.value - before.value);
    settled = settled && change < 1e-2;
    power.name = "power " + std::string(name);
    parts.push_back(std::string(name) + " cos^p with p = " + with_error(power.value, power.error, 6));
    if (std::abs(power.value - 1) < power.error + change + 1e-4) agreeing.emplace_back(name);
    finding.quantities.push_back(power);
  }
  finding.verdict = !settled               ? ClaimVerdict::undecided
                    : agreeing.size() == 2 ? ClaimVerdict::holds
                    : agreeing.empty()     ? ClaimVerdict::fails
                                           : ClaimVerdict::holds_if;
  finding.found = "at n = 1e8, 15 ... 85 degrees, the albedo is " + list_of(parts);
  if (agreeing.size() == 2) return finding;
  if (!agreeing.empty()) finding.condition = "the model is " + list_of(agreeing);
  const Quantity repaired = cosine_power(*make_model<BlinnOverCosine>({{"n", largest_exponent}}));
  finding.repair = "c (N.H)^n/(L.H) in place of c (N.H)^n: p = " + with_error(repaired.value, repaired.error, 6);
  return finding;
}

// --- N3, N4 ---

Finding ward_diverges(const ModelSource& make) {
  std::vector<Case> cases;
  for (const double m : {0.05, 0.1, 0.2, 0.5, 1.0}) cases.push_back({"m=" + show(m), make("ward", {{"m", m}})});
  cases.push_back({"alpha=0.1,0.5", make("ward", {{"alpha_x", 0.1}, {"alpha_y", 0.5}})});
  const GrazingLaws laws = grazing_laws(cases, 0.5);
  const Crossing crossing = critical_angle(*cases[1].model);
  Finding finding{.verdict = verdict_of(laws), .quantities = exponents(laws, cases)};
  finding.found = "a ~ C (N.L)^-p, the p furthest from 1/2 is " + exponents_text(laws, cases);
  if (crossing.exists) {
    const double theta = Direction::from_cosine(crossing.cos_theta).theta_degrees();
    finding.found += "; m=0.1 passes 1 at " + degrees(theta);
  }
  if (finding.verdict == ClaimVerdict::holds_if) finding.condition = list_of(laws.agreeing);
  return finding;
}

Finding cook_torrance_diverges(const ModelSource& make) {
  const std::vector<Case> with = cook_torrance(make, "v_cavity"), without = cook_torrance(make, "none");
  const GrazingLaws laws = grazing_laws(with, 1);
  const Energies energies = energies_of(with);
  Finding finding{.verdict = verdict_of(laws), .quantities = exponents(laws, with)};
  finding.found = "a ~ C (N.L)^-p with G: p = " + exponents_text(laws, with);
  if (finding.verdict == ClaimVerdict::holds) return finding;
  const PowerLaw& limit = laws.all[laws.worst].limit;
  if (limit.status == Status::converged)
    finding.found += ", the limit is " + with_error(limit.constant, limit.constant_error);
  finding.worst = "largest albedo with G " + largest_text(energies, with);
  if (finding.verdict == ClaimVerdict::holds_if) finding.condition = list_of(laws.agreeing);
  const GrazingLaws repaired = grazing_laws(without, 1);
  if (verdict_of(repaired) == ClaimVerdict::holds) {
    finding.repair = "without G (G = 1) it diverges as claimed, p = " + exponents_text(repaired, without) +
                     "; with G near grazing incidence G ~ N.L, which eq. 12 leaves out";
  }
  return finding;
}

// --- N5, N13: how much of the normal albedo is left ---

Finding albedos_decrease_badly(const ModelSource& make) {
  std::vector<Case> cases;
  cases.push_back({"phong n=150", make("phong", {{"n", 150.0}})});
  cases.push_back(
      {"he_torrance, directional diffuse part",
       make("he_torrance", {{"sigma0", 0.1}, {"tau", 1.7}, {"wavelength", 0.5}, {"part", "directional_diffuse"}})});
  cases.push_back({"he_torrance, total", make("he_torrance", {{"sigma0", 0.1}, {"tau", 1.7}, {"wavelength", 0.5}})});
  cases.push_back({"ward m=0.1", make("ward", {{"m", 0.1}})});
  Finding finding;
  std::vector<std::string> parts, bad;
  for (const Case& one : cases) {
    const Decrease decrease = decrease_of(*one.model);
    finding.quantities.push_back({"least part " + one.label, decrease.least, 0});
    finding.quantities.push_back({"half lost (degrees) " + one.label, decrease.half_lost, 0});
    if (decrease.least < 0.5) bad.push_back(one.label);
    parts.push_back(one.label + " " + show(decrease.least, 3) + " at " + show(decrease.theta, 5) +
                    (decrease.least < 0.5 ? " (half lost at " + show(decrease.half_lost, 4) + ")" : ""));
  }
  finding.verdict = bad.size() == cases.size() ? ClaimVerdict::holds
                    : bad.empty()              ? ClaimVerdict::fails
                                               : ClaimVerdict::holds_if;
  if (finding.verdict == ClaimVerdict::holds_if) finding.condition = list_of(bad);
  finding.found = "\"badly\" read as: less than half of a(0) is left somewhere. Least a/a(0) up to 89.999 degrees: " +
                  list_of(parts);
  return finding;
}

Finding half_vector_family(const ModelSource& make) {
  std::vector<Case> cases;
  const auto add = [&](const std::string& label, const std::string& name, const Parameters& parameters) {
    cases.push_back({label, make(name, parameters)});
  };
  add("blinn n=20", "blinn", {{"n", 20.0}});
  add("blinn n=1000", "blinn", {{"n", 1000.0}});
  add("ward m=0.1", "ward", {{"m", 0.1}});
  add("cook_torrance m=0.1 without G", "cook_torrance", {{"m", 0.1}, {"masking", "none"}});
  add("cook_torrance m=0.1 with G", "cook_torrance", {{"m", 0.1}});
  add("ashikhmin_shirley n=1000", "ashikhmin_shirley", {{"n", 1000.0}});
  add("kurt eq. 9 m=0.1", "kurt", {{"m", 0.1}, {"equation", "9"}});
  add("ggx alpha=0.1", "ggx", {{"alpha", 0.1}});
  add("beckmann alpha=0.1", "beckmann", {{"alpha", 0.1}});
  add("ward_bounded alpha=0.1", "ward_bounded", {{"alpha", 0.1}});
  Finding finding;
  std::vector<std::string> diverging, decreasing, neither, agreeing;
  Worst best;
  for (const Case& one : cases) {
    const Grazing grazing = grazing_behaviour(*one.model);
    const Decrease decrease = decrease_of(*one.model);
    const double at_grazing = grazing.fit.exponent < 1e-3 ? grazing.fit.constant / albedo_at(*one.model, 0).value : 0;
    const double left = std::min(decrease.least, grazing.fit.exponent < 1e-3 ? at_grazing : 1);
    if (grazing.fit.exponent > 1e-3 || left < 0.5 - 1e-3) agreeing.push_back(one.label);
    if (grazing.fit.exponent > 1e-3) {
      diverging.push_back(one.label);
    } else if (left < 0.5 - 1e-3) {
      decreasing.push_back(one.label + " (" + show(left, 3) + ")");
    } else {
      neither.push_back(one.label + " (" + show(left, 3) + ")");
      best.look(left, one.label);
    }
    finding.quantities.push_back({"exponent " + one.label, grazing.fit.exponent, grazing.fit.exponent_error});
    finding.quantities.push_back({"least part " + one.label, left, 0});
  }
  finding.verdict = neither.empty() ? ClaimVerdict::holds : ClaimVerdict::fails;
  finding.found = "diverge: " + list_of(diverging) +
                  ". Keep less than half of a(0) (least part): " + list_of(decreasing) +
                  ". Neither: " + list_of(neither);
  if (neither.empty()) return finding;
  finding.worst = best.where + " keeps " + show(best.value, 6) + " of a(0) at every angle, and never diverges";
  finding.repair = "say it of single models: " + list_of(agreeing);
  return finding;
}

// --- N12 ---

Finding metallic_phong_preserves_energy(const ModelSource& make) {
  std::vector<Case> cases;
  Finding finding;
  double least_normal = 1e9;
  for (const double n : {0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 150.0, 1000.0, 1e5}) {
    cases.push_back({"n=" + show(n), make("neumann_phong", {{"n", n}})});
    least_normal = std::min(least_normal, albedo_at(*cases.back().model, 0).value);
  }
  const Energies energies = energies_of(cases);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    finding.quantities.push_back(quantity("largest albedo " + cases[i].label, energies.all[i].largest));
  }
  finding.verdict = energies.conserved();
  finding.found = "\"only if\": a(0) = " + show(least_normal, 10) +
                  " at least with c_n = (n+2)/2pi. \"If\": largest albedo " + largest_text(energies, cases);
  if (least_normal < 1 - 1e-9) {
    finding.verdict = ClaimVerdict::fails;
    finding.worst = "a(0) = " + show(least_normal, 6) + ": a larger c_n preserves energy there, too";
    finding.repair = "c_n <= (n+2)/2pi/max a";
    return finding;
  }
  if (energies.above.empty()) return finding;

  // Near normal incidence a = 1 + A theta^p - B theta^q, where p depends on n: for which n is p = q?
  const auto power = [&](double n) {
    constexpr double small = 1e-4;
    const auto model = make("neumann_phong", {{"n", n}});
    const auto change = [&](double theta) {
      const Direction l{.cos_theta = std::cos(theta), .sin_theta = std::sin(theta)};
      return abs(Quad(reference_albedo(*model, l).value - 1));
    };
    const double found = std::log2(static_cast<double>(change(2 * small) / change(small)));
    finding.quantities.push_back({"power of theta in a - 1, n=" + show(n), found, 10 * small});
    return found;
  };
  const double gain_0 = power(0), gain_1 = power(1), loss = power(6);
  const double least_n = (loss - gain_0) / (gain_1 - gain_0);
  finding.condition = "n >= " + show(least_n, 3) + ": near normal incidence what is gained goes like theta^" +
                      show(gain_0, 3) + " for n=0, theta^" + show(gain_1, 3) + " for n=1, what is lost like theta^" +
                      show(loss, 3) + " (n=6)";
  finding.worst = largest_text(energies, cases) + "; passes 1 for " + list_of(energies.above);
  const double largest = energies.all[energies.worst].largest.value;
  finding.repair = "c_n <= (n+2)/2pi/max a: " + show(1 / largest, 6) + " (n+2)/2pi for " + cases[energies.worst].label;
  return finding;
}

}  // namespace

std::vector<Claim> neumann_claims() {
  constexpr Paper p = Paper::neumann;
  std::vector<Claim> claims{
      {"N1", p, "eqs. 5, 6", "Phong and Blinn as first published are not reciprocal; without the division they are",
       &first_versions_are_not_reciprocal},
      {"N2", p, "sec. 1.2", "as n goes to infinity the albedo of reciprocal Phong and Blinn follows the cosine",
       &albedo_follows_the_cosine},
      {"N3", p, "sec. 2.1, eq. 14", "Ward's albedo diverges at grazing angles, like (N.L)^-1/2", &ward_diverges},
      {"N4", p, "sec. 2.1, eqs. 12, 15",
       "Cook-Torrance's albedo, with the factor G of eq. 10, diverges at grazing angles, like (N.L)^-1",
       &cook_torrance_diverges},
      {"N5", p, "fig. 1",
       "Phong (n=150) and He-Torrance (sigma0=0.1, tau=1.7) decrease badly for large incidence, and so does Ward "
       "(m=0.1) before it diverges",
       &albedos_decrease_badly},
      {"N12", p, "below eq. 22", "eq. 22 preserves energy if and only if c_n <= (n+2)/2pi, for every n",
       &metallic_phong_preserves_energy},
      {"N13", p, "sec. 5", "the N.H family either decreases badly or diverges: it isn't suited for metals",
       &half_vector_family},
  };
  const std::vector<Claim> of_pumping = pumping_claims();
  claims.insert(claims.begin() + 5, of_pumping.begin(), of_pumping.end());
  return claims;
}

}  // namespace albedo::analysis
