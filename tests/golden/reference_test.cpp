#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "albedo/reference.hpp"
#include "golden/entries.hpp"

/// The 113-bit reference against closed forms of 30 digits: those at parameters and directions that a double holds
/// exactly.
namespace albedo {
namespace {

using nlohmann::json;

/// Whether it is a multiple of 1/1024, so that the file's decimals are the double's value.
bool is_exact(double value) { return value * 1024 == std::round(value * 1024); }

bool exact_parameters(const json& entry) {
  for (const auto& [name, value] : entry.at("parameters").items()) {
    if (value.is_number() && !is_exact(value.get<double>())) return false;
  }
  return true;
}

struct Closed {
  std::string model;
  int entries;
};

class GoldenReference : public ::testing::TestWithParam<Closed> {};

TEST_P(GoldenReference, HasTwentyDigitsOfTheClosedForm) {
  int checked = 0;
  for (const json& entry : read("closed_forms.json")) {
    const double theta = entry.at("theta_deg");
    if (entry.at("model") != GetParam().model || !exact_parameters(entry) || (theta != 0 && theta != 60)) continue;
    if (entry.at("parameters").value("n", 0.0) > 20) continue;  // takes long
    const auto model = make_model(GetParam().model, parameters_of(entry));
    const EstimateIn<Quad> a = reference_albedo(*model, Direction::from_cosine(theta == 0 ? 1 : 0.5));
    const Quad exact(entry.at("albedo").get<std::string>());
    const std::string what = entry.at("model").get<std::string>() + " " + entry.at("parameters").dump() + " at " +
                             entry.at("theta_deg").dump();
    EXPECT_EQ(a.status, Status::converged) << what;
    EXPECT_LE(a.error, Quad(1e-20) * exact) << what;
    EXPECT_LE(abs(a.value - exact), Quad(1e-20) * exact) << what << ": " << a.value - exact;
    EXPECT_LE(abs(a.value - exact), a.error + Quad(1e-29) * exact) << what << ": " << a.value - exact;
    ++checked;
  }
  EXPECT_EQ(checked, GetParam().entries);
}

INSTANTIATE_TEST_SUITE_P(ClosedForms, GoldenReference,
                         ::testing::Values(Closed{"lambert", 4}, Closed{"phong", 9}, Closed{"ward", 3},
                                           Closed{"ashikhmin_shirley", 8}, Closed{"cook_torrance", 6},
                                           Closed{"ggx", 6}),
                         [](const auto& entry) { return entry.param.model; });

}  // namespace
}  // namespace albedo
