#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

using Json = nlohmann::ordered_json;

TEST_F(CliTest, CurveIsCsvOnStandardOutputWithItsProvenance) {
  const Outcome outcome = run_albedo({"curve", "ggx", "--tolerance", "1e-4"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const std::string line :
       {"# generator: albedo ", "# command: albedo curve ggx --tolerance 1e-4\n", "# model: ggx\n", "# form: ",
        "# node_count: ", "# relative_bound: ", "# evaluations: ", "\ntheta_deg,cos_theta,albedo,error\n0,1,"}) {
    EXPECT_NE(outcome.out.find(line), std::string::npos) << line;
  }
  EXPECT_EQ(outcome.out, run_albedo({"curve", "ggx", "--tolerance", "1e-4"}).out);
}

TEST_F(CliTest, CurveWritesTheSameNodesInEveryForm) {
  const Json printed = Json::parse(run_albedo({"curve", "ggx", "--tolerance", "1e-4", "--json"}).out);
  ASSERT_EQ(printed["nodes"].size(), printed["node_count"]);
  EXPECT_LE(printed["relative_bound"], 1e-4);
  for (const std::string name : {"c.json", "c.csv", "d.npy", "c.hpp", "c.exr"}) {
    const Outcome outcome = run_albedo({"curve", "ggx", "--tolerance", "1e-4", "-o", name});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_EQ(Json::parse(read_text("c.json"))["nodes"], printed["nodes"]);
  const Json sidecar = Json::parse(read_text("d.json"));
  EXPECT_EQ(sidecar["shape"][0], printed["node_count"]);
}

TEST_F(CliTest, CurveInterpolatesForAssertions) {
  EXPECT_EQ(
      run_albedo({"curve", "ward", "alpha=0.1", "-o", "w.csv", "--assert", "at(60)==0.488988056485+-1e-8, min>0"}).code,
      0);
  EXPECT_EQ(run_albedo({"curve", "lambert", "rho=0.5", "-o", "l.csv", "--assert",
                        "mean==0.5+-1e-7, max<=0.5000001, at(90)<0.6"})
                .code,
            0);
  const Outcome outcome =
      run_albedo({"curve", "ward", "-o", "x.csv", "--assert", "max<=1"});  // diverges at grazing incidence
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
}

TEST_F(CliTest, CurveRefusesThreadsThatItWouldNotUse) {
  const Outcome outcome = run_albedo({"curve", "ward", "--tolerance", "1e-4", "--threads", "2"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--threads is of several channels, or of --form rational"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

}  // namespace
}  // namespace albedo::test
