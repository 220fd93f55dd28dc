#include <algorithm>
#include <random>

#include "albedo/combinators/pumped.hpp"
#include "analysis/claims/measure.hpp"
#include "analysis/claims/neumann_pumping.hpp"
#include "analysis/studies/pumping.hpp"

namespace albedo::analysis {
namespace {

constexpr std::array angles{0.0, 15.0, 30.0, 45.0, 60.0, 70.0, 80.0, 85.0, 87.0, 89.0, 89.9};
const std::string floor_of_all =
    "max(N.L, N.V) as a floor of the product of all divisors, in place of eq. 21 at every step";

constexpr PumpControl step = PumpControl::step, total = PumpControl::total;

double cosine(double theta) { return Direction::from_degrees(theta).cos_theta; }

// --- N6 ---

/// What one pumping does to the albedo at all angles.
struct Once {
  Worst above, darker;  ///< a* - 1 and a - a*, beyond the errors
};

Once pumped_once(const Model& model, bool only_up) {
  constexpr double tolerance = 1e-6;
  PumpSequence sequence(model, PumpControl::none, only_up, tolerance);
  sequence.advance();
  Once once;
  constexpr std::array grazing{89.99, 89.999, 89.999999};
  std::vector<double> all(angles.begin(), angles.end());
  all.insert(all.end(), grazing.begin(), grazing.end());
  for (const double theta : all) {
    const double before = sequence.albedo(0, cosine(theta)), after = sequence.albedo(1, cosine(theta));
    const double error = before * sequence.relative_bound(0) + after * sequence.relative_bound(1);
    once.above.look(after - 1 - error, degrees(theta));
    once.darker.look(before - after - error, degrees(theta));
  }
  return once;
}

Finding one_pumping_brightens_and_stays_below_one(const ModelSource& make) {
  std::vector<Case> cases;
  for (const double n : {1.0, 20.0, 1000.0}) cases.push_back({"phong n=" + show(n), make("phong", {{"n", n}})});
  cases.push_back({"blinn n=20", make("blinn", {{"n", 20.0}})});
  cases.push_back({"cook_torrance m=0.3", make("cook_torrance", {{"m", 0.3}})});
  cases.push_back({"ggx alpha=0.5", make("ggx", {{"alpha", 0.5}})});
  cases.push_back({"ward m=0.1", make("ward", {{"m", 0.1}})});
  cases.push_back({"ward m=0.3", make("ward", {{"m", 0.3}})});
  cases.push_back({"kurt eq. 9 m=3", make("kurt", {{"m", 3.0}, {"equation", "9"}})});
  Finding finding;
  std::vector<std::string> kept, broken;
  Worst above, darker;
  for (const auto& [label, model] : cases) {
    const Once free = pumped_once(*model, false), restricted = pumped_once(*model, true);
    above.look(restricted.above.value, label + " at " + restricted.above.where + " with g <= 1 forced");
    darker.look(free.darker.value, label + " at " + free.darker.where + " with g > 1 allowed");
    const bool holds = free.above.value <= 0 && free.darker.value <= 0 && restricted.above.value <= 0;
    (holds ? kept : broken).push_back(label);
    finding.quantities.push_back({"a* - 1, " + label, free.above.value, 0});
    finding.quantities.push_back({"a* - 1 with g <= 1 forced, " + label, restricted.above.value, 0});
    finding.quantities.push_back({"a - a*, " + label, free.darker.value, 0});
  }
  finding.verdict = broken.empty() ? ClaimVerdict::holds : kept.empty() ? ClaimVerdict::fails : ClaimVerdict::holds_if;
  finding.found = "a <= a* <= 1 for " + list_of(kept);
  if (broken.empty()) return finding;
  finding.found +=
      "; where f creates energy, g = max(a(L), a(V)) passes 1: allowed to, a* <= 1 but some V get darker; "
      "held at 1, a* stays above 1";
  finding.condition = "f itself preserves energy, so that g <= 1 by itself: not " + list_of(broken);
  finding.worst = "a* - 1 = " + show(above.value, 3) + " (" + above.where + "); a - a* = " + show(darker.value, 3) +
                  " (" + darker.where + ")";
  finding.repair = "allow g > 1: then a* <= 1 for every one of them";
  return finding;
}

// --- N7 ---

Finding pumping_goes_to_the_ideal_mirror(const ModelSource& make) {
  constexpr int often = 100;
  Finding finding;
  bool rises = true, converges = true;
  std::vector<std::string> parts;
  for (const char* name : {"phong", "blinn"}) {
    const auto model = make(name, {{"n", 20.0}});
    PumpSequence sequence(*model, PumpControl::none, false, 1e-7);
    Worst distance_10, distance;
    double at_80 = 0;
    for (int k = 1; k <= often; ++k) {
      sequence.advance();
      for (const double theta : angles) {
        const double before = sequence.albedo(k - 1, cosine(theta)), after = sequence.albedo(k, cosine(theta));
        const double error = sequence.relative_bound(k - 1) + sequence.relative_bound(k);
        rises = rises && after >= before - error;
        if (k == 10) distance_10.look(std::abs(1 - after), degrees(theta));
        if (k == often) distance.look(std::abs(1 - after), degrees(theta));
        if (k == often && theta == 80) at_80 = std::abs(1 - after);
      }
    }
    const double grazing = sequence.albedo(often, std::exp(-CosineTables::last_x));
    converges = converges && distance.value < distance_10.value / 2;
    finding.quantities.push_back(
        {std::string("1 - a after 100, up to 89.9 degrees, ") + name, distance.value, sequence.relative_bound(often)});
    finding.quantities.push_back({std::string("100 (1 - a) at 90 degrees, ") + name, often * (1 - grazing), 0});
    parts.push_back(std::string(name) + " is " + show(distance.value, 2) + " from 1 at " + distance.where + ", " +
                    show(at_80, 1) + " at 80 degrees and " + show(1 - grazing, 2) + " at 90");
  }
  finding.verdict = rises && converges ? ClaimVerdict::holds : ClaimVerdict::fails;
  finding.found = std::string(rises ? "every order raises every albedo" : "some order lowers an albedo") +
                  "; after 100 of them (n=20) " + list_of(parts) + "; at 90 degrees the distance goes like 1/k";
  return finding;
}

// --- N8, N9 ---

/// The largest output radiance after so many pumpings, in units of the mirror direction's at normal incidence.
double peak_of(const Model& model, PumpControl control, int times, int* first_above = nullptr) {
  const PumpStudy study = study_pumping(model, {.times = times, .control = control, .tolerance = 1e-6});
  const Direction normal = Direction::from_degrees(0);
  const double unit = brdf<double>(model, normal, normal);
  for (int k = 0; first_above != nullptr && k <= times; ++k) {
    if (study.orders[static_cast<std::size_t>(k)].radiance <= 1.001 * unit) continue;
    *first_above = k;
    break;
  }
  return study.orders.back().radiance / unit;
}

Finding pumping_makes_off_specular_peaks(const ModelSource& make) {
  constexpr int times = 5;
  Finding finding;
  std::vector<double> peaks;
  std::vector<std::string> parts;
  for (const char* name : {"phong", "blinn"}) {
    int first = -1;
    peaks.push_back(peak_of(*make(name, {{"n", 20.0}}), PumpControl::none, times, &first));
    finding.quantities.push_back({std::string("peak after 5, ") + name, peaks.back(), 0});
    parts.push_back(std::string(name) + " " + show(peaks.back(), 4) +
                    (first < 0 ? "" : ", above 1 from " + std::to_string(first) + " on"));
  }
  finding.verdict = peaks[0] > 1 && peaks[1] > peaks[0] ? ClaimVerdict::holds : ClaimVerdict::fails;
  finding.found =
      "largest f N.L in units of that of the mirror direction at normal incidence, n=20, 5 pumpings: " + list_of(parts);
  return finding;
}

Finding control_keeps_radiance(const ModelSource& make) {
  constexpr int times = 5;
  Finding finding;
  std::vector<std::string> parts, kept, broken;
  for (const auto& [control, name_of_control] : {std::pair{step, "every step (eq. 21)"}, {total, "all divisors"}}) {
    for (const char* name : {"phong", "blinn"}) {
      const double peak = peak_of(*make(name, {{"n", 20.0}}), control, times);
      finding.quantities.push_back({std::string(name) + ", floor of " + name_of_control, peak, 0});
      parts.push_back(std::string(name) + " " + show(peak, 4) + " with the floor of " + name_of_control);
      (peak <= 1.001 ? kept : broken).push_back(std::string(name) + " with the floor of " + name_of_control);
    }
  }
  const bool of_all = finding.quantities[2].value <= 1.001 && finding.quantities[3].value <= 1.001;
  finding.verdict = broken.empty() ? ClaimVerdict::holds : of_all ? ClaimVerdict::holds_if : ClaimVerdict::fails;
  finding.found =
      "largest f N.L in units of that of the mirror direction at normal incidence, n=20, 5 pumpings: " + list_of(parts);
  if (broken.empty()) return finding;
  finding.worst = list_of(broken);
  if (!of_all) return finding;
  finding.condition = "max(N.L, N.V) is a floor of the product of all divisors, not of each";
  finding.repair = floor_of_all;
  return finding;
}

// --- N10, N11 ---

/// After how many pumpings no angle up to that one gains 1 % any more.
int worth(const PumpSequence& sequence, double last_theta) {
  for (int k = 0; k + 1 < sequence.orders(); ++k) {
    bool gains = false;
    for (const double theta : angles) {
      if (theta > last_theta) continue;
      gains = gains || sequence.albedo(k + 1, cosine(theta)) > 1.01 * sequence.albedo(k, cosine(theta));
    }
    if (!gains) return k;
  }
  return sequence.orders() - 1;
}

Finding control_stops_below_one(const ModelSource& make) {
  constexpr int often = 12;
  Finding finding;
  std::vector<std::string> parts;
  bool below = true, stops = true, step_runs_on = false;
  std::vector<int> at_85, at_89;
  for (const char* name : {"phong", "blinn"}) {
    const auto model = make(name, {{"n", 20.0}});
    PumpSequence of_all(*model, total, false, 1e-7), of_each(*model, step, false, 1e-7);
    for (int k = 0; k < often; ++k) of_all.advance(), of_each.advance();
    const double last = of_all.average(often);
    below = below && last < 0.99;
    stops = stops && last - of_all.average(often - 1) < 1e-4;
    step_runs_on = step_runs_on || of_each.average(often) > 0.99;
    at_85.push_back(worth(of_all, 85)), at_89.push_back(worth(of_all, 89));
    finding.quantities.push_back(
        {std::string("average albedo, floor of all divisors, ") + name, last, of_all.relative_bound(often)});
    finding.quantities.push_back({std::string("average albedo, floor of every step, ") + name, of_each.average(often),
                                  of_each.relative_bound(often)});
    finding.quantities.push_back({std::string("worth up to 85 degrees, ") + name, double(at_85.back()), 0});
    finding.quantities.push_back({std::string("worth up to 89 degrees, ") + name, double(at_89.back()), 0});
    parts.push_back(std::string(name) + " ends at an average albedo of " + show(last, 5) + " and is worth " +
                    std::to_string(at_85.back()) + " (up to 85 degrees) or " + std::to_string(at_89.back()) +
                    " (up to 89); with the floor of every step it is at " + show(of_each.average(often), 5) +
                    " after 12");
  }
  const bool as_said = at_85[0] >= 2 && at_89[0] <= 3 && at_85[1] == 1 && at_89[1] == 1;
  finding.found = "worth: until no angle gains 1 % (n=20). With the floor of all divisors " + list_of(parts);
  finding.verdict = !below || !stops || !as_said ? ClaimVerdict::fails
                    : step_runs_on               ? ClaimVerdict::holds_if
                                                 : ClaimVerdict::holds;
  if (finding.verdict != ClaimVerdict::holds_if) return finding;
  finding.condition = "max(N.L, N.V) is a floor of the product of all divisors; as a floor of each it goes to 1";
  finding.repair = floor_of_all;
  return finding;
}

/// The largest relative difference of two models, L and V up to 87 degrees.
double difference(const Model& a, const Model& b) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit;
  double most = 0;
  for (int i = 0; i < 400; ++i) {
    const Direction l = Direction::from_degrees(87 * unit(random));
    const Direction v = Direction::from_degrees(87 * unit(random), 90 + 180 * unit(random));
    const double f = brdf<double>(b, l, v);
    if (f > 0) most = std::max(most, std::abs(brdf<double>(a, l, v) / f - 1));
  }
  return most;
}

Finding control_ends_at_eq_22(const ModelSource& make) {
  constexpr int often = 12;
  constexpr double same = 1e-5;
  Finding finding;
  std::vector<std::string> ends_there, elsewhere;
  Worst of_all, of_each;
  for (const double n : {1.0, 2.0, 20.0, 200.0}) {
    const auto limit = make("neumann_phong", {{"n", n}});
    const auto pumped = [&](PumpControl control) {
      return PumpedModel(make("phong", {{"n", n}}), {.times = often, .control = control, .tolerance = 1e-7});
    };
    const double off = difference(pumped(total), *limit);
    (off <= same ? ends_there : elsewhere).push_back("n=" + show(n));
    if (off <= same) of_all.look(off, "n=" + show(n));
    of_each.look(difference(pumped(step), *limit), "n=" + show(n));
    finding.quantities.push_back({"difference, floor of all divisors, n=" + show(n), off, 0});
  }
  finding.quantities.push_back({"difference, floor of every step", of_each.value, 0});
  finding.verdict = ends_there.empty()                           ? ClaimVerdict::fails
                    : elsewhere.empty() && of_each.value <= same ? ClaimVerdict::holds
                                                                 : ClaimVerdict::holds_if;
  finding.found =
      "after 12 pumpings with the floor of all divisors, up to 87 degrees, f differs from eq. 22 by at most " +
      show(of_all.value, 2) + " (" + list_of(ends_there) + "); with the floor of every step by a factor of " +
      show(1 + of_each.value, 3);
  if (finding.verdict != ClaimVerdict::holds_if) return finding;
  finding.condition = "max(N.L, N.V) is a floor of the product of all divisors, not of each";
  finding.repair = floor_of_all;
  if (elsewhere.empty()) return finding;
  finding.condition += "; " + list_of(ends_there) + ", not " + list_of(elsewhere);
  finding.worst =
      "for " + list_of(elsewhere) +
      " eq. 22 reflects more than it gets near normal incidence (N12), and what is pumped is darker by that";
  return finding;
}

}  // namespace

