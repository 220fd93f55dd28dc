#include "analysis/claims/claims.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "albedo/core/number.hpp"
#include "albedo/curve.hpp"
#include "analysis/claims/claims_report.hpp"
#include "analysis/claims/measure.hpp"
#include "analysis/claims/variants.hpp"

namespace albedo::analysis {
namespace {

Claim claim(const std::string& id) {
  const std::vector<Claim> all = claims_of({});
  const auto found = std::ranges::find(all, id, &Claim::id);
  EXPECT_NE(found, all.end()) << id;
  return *found;
}

Finding check(const std::string& id, const ModelSource& make = library_model) { return claim(id).check(make); }

double value_of(const Finding& finding, const std::string& name) {
  const auto found = std::ranges::find(finding.quantities, name, &Quantity::name);
  if (found == finding.quantities.end()) ADD_FAILURE() << "no quantity " << name;
  return found == finding.quantities.end() ? std::nan("") : found->value;
}

/// Every `name` is made as a `other`, with the same parameters and these.
ModelSource with_other(const std::string& name, const std::string& other, const Parameters& more = {}) {
  return [=](std::string_view asked, const Parameters& parameters) {
    if (asked != name) return make_model(asked, parameters);
    Parameters all = parameters;
    for (const auto& one : more) {
      std::erase_if(all, [&](const auto& given) { return given.first == one.first; });
      all.push_back(one);
    }
    return make_model(other, all);
  };
}

// --- numbers, against closed forms that the library doesn't use ---

TEST(ClaimNumbers, CentreOfTheFurnaceSphere) {
  const Finding finding = check("A3");
  constexpr double n = 10;
  EXPECT_NEAR(value_of(finding, "albedo at normal incidence"), (n - 1 + std::exp2((1 - n) / 2)) / (n + 3), 1e-10);
  EXPECT_EQ(finding.verdict, ClaimVerdict::fails);
}

TEST(ClaimNumbers, MetallicPhongWithoutAnExponent) {
  const Finding finding = check("N12");
  EXPECT_NEAR(value_of(finding, "largest albedo n=0"), 2.5 - std::sqrt(2.0), 1e-8);  // at 45 degrees
  EXPECT_NEAR(value_of(finding, "largest albedo n=2"), 1, 1e-8);
  EXPECT_NEAR(value_of(finding, "power of theta in a - 1, n=1"), 3, 2e-3);
  EXPECT_EQ(finding.verdict, ClaimVerdict::holds_if);
  EXPECT_EQ(finding.condition.substr(0, 7), "n >= 2:") << finding.condition;
  const ModelSource larger_exponent = [](std::string_view name, Parameters parameters) {
    for (auto& [key, value] : parameters) value = std::get<double>(value) + 2;
    return make_model(name, parameters);
  };
  EXPECT_EQ(check("N12", larger_exponent).verdict, ClaimVerdict::holds);
  // its a(0) is below 1: "only if" isn't so
  EXPECT_EQ(check("N12", with_other("neumann_phong", "ashikhmin_shirley")).verdict, ClaimVerdict::fails);
}

TEST(ClaimNumbers, Pumping) {
  const Finding once = check("N6");
  EXPECT_EQ(once.verdict, ClaimVerdict::holds_if);
  EXPECT_EQ(once.condition.find("phong"), std::string::npos) << once.condition;
  EXPECT_NE(once.condition.find("ward m=0.1"), std::string::npos) << once.condition;

  // 1 - a goes like 1/k at grazing incidence, slower for Blinn
  const Finding recursive = check("N7");
  EXPECT_EQ(recursive.verdict, ClaimVerdict::holds);
  EXPECT_NEAR(value_of(recursive, "100 (1 - a) at 90 degrees, phong"), 1, 0.05);
  EXPECT_GT(value_of(recursive, "100 (1 - a) at 90 degrees, blinn"), 5);

  const Finding controlled = check("N9");
  EXPECT_EQ(controlled.verdict, ClaimVerdict::holds_if);
  EXPECT_NEAR(value_of(controlled, "phong, floor of all divisors"), 1, 1e-6);
  EXPECT_GT(value_of(controlled, "blinn, floor of every step (eq. 21)"), 10);

  const Finding repeated = check("N10");
  EXPECT_EQ(repeated.verdict, ClaimVerdict::holds_if);
  const AlbedoCurve eq_22(*make_model("neumann_phong", {{"n", 20.0}}));  // where it ends
  EXPECT_NEAR(value_of(repeated, "average albedo, floor of all divisors, phong"), eq_22.average(), 1e-6);
  EXPECT_EQ(value_of(repeated, "worth up to 85 degrees, phong"), 2);
  EXPECT_EQ(value_of(repeated, "worth up to 89 degrees, phong"), 3);
}

// With another model in the place of one that the claim is about, the verdict is another.
TEST(ClaimNumbers, VerdictsOfPumpingFollowTheModels) {
  EXPECT_EQ(check("N8").verdict, ClaimVerdict::holds);
  EXPECT_EQ(check("N8", with_other("blinn", "phong")).verdict, ClaimVerdict::fails);  // no more than Phong's
  EXPECT_EQ(check("N11").verdict, ClaimVerdict::holds_if);
  EXPECT_EQ(check("N11", with_other("neumann_phong", "phong")).verdict, ClaimVerdict::fails);
}

TEST(ClaimNumbers, RoughnessAtWhichEquation9CreatesEnergy) {
  // at grazing incidence half of the integral of D: (1 + sqrt(pi)/2 m exp(1/m^2) erfc(1/m))/2
  const auto excess = [](double m) {
    return std::sqrt(pi<double>) / 2 * m * std::exp(1 / (m * m)) * std::erfc(1 / m) - 1;
  };
  const double m = threshold([&](double x) { return excess(x) > 0; }, 1, 3);
  const Finding finding = check("K3");
  EXPECT_NEAR(value_of(finding, "m at which it passes 1"), m, 1e-5);
  EXPECT_NEAR(value_of(finding, "largest albedo m=20"), 1 + excess(20) / 2, 1e-6);
  EXPECT_EQ(finding.verdict, ClaimVerdict::holds_if);
}

TEST(ClaimNumbers, IntegralsOfDistributions) {
  const Finding finding = check("K8");
  for (const double n : {0.0, 1.0, 10.0, 1000.0}) {
    EXPECT_NEAR(value_of(finding, "integral of p_h cos theta_h n=" + show(n)), (n + 1) / (n + 2), 1e-9);
  }
  EXPECT_EQ(finding.verdict, ClaimVerdict::holds_if);
}

TEST(ClaimNumbers, HalfVectorsThatFaceAway) {
  const double away = std::erfc(1 / std::tan(85 * pi<double> / 180) / 0.5) / 2;
  EXPECT_NEAR(value_of(check("W2"), "integral of eq. 9 with the sign of h.i, alpha=0.5, 85 degrees"), 1 - 2 * away,
              1e-8);
}

TEST(ClaimNumbers, EqualWeightsAtNormalIncidence) {
  const auto model = make_model<EqualWeights>({{"alpha", 0.5}});
  EXPECT_NEAR(albedo_at(*model, 0).value, 1 - std::exp(-4.0), 1e-9);  // half vectors below 45 degrees
}

TEST(ClaimNumbers, PowersOfTheCosine) {
  const Finding finding = check("N2");
  EXPECT_NEAR(value_of(finding, "power phong"), 1, 1e-6);
  EXPECT_NEAR(value_of(finding, "power blinn"), 2, 1e-5);
}

// --- no verdict is written down: other models have other verdicts ---

struct Mutation {
  std::string id;
  ModelSource make;
  ClaimVerdict before, after;
};

TEST(ClaimVerdicts, FollowTheModels) {
  using V = ClaimVerdict;
  const ModelSource repaired_kurt = [](std::string_view name, const Parameters& parameters) {
    if (name != "kurt") return make_model(name, parameters);
    return make_model<KurtMax>({{"m", std::get<double>(parameters.front().second)}, {"density", 1.0}});
  };
  const std::vector<Mutation> mutations{
      {"N1", with_other("phong_original", "phong"), V::holds, V::fails},
      {"N2", with_other("blinn", "phong"), V::holds_if, V::holds},
      {"N3", with_other("ward", "ward_duer"), V::holds, V::fails},
      {"N4", with_other("cook_torrance", "cook_torrance", {{"masking", "none"}}), V::fails, V::holds},
      {"N5", with_other("ward", "ward_bounded"), V::holds, V::holds_if},
      {"A1", with_other("ashikhmin_shirley", "ashikhmin_shirley", {{"normalization", "projected"}}), V::holds,
       V::fails},
      {"A3", with_other("ashikhmin_shirley", "ashikhmin_shirley", {{"k_s", 0.978}}), V::fails, V::holds},
      {"A6", with_other("ashikhmin_shirley", "ashikhmin_shirley", {{"r_d", 0.999}}), V::holds, V::fails},
      {"A9", with_other("neumann_phong", "phong"), V::holds, V::fails},
      {"A10", with_other("ashikhmin_shirley", "ashikhmin_shirley", {{"k_s", 1.2}}), V::holds, V::holds_if},
      {"W1", with_other("ward", "ward_duer"), V::holds, V::fails},
      {"W3", with_other("ward", "ward_bounded"), V::holds, V::fails},
      {"K3", repaired_kurt, V::holds_if, V::holds},
      {"K4", with_other("kurt", "kurt", {{"exponent", 0.5}}), V::holds, V::fails},
      {"K5", with_other("kurt", "kurt", {{"exponent", 0.0}}), V::fails, V::holds_if},
      {"K6", with_other("kurt", "kurt", {{"exponent", 0.0}}), V::holds_if, V::holds},
      {"K9", with_other("ward", "ward_bounded"), V::holds, V::holds_if},
  };
  for (const auto& [id, make, before, after] : mutations) {
    EXPECT_EQ(to_string(check(id).verdict), to_string(before)) << id;
    EXPECT_EQ(to_string(check(id, make).verdict), to_string(after)) << id << ": " << check(id, make).found;
  }
}

// --- all of them ---

void expect_complete(const Claim& claim, const Finding& finding) {
  EXPECT_NE(finding.verdict, ClaimVerdict::undecided) << claim.id;
  EXPECT_FALSE(finding.found.empty() || finding.quantities.empty()) << claim.id;
  EXPECT_EQ(finding.condition.empty(), finding.verdict != ClaimVerdict::holds_if) << claim.id;
  EXPECT_EQ(finding.repair.empty(), finding.verdict == ClaimVerdict::holds) << claim.id;
  for (const std::string& text : {finding.found, finding.condition, finding.worst, finding.repair}) {
    EXPECT_TRUE(std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; })) << text;
    EXPECT_EQ(text.find("nan"), std::string::npos) << text;
  }
}

