#include <algorithm>
#include <random>

#include "albedo/microfacet/sampling.hpp"
#include "analysis/claims/measure.hpp"
#include "analysis/claims/variants.hpp"
#include "analysis/claims/walter_bounds.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

double uniform(std::mt19937_64& engine) { return static_cast<double>(engine() >> 11) * 0x1p-53; }

std::unique_ptr<Model> anisotropic(const ModelSource& make) {
  return make("ward", {{"alpha_x", 0.1}, {"alpha_y", 0.4}});
}

/// Component of a model's parameters by name.
double parameter(const Model& model, const std::string& name) {
  for (const auto& [key, value] : model.parameters()) {
    if (key == name) return std::get<double>(value);
  }
  return 0;
}

// --- W1 ---

/// Eq. 3, from the half vector's angles.
Quad equation_3(const Model& model, const Direction& l, const Direction& v) {
  const auto i = unit_vector<Quad>(l), o = unit_vector<Quad>(v);
  const Quad x = i.x + o.x, y = i.y + o.y, z = i.z + o.z;
  const Quad theta = acos(Quad(z / sqrt(Quad(x * x + y * y + z * z)))), phi = atan2(y, x);
  const Quad a_x = parameter(model, "alpha_x"), a_y = parameter(model, "alpha_y");
  const Quad tangent = tan(theta), c = cos(phi) / a_x, s = sin(phi) / a_y;
  const Quad exponent = -tangent * tangent * (c * c + s * s);
  return parameter(model, "rho_s") / (4 * pi<Quad> * a_x * a_y * sqrt(Quad(i.z * o.z))) * exp(exponent);
}

Finding two_forms_are_the_same(const ModelSource& make) {
  const auto model = anisotropic(make);
  std::mt19937_64 engine(1);
  Worst worst;
  constexpr int pairs = 400;
  for (int i = 0; i < pairs; ++i) {
    const Direction l = Direction::from_cosine(uniform(engine), 360 * uniform(engine));
    // the lobe's own half vectors: elsewhere both are 0 to all digits
    const auto drawn = model->sample(0, unit_vector<double>(l), uniform(engine), uniform(engine));
    const UnitVector<double> to = drawn.viewer();
    if (!(to.z > 0)) continue;
    const double sine = std::hypot(to.x, to.y);
    const Direction v{to.z, sine, to.x / sine, to.y / sine};
    const Quad other = equation_3(*model, l, v);
    worst.look(std::abs(static_cast<double>(brdf<Quad>(*model, l, v) / other - 1)), "");
  }
  Finding finding{.quantities = {{"largest relative difference", worst.value, 0}}};
  finding.verdict = worst.value < 1e-25 ? ClaimVerdict::holds : ClaimVerdict::fails;
  finding.found = "largest relative difference of eq. 3 (angles) from eq. 4 (vectors) over " + std::to_string(pairs) +
                  " pairs in 113 bits: " + show(worst.value, 2) + " (alpha = 0.1, 0.4)";
  return finding;
}

// --- W2 ---

Finding density_is_right(const ModelSource& make) {
  std::vector<Case> cases;
  cases.push_back({"alpha=0.15", make("ward", {{"alpha", 0.15}})});
  cases.push_back({"alpha=0.1,0.4", anisotropic(make)});
  cases.push_back({"alpha=0.5", make("ward", {{"alpha", 0.5}})});
  const Model& model = *cases[1].model;
  const double a_x = parameter(model, "alpha_x"), a_y = parameter(model, "alpha_y");
  const auto map = [&](double u, double v) {  // eqs. 6, 7, the quadrant kept
    const double phi = std::atan2(a_y * std::sin(2 * pi<double> * v), a_x * std::cos(2 * pi<double> * v));
    const double scaled = square(std::cos(phi) / a_x) + square(std::sin(phi) / a_y);
    return std::pair{std::atan(std::sqrt(-std::log(u) / scaled)), phi};
  };
  Worst worst;
  for (const double u : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    for (const double v : {0.05, 0.15, 0.3, 0.45, 0.6, 0.85}) {
      const auto [theta, phi] = map(u, v);
      const double said = half_vector_density(model, Direction::from_degrees(30, 20), theta, phi);
      worst.look(std::abs(density_of_map(map, u, v) / said - 1), "");
    }
  }
  const SamplerSummary samplers = samplers_of(cases);
  // Eq. 9 has h.i, not its magnitude: facets that face away count negative.
  constexpr double theta = 85;
  const Estimate away = facing_away(*cases[2].model, theta);
  Finding finding{.quantities = {{"density off", worst.value, 0},
                                 {"integral off 1 with |h.i|", samplers.integral_off, 0},
                                 {"least p of chi-squared", samplers.least_p, 0},
                                 {"integral of eq. 9 with the sign of h.i, alpha=0.5, 85 degrees", 1 - 2 * away.value,
                                  2 * away.error}}};
  const bool right = worst.value < 1e-6 && samplers.pass;
  const bool sign_matters = away.value > away.error + 1e-9;
  finding.verdict = !right ? ClaimVerdict::fails : sign_matters ? ClaimVerdict::holds_if : ClaimVerdict::holds;
  finding.found = "p_o is the density of eqs. 6-8 within " + show(worst.value, 1) +
                  "; with |h.i| it integrates to 1 "
                  "within " +
                  show(samplers.integral_off, 1) + "; chi-squared of directions drawn: least p " +
                  show(samplers.least_p, 2) + " of " + std::to_string(samplers.tests);
  if (!sign_matters) return finding;
  finding.condition = "h.i is read as |h.i|";
  finding.worst = "at 85 degrees, alpha=0.5, " + with_error(100 * away.value, 100 * away.error, 4) +
                  " % of the half vectors face away from i (h.i < 0, o far below the horizon): with the sign eq. 9 "
                  "integrates to " +
                  show(1 - 2 * away.value, 5);
  finding.repair = "|h.i| in eq. 9; the weights of what is above the horizon are the same";
  return finding;
}

