#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

using Json = nlohmann::ordered_json;

TEST_F(CliTest, PumpPrintsTheSequence) {
  const Outcome outcome = run_albedo({"pump", "phong", "n=20", "--times", "2", "--control", "total"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(line_count(outcome.out), 5U) << outcome.out;
  EXPECT_NE(outcome.out.find("worth pumping: once"), std::string::npos) << outcome.out;

  const Json object = Json::parse(run_albedo({"pump", "phong", "--times", "2", "--control", "total", "--json"}).out);
  EXPECT_EQ(object["model"], "phong");
  EXPECT_EQ(object["control"], "total");
  EXPECT_EQ(object["only_up"], false);
  EXPECT_EQ(object["worth"], 1);
  ASSERT_EQ(object["orders"].size(), 3U);
  const Json& last = object["orders"][2];
  EXPECT_EQ(last["times"], 2);
  EXPECT_LE(last["largest"], 1);
  EXPECT_EQ(run_albedo({"curve", "phong", "--pump", "2", "--control", "total", "--rule", "cubature", "--tolerance",
                        "1e-5", "-o", "c.csv", "--assert", "mean==" + last["average"].dump() + "+-1e-5"})
                .code,
            0);                                                      // by another way
  EXPECT_NEAR(last["radiance"], 22 / (2 * 3.14159265358979), 1e-6);  // of the mirror direction: eq. 22 has no peak
}

TEST_F(CliTest, PumpedModelsAreModels) {
  // golden values of pumping.json
  const Outcome at = run_albedo({"at", "phong", "n=20", "--pump", "2", "--control", "total", "--theta", "60,85",
                                 "--assert", "at(60)==0.8713494+-1e-7, at(85)==0.6034402+-5e-7"});
  EXPECT_EQ(at.code, 0) << at.err;
  const Json object = Json::parse(run_albedo({"at", "phong", "--pump", "2", "--theta", "60", "--json"}).out);
  EXPECT_EQ(object["model"], "pumped");
  EXPECT_EQ(object["parameters"]["model"], "phong");
  EXPECT_EQ(object["parameters"]["times"], 2);
  EXPECT_EQ(object["parameters"]["control"], "none");
  EXPECT_EQ(object["parameters"]["base.n"], 20);
  EXPECT_NEAR(object["results"][0]["albedo"], 0.974757506742, 1e-7);
  const Outcome curve = run_albedo({"curve", "ward", "alpha=0.3", "--pump", "1", "--tolerance", "1e-4", "-o", "c.csv",
                                    "--assert", "max<=1.0001, min>0.2"});
  EXPECT_EQ(curve.code, 0) << curve.err;
  EXPECT_EQ(run_albedo({"at", "sum", "lambert:rho=0.2", "phong:weight=0.5", "--pump", "1", "--theta", "30", "--assert",
                        "max<=1, min>0.9"})
                .code,
            0);
  EXPECT_EQ(run_albedo({"at", "phong", "--pump", "0", "--theta", "60", "--json"}).out.find("pumped"),
            std::string::npos);
}

TEST_F(CliTest, AuditShowsWhatTheRestrictionToGBelowOneLeaves) {
  const std::vector<std::string> audit{"audit",       "ward",        "alpha=0.3", "--checks",
                                       "reciprocity", "--tolerance", "1e-5",      "--json"};
  const auto verdict = [&](std::vector<std::string> more) {
    more.insert(more.begin(), audit.begin(), audit.end());
    return Json::parse(run_albedo(more).out)["audits"][0]["energy"]["verdict"].get<std::string>();
  };
  EXPECT_EQ(verdict({}), "not claimed");
  EXPECT_EQ(verdict({"--pump", "1"}), "pass");
  EXPECT_EQ(verdict({"--pump", "1", "--only-up"}), "not claimed");
}

}  // namespace
}  // namespace albedo::test