std::vector<Claim> pumping_claims() {
  constexpr Paper paper = Paper::neumann;
  return {
      {"N6", paper, "eqs. 18, 19",
       "pumping once gives a <= a* <= 1 for every L, for any symmetric function f, energy-preserving or not, as long "
       "as g <= 1",
       one_pumping_brightens_and_stays_below_one},
      {"N7", paper, "sec. 3.1, figs. 3, 4",
       "recursive pumping with g1 increases monotonically and converges to the ideal mirror, a = 1",
       pumping_goes_to_the_ideal_mirror},
      {"N8", paper, "sec. 3.1",
       "after several pumpings with g1 the output radiance f N.L exceeds the irradiance (off-specular peak), more for "
       "Blinn than for Phong",
       pumping_makes_off_specular_peaks},
      {"N9", paper, "sec. 5", "controlled pumping keeps the output radiance below the input radiance",
       control_keeps_radiance},
      {"N10", paper, "sec. 3.2",
       "repeated controlled pumping converges to an albedo below 1; for n=20 Phong is worth 2 or 3 repetitions, Blinn "
       "one",
       control_stops_below_one},
      {"N11", paper, "eq. 22", "repeated controlled pumping of Phong ends at c_n (R.V)^n/max(N.L, N.V)",
       control_ends_at_eq_22},
  };
}

}  // namespace albedo::analysis