// --- W3 ---

Finding weight_is_right(const ModelSource& make) {
  const auto model = anisotropic(make);
  std::mt19937_64 engine(2);
  Worst worst;
  constexpr int draws = 400;
  int above = 0;
  for (int i = 0; i < draws; ++i) {
    const auto l = unit_vector<Quad>(Direction::from_cosine(uniform(engine), 360 * uniform(engine)));
    const auto drawn = model->quad().sample(0, l, Quad(uniform(engine)), Quad(uniform(engine)));
    const DirectionPair<Quad>& d = drawn.pair;
    if (!(d.cos_theta_v > 0)) continue;
    ++above;
    const Quad weight = model->quad().evaluate(0, d) * d.cos_theta_v / drawn.density;
    const Quad claimed = parameter(*model, "rho_s") * d.cos_theta_d * d.cos_theta_h * d.cos_theta_h * d.cos_theta_h *
                         sqrt(Quad(d.cos_theta_v / d.cos_theta_l));
    worst.look(std::abs(static_cast<double>(weight / claimed - 1)), "");
  }
  Finding finding{.quantities = {{"largest relative difference", worst.value, 0}}};
  finding.verdict = worst.value < 1e-25 ? ClaimVerdict::holds : ClaimVerdict::fails;
  finding.found = "largest relative difference of f cos/p_o from eq. 10 over " + std::to_string(above) +
                  " directions drawn, in 113 bits: " + show(worst.value, 2);
  return finding;
}

// --- W4 ---

Finding equal_weights(const ModelSource& make) {
  constexpr double tolerable = 0.1;
  Finding finding;
  double earliest = 90, widest = 0;
  std::vector<std::string> parts, chart;
  Worst worst;
  for (const double alpha : {0.05, 0.1, 0.15, 0.2, 0.3, 0.5}) {
    const auto ward = make("ward", {{"alpha", alpha}});
    const auto equal = make_model<EqualWeights>({{"alpha", alpha}});
    const auto excess = [&](double theta) {
      return albedo_at(*equal, theta).value / albedo_at(*ward, theta).value - 1;
    };
    std::vector<std::string> row;
    for (const double theta : {0.0, 30.0, 60.0, 80.0, 89.0}) {
      const double off = excess(theta);
      const std::string label = "alpha=" + show(alpha) + ", " + degrees(theta);
      finding.quantities.push_back({"equal weights too bright by, " + label, off, 1e-8});
      if (theta < 89) worst.look(std::abs(off), label);
      if (theta > 0 && theta < 89) row.push_back(show(100 * off, 3));
    }
    chart.push_back(show(alpha) + ": " + joined(row, "/"));
    if (std::abs(excess(0)) > tolerable) continue;
    widest = std::max(widest, alpha);
    earliest = std::min(earliest, threshold([&](double theta) { return excess(theta) > tolerable; }, 0, 60));
  }
  const bool near_normal_only = earliest < 45;
  finding.verdict = widest == 0 ? ClaimVerdict::fails : near_normal_only ? ClaimVerdict::holds_if : ClaimVerdict::holds;
  finding.found = "what equal weights give is too bright by, in % at 30/60/80 degrees, for alpha = " + list_of(chart);
  finding.condition = "\"nearly\" is 10 %: alpha <= " + show(widest) +
                      " and theta <= " + degrees(std::floor(10 * earliest) / 10) +
                      "; narrow lobes need the weight too, it is cos theta_i at their centre";
  finding.worst = show(100 * worst.value, 3) + " % at " + worst.where + " (below 89 degrees)";
  finding.repair = "the weights of eq. 10";
  return finding;
}

}  // namespace

std::vector<Claim> walter_claims() {
  constexpr Paper p = Paper::walter;
  return {
      {"W1", p, "eqs. 3, 4", "eqs. 3 and 4 are the same function", &two_forms_are_the_same},
      {"W2", p, "eq. 9",
       "p_o of eq. 9 is the density of eqs. 6-8 and integrates to 1 (what is below the horizon included)",
       &density_is_right},
      {"W3", p, "eq. 10", "the weight is rho_s (h.i)(h.n)^3 sqrt(o.n/i.n)", &weight_is_right},
      {"W4", p, "fig. 3", "equal weights are often nearly true, but wrong for wide lobes and near grazing",
       &equal_weights},
      {"W5", p, "sec. 4", "eq. 27 bounds cos theta_o; eqs. 28-33 bound f cos theta_o over a box of directions",
       &bounds_as_printed},
  };
}

}  // namespace albedo::analysis
