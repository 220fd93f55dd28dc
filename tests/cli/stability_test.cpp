#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

using Json = nlohmann::ordered_json;

TEST_F(CliTest, StabilityPrintsCountsAndWritesEveryAnswer) {
  const Outcome outcome = run_albedo(
      {"stability", "phong", "--grid", "3x2", "--warp", "lobe,hemisphere", "--budget", "5000", "-o", "atlas.csv"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(line_count(outcome.out), 1U + 7 * 2 * 3);
  const std::string text = read_text("atlas.csv");
  for (const std::string part : {"# generator: albedo ", "# command: albedo stability phong --grid 3x2 ",
                                 "\n# tolerance: ", "\nmodel,anisotropy,parameter,value,theta_deg,"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  const std::size_t data = text.find("\nmodel,") + 1;
  EXPECT_EQ(line_count(text.substr(data)), 1U + 3 * 2 * 7 * 2 * 3);
}

TEST_F(CliTest, StabilityGivesTheSameAnswersAsJson) {
  const std::vector<std::string> question{"stability", "ward",   "--grid", "2x2",    "--rule",      "gauss", "--warp",
                                          "lobe",      "--json", "-o",     "w.json", "--precision", "double"};
  const Outcome outcome = run_albedo(question);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json summary = Json::parse(outcome.out);
  ASSERT_EQ(summary["methods"].size(), 1U);
  EXPECT_EQ(summary["methods"][0]["right"], 8);
  EXPECT_EQ(summary["methods"][0]["wrong"], 0);
  const Json written = Json::parse(read_text("w.json"));
  ASSERT_EQ(written["answers"].size(), 8U);
  EXPECT_EQ(written["answers"][0].size(), written["columns"].size());
  EXPECT_EQ(written["provenance"]["budget"], 200000);
}

TEST_F(CliTest, StabilityStudiesHonesty) {
  const Outcome outcome =
      run_albedo({"stability", "phong", "--honesty", "--cases", "20", "--rule", "gauss,stratified", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json study = Json::parse(outcome.out);
  EXPECT_EQ(study["models"], Json{"phong"});
  EXPECT_EQ(study["rules"][0]["rule"], "gauss");
  EXPECT_EQ(study["rules"][0]["judged"], 20);
  EXPECT_EQ(study["rules"][0]["honest"], study["rules"][0]["converged"]);
  EXPECT_EQ(study["rules"][1]["nominal"].size(), 3U);
}

TEST_F(CliTest, StabilityRefusesWhatItCannotDo) {
  const std::vector<std::vector<std::string>> wrong{{"lambert"},
                                                    {"wardd"},
                                                    {"--grid", "1x5"},
                                                    {"--grid", "5"},
                                                    {"--grid", "5.5x5"},
                                                    {"--rule", "gaus"},
                                                    {"--warp", ""},
                                                    {"--precision", "half"},
                                                    {"--tolerance", "0"},
                                                    {"--budget", "0"},
                                                    {"--anisotropy", "0"},
                                                    {"--seed", "-1"},
                                                    {"-o", "a.exr"},
                                                    {"--honesty", "-o", "a.csv"},
                                                    {"--honesty", "--warp", "lobe,paper"},
                                                    {"--honesty", "--precision", "float"}};
  for (std::vector<std::string> arguments : wrong) {
    arguments.insert(arguments.begin(), "stability");
    const Outcome outcome = run_albedo(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments[1];
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
  }
  EXPECT_EQ(run_albedo({"stability", "ward", "--grid", "2x2", "--rule", "gauss", "-o", "no/such.csv"}).code, 4);
  EXPECT_EQ(files(), std::vector<std::string>{});
}

}  // namespace
}  // namespace albedo::test
