#include "albedo/combinators/pumped.hpp"
#include "albedo/directional_albedo.hpp"
#include "golden/entries.hpp"

namespace albedo {
namespace {

PumpControl control_of(const nlohmann::json& entry) {
  for (const PumpControl control : {PumpControl::none, PumpControl::step}) {
    if (to_string(control) == entry.at("control").get<std::string>()) return control;
  }
  return PumpControl::total;
}

/// The tables are raised by their bounds at every order, which lowers what follows by as much.
double allowed(const PumpSequence& sequence, int order, double uncertainty) {
  double sum = uncertainty;
  for (int k = 0; k <= order; ++k) sum += sequence.relative_bound(k);
  return sum;
}

TEST(GoldenPumping, SequencesAreThoseOfAMatrixOnAFixedGrid) {
  const nlohmann::json entries = read("pumping.json");
  ASSERT_EQ(entries.size(), 36U);
  for (const nlohmann::json& entry : entries) {
    const auto model = make_model(entry.at("model").get<std::string>(), {{"n", entry.at("n").get<double>()}});
    const int times = entry.at("times");
    PumpSequence sequence(*model, control_of(entry), false, 1e-8);
    for (int k = 0; k < times; ++k) sequence.advance();
    EXPECT_EQ(sequence.status(), Status::converged) << entry;
    for (std::size_t i = 0; i < entry.at("theta_deg").size(); ++i) {
      const double exact = entry.at("albedo")[i];
      const Direction l = Direction::from_degrees(entry.at("theta_deg")[i]);
      EXPECT_NEAR(sequence.albedo(times, l.cos_theta), exact, allowed(sequence, times, entry.at("uncertainty")[i]))
          << entry << ' ' << i;
    }
  }
}

TEST(GoldenPumping, ModelsAreWhatTheirSequenceSays) {
  for (const nlohmann::json& entry : read("pumping.json")) {
    const int times = entry.at("times");
    if (times != 0 && times != 3) continue;
    const PumpedModel model(make_model(entry.at("model").get<std::string>(), {{"n", entry.at("n").get<double>()}}),
                            {.times = times, .control = control_of(entry)});
    for (std::size_t i = 0; i < entry.at("theta_deg").size(); ++i) {
      const double exact = entry.at("albedo")[i];
      const Estimate a =
          directional_albedo(model, Direction::from_degrees(entry.at("theta_deg")[i]), {.tolerance = 1e-6});
      EXPECT_NEAR(a.value, exact, a.error + 4e-8 + entry.at("uncertainty")[i].get<double>()) << entry << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace albedo