/// Digits may differ between compilers, verdicts may not.
TEST(AllClaims, AreCompleteAndHaveTheVerdictsOfThePage) {
  std::ifstream file(std::string(ALBEDO_MATERIALS_DIR) + "/../../doc/claims.md");
  std::stringstream page;
  page << file.rdbuf();
  const std::vector<Claim> claims = claims_of({});
  const std::vector<Finding> findings = check_claims(claims, 0);
  std::set<std::string> ids;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    expect_complete(claims[i], findings[i]);
    EXPECT_TRUE(ids.insert(claims[i].id).second) << claims[i].id;
    const std::string text = page.str();
    const std::size_t row = text.find("\n| " + claims[i].id + " | ");
    ASSERT_NE(row, std::string::npos) << claims[i].id;
    const std::string line = text.substr(row + 1, text.find('\n', row + 1) - row - 1);
    EXPECT_NE(line.find("| **" + std::string(to_string(findings[i].verdict)) + "** |"), std::string::npos)
        << claims[i].id << " is " << to_string(findings[i].verdict)
        << "; doc/claims.md is made by: albedo claims --markdown";
  }
  EXPECT_EQ(claims.size(), 37U);

  std::ostringstream out;
  print_claims(out, claims, findings);
  std::istringstream lines(out.str());
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120U) << line;
}

TEST(AllClaims, AreTheSameOnOneThread) {
  std::vector<Claim> some;
  for (const char* id : {"N3", "A8", "W4", "W5", "K5"}) some.push_back(claim(id));
  const std::vector<Finding> one = check_claims(some, 1), four = check_claims(some, 4);
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_EQ(one[i].found, four[i].found);
    EXPECT_EQ(one[i].worst, four[i].worst);
  }
}

}  // namespace
}  // namespace albedo::analysis
