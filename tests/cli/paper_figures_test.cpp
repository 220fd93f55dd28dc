#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/figures.hpp"
#include "measured_files.hpp"

/// The figures of the papers: that their data are whole, and that they show what is known otherwise.
namespace albedo::test::figures {
namespace {

using Values = std::vector<double>;

class PaperFigures : public Figures {
 protected:
  /// Makes a figure's data and reads them.
  [[nodiscard]] Data data_of(const std::string& name, const std::string& environment = "") const {
    const Outcome outcome = run(name + " --data-only --output out", environment);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "");
    EXPECT_EQ(names(), (Names{name + ".csv", name + ".gp"}));
    Data data(directory_ / ("out/" + name + ".csv"));
    EXPECT_EQ(data.header["command"], "albedo-figures " + name);
    EXPECT_TRUE(contains(data.header["source"], "19") || contains(data.header["source"], "20")) << name;
    const std::string script = read(directory_ / ("out/" + name + ".gp"));
    EXPECT_TRUE(contains(script, "data = '" + name + ".csv'"));
    return data;
  }
};

std::size_t row_of(const Values& axis, double value) {
  const auto place = std::ranges::find_if(axis, [=](double x) { return std::abs(x - value) < 1e-9; });
  EXPECT_NE(place, axis.end()) << value;
  return static_cast<std::size_t>(place - axis.begin());
}

double largest(const Values& values) { return *std::ranges::max_element(values); }

bool all_finite(const Values& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

TEST_F(PaperFigures, Neumann2HasACriticalRegionForTheSmallDomainOfLightOnly) {
  Data data = data_of("neumann-2");
  EXPECT_EQ(std::stod(data.header["longest arc with a critical region"]), 48);
  EXPECT_EQ(std::stod(data.header["solid angle of the critical region [sr], large"]), 0);
  EXPECT_GT(std::stod(data.header["solid angle of the critical region [sr], small"]), 0.01);
  for (const char* const column : {"cap_x", "large_from_first_x", "large_from_last_y", "small_region_x"}) {
    EXPECT_TRUE(all_finite(data.values[column])) << column;
  }
  // V in the plane of incidence: from 2 caps above the horizon down to it, on the mirror's side
  EXPECT_NEAR(largest(data.values["small_region_x"]), -66, 1e-6);
  EXPECT_NEAR(*std::ranges::min_element(data.values["small_region_x"]), -90, 1e-6);
  // seen from any L, all of it has half vectors in the cap
  for (std::size_t i = 0; i < data.values["psi"].size(); ++i) {
    const double slope = std::hypot(data.values["small_region_slope_x"][i], data.values["small_region_slope_y"][i]);
    EXPECT_LE(slope, std::tan(12 * std::numbers::pi / 180) + 1e-9) << i;
  }
}

TEST_F(PaperFigures, Neumann3To6AreTheGoldenSequences) {
  std::ifstream file(std::string(ALBEDO_GOLDEN_DIR) + "/pumping.json");
  const nlohmann::json golden = nlohmann::json::parse(file);
  int compared = 0;
  for (const auto& [name, model, readings] :
       {std::tuple{"neumann-3", "phong", Names{"none"}}, std::tuple{"neumann-4", "blinn", Names{"none"}},
        std::tuple{"neumann-5", "phong", Names{"step", "total"}},
        std::tuple{"neumann-6", "blinn", Names{"step", "total"}}}) {
    fs::remove_all(directory_ / "out");
    Data data = data_of(name);
    for (const auto& [column, values] : data.values) EXPECT_TRUE(all_finite(values)) << name << ' ' << column;
    const Values& theta = data.values["theta"];
    for (const nlohmann::json& entry : golden) {
      const std::string control = entry.at("control");
      if (entry.at("model") != model || std::ranges::find(readings, control) == readings.end()) continue;
      const Values& albedo = data.values[control + "_albedo_" + std::to_string(entry.at("times").get<int>())];
      for (std::size_t i = 0; i < entry.at("theta_deg").size(); ++i) {
        const double exact = entry.at("albedo")[i], at = entry.at("theta_deg")[i];
        const double allowed = 1e-6 + entry.at("uncertainty")[i].get<double>();
        EXPECT_NEAR(albedo[row_of(theta, at)], exact, allowed) << name << ' ' << entry << ' ' << i;
        EXPECT_EQ(albedo[row_of(theta, -at)], albedo[row_of(theta, at)]);
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, 36 * 7);
}

TEST_F(PaperFigures, Neumann6ShowsThatTheFloorOfTheWholeDivisorKeepsTheRadiance) {
  Data data = data_of("neumann-6");
  const double before = data.values["total_peak_0"][row_of(data.values["theta"], 0)];
  for (int k = 0; k <= 5; ++k) {
    EXPECT_LE(largest(data.values["total_peak_" + std::to_string(k)]), before * (1 + 1e-6)) << k;
    EXPECT_LE(largest(data.values["total_radiance_80_" + std::to_string(k)]), before * (1 + 1e-6)) << k;
  }
  EXPECT_GT(largest(data.values["step_peak_5"]), 10 * before);
  // a peak is nowhere less than a radiance of the same light
  const std::size_t row = row_of(data.values["theta"], 80);
  for (int k = 0; k <= 5; ++k) {
    const std::string order = std::to_string(k);
    EXPECT_GE(data.values["step_peak_" + order][row], largest(data.values["step_radiance_80_" + order])) << k;
  }
}

TEST_F(PaperFigures, Neumann7IsWhereControlledPumpingOfPhongEnds) {
  Data limit = data_of("neumann-7");
  const double brightest = 22 / (2 * std::numbers::pi);
  for (const char* const column : {"radiance_0", "radiance_30", "radiance_60", "radiance_80"}) {
    EXPECT_NEAR(largest(limit.values[column]), brightest, 1e-12) << column;
  }
  for (const char* const column : {"n2", "n5", "n20", "n100", "n1000"}) {
    EXPECT_NEAR(limit.values[column][row_of(limit.values["theta"], 0)], 1, 1e-8) << column;
    EXPECT_LE(largest(limit.values[column]), 1 + 1e-8) << column;
    // at grazing incidence half of a lobe without its cosine: (n+2)/2π · π/(n+1)
    const double n = std::stod(std::string(column).substr(1));
    EXPECT_NEAR(limit.values[column].back(), (n + 2) / (2 * (n + 1)), 1e-8) << column;
  }
  EXPECT_EQ(limit.header["not converged"], "0");
  fs::remove_all(directory_ / "out");
  Data pumped = data_of("neumann-5");
  ASSERT_EQ(pumped.values["theta"], limit.values["theta"]);
  for (const double theta : {0., 30., 60., 75.}) {
    const std::size_t row = row_of(limit.values["theta"], theta);
    EXPECT_NEAR(pumped.values["total_albedo_5"][row], limit.values["n20"][row], 1e-4) << theta;
  }
}

TEST_F(PaperFigures, Walter6BoundsWhatASearchFinds) {
  Data data = data_of("walter-6");
  for (const std::string side : {"0.1", "0.4"}) {
    for (std::size_t i = 0; i < data.values["theta"].size(); ++i) {
      const double cosine = data.values["cosine_" + side][i], product = data.values["product_" + side][i];
      EXPECT_NEAR(data.values["cosine_bound_" + side][i], cosine, 1e-9) << i;  // eq. 27 is the maximum
      EXPECT_GE(data.values["product_bound_" + side][i], product) << i;
      EXPECT_GE(product, data.values["at_middle"][i]) << i;
    }
  }
  const std::size_t mirror = row_of(data.values["theta"], 45);
  EXPECT_NEAR(data.values["at_middle"][mirror], 1 / (4 * std::numbers::pi * 0.04), 1e-12);
}

TEST_F(PaperFigures, Kurt1ShowsTheFilesOfADirectory) {
  const Outcome without = run("kurt-1 --output out", "ALBEDO_MEASURED_DIR=out");
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_TRUE(contains(without.err, "kurt-1 needs measured materials: set ALBEDO_MEASURED_DIR")) << without.err;
  EXPECT_EQ(names(), Names{});

  // f cosθ_V = rgb/4 everywhere: the albedo is that of half the sphere
  RglContent content;
  content.rgb = [](std::size_t, int channel, double, double) { return channel == 0 ? 1.0 : 0.5; };
  fs::create_directory(directory_ / "files");
  std::ofstream(directory_ / "files/some_rgb.bsdf", std::ios::binary) << rgl_bytes(content);
  std::ofstream(directory_ / "files/note.txt") << "not a material";
  Data data = data_of("kurt-1", "ALBEDO_MEASURED_DIR=files");
  EXPECT_EQ(data.header["material1"], "some_rgb");
  EXPECT_EQ(data.header["not converged"], "0");
  ASSERT_EQ(data.values["theta_l"].size(), 24U);
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_NEAR(data.values["material1_r"][i], std::numbers::pi / 2, 1e-2) << i;
    EXPECT_NEAR(data.values["material1_b"][i], std::numbers::pi / 4, 5e-3) << i;
    EXPECT_NEAR(data.values["material1"][i], std::numbers::pi / 4 * 1.2126, 8e-3) << i;
  }
}

TEST_F(PaperFigures, Kurt2PassesOneForTheRoughestOnly) {
  Data data = data_of("kurt-2");
  EXPECT_EQ(data.header["not converged"], "0");
  for (const char* const column : {"m0.05", "m0.1", "m0.2", "m0.5", "m1"}) {
    EXPECT_LE(largest(data.values[column]), 1) << column;
    EXPECT_GE(data.values[column].back(), 0.5) << column;
  }
  EXPECT_GT(largest(data.values["m3"]), 1.3);
}

TEST_F(PaperFigures, Kurt3PassesOneWhereTheCriticalAnglesAre) {
  Data data = data_of("kurt-3");
  EXPECT_EQ(data.header["not converged"], "0");
  const Values& theta = data.values["theta_l"];
  // found by bisection of another rule's albedos: 58.758, 83.177 and 87.579 degrees
  for (const auto& [column, below, above] :
       {std::tuple{"m1_alpha0.75", 58.5, 59.}, std::tuple{"m0.3_alpha0.5", 83., 83.5},
        std::tuple{"m0.1_alpha0.5", 87.5, 88.}}) {
    EXPECT_LT(data.values[column][row_of(theta, below)], 1) << column;
    EXPECT_GT(data.values[column][row_of(theta, above)], 1) << column;
  }
  for (const std::string m : {"m0.05", "m0.1", "m0.3", "m1"}) {
    EXPECT_LE(largest(data.values[m + "_alpha0"]), 1) << m;
    for (const char* const exponent : {"_alpha0.1", "_alpha0.25", "_alpha0.5", "_alpha0.75"}) {
      EXPECT_TRUE(std::isinf(data.values[m + exponent].back())) << m << exponent;
    }
  }
}

TEST_F(PaperFigures, Kurt7HasPublishedFitsAndItsOwn) {
  Data data = data_of("kurt-7");
  for (const auto& [column, values] : data.values) EXPECT_TRUE(all_finite(values)) << column;
  const std::size_t normal = row_of(data.values["theta_v"], 0);
  // Ashikhmin–Shirley at N = L = V: k_s (n+1)/8π r_s + k_d/π
  const double specular = 0.37116 * 34.235335 / (8 * std::numbers::pi) * 0.016006170630736356;
  EXPECT_NEAR(data.values["ashikhmin_shirley_0"][normal], specular + 0.0116 / std::numbers::pi, 1e-12);
  // eq. 11 with three parameters is nearer to Cook–Torrance than Ward with one
  double ward = 0, kurt = 0;
  for (std::size_t i = 20; i < data.values["theta_v"].size() - 20; ++i) {
    const double target = data.values["cook_torrance_30"][i];
    ward = std::max(ward, std::abs(data.values["ward_30"][i] - target));
    kurt = std::max(kurt, std::abs(data.values["kurt_30"][i] - target));
  }
  EXPECT_LT(kurt, ward / 3);
}

TEST_F(PaperFigures, PlausibilitySaysTheSameByTheLargestAlbedoAndByTheCriticalAngle) {
  Data data = data_of("plausibility");
  const Values &model = data.values["model"], &critical = data.values["critical"],
               &largest_albedo = data.values["largest"];
  ASSERT_EQ(model.size(), 60U * 50U + 3U * 97U);
  for (std::size_t i = 0; i < model.size(); ++i) {
    // the largest is that of the angles up to 89 degrees
    EXPECT_EQ(largest_albedo[i] > 1, critical[i] > 1) << i;
    const bool divergent = model[i] != 3;  // all but eq. 9
    EXPECT_EQ(std::isinf(data.values["grazing"][i]), divergent) << i;
  }
  EXPECT_NEAR(data.values["m_low"].front(), 0.03, 1e-15);
  EXPECT_NEAR(data.values["exponent_high"][60U * 50U - 1], 1, 1e-15);
}

TEST_F(PaperFigures, SeveralTellWhichAreDone) {
  const Outcome outcome = run("kurt-2 neumann-7 --data-only --output out");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(outcome.err.starts_with("[1/2] kurt-2: ")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, " s\n[2/2] neumann-7: ")) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 2) << outcome.err;
  EXPECT_FALSE(contains(outcome.err, "\r"));  // no terminal
}

TEST_F(PaperFigures, AreDrawnByGnuplotWithoutComplaints) {
  if (!installed("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  for (const std::string name : {"neumann-2", "neumann-7", "walter-6", "kurt-3"}) {
    fs::remove_all(directory_ / "out");
    const Outcome outcome = run(name + " --format svg --output out");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(names(), (Names{name + ".csv", name + ".gp", name + ".svg"}));
  }
}

}  // namespace
}  // namespace albedo::test::figures
