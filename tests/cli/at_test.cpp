#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& [key, item] : object.items()) names.push_back(key);
  return names;
}

TEST_F(CliTest, AtPrintsOneJsonObjectWithTheKeysOfTheContract) {
  const Outcome outcome = run_albedo({"at", "ward", "alpha=0.1", "--theta", "0,60", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const Json object = Json::parse(outcome.out);
  EXPECT_EQ(keys(object),
            (std::vector<std::string>{"model", "parameters", "rule", "warp", "tolerance", "precision", "results"}));
  EXPECT_EQ(object["model"], "ward");
  EXPECT_EQ(object["parameters"]["alpha_x"], 0.1);
  EXPECT_EQ(object["parameters"]["alpha_y"], 0.1);
  EXPECT_EQ(object["rule"], "gauss");
  EXPECT_EQ(object["warp"], "lobe");
  EXPECT_EQ(object["tolerance"], 1e-8);
  EXPECT_EQ(object["precision"], "double");
  ASSERT_EQ(object["results"].size(), 2U);
  const Json& result = object["results"][1];
  EXPECT_EQ(keys(result), (std::vector<std::string>{"theta_deg", "phi_deg", "albedo", "error", "error_kind",
                                                    "evaluations", "status", "seconds"}));
  EXPECT_EQ(result["theta_deg"], 60);
  EXPECT_EQ(result["phi_deg"], 0);
  EXPECT_EQ(result["status"], "converged");
  EXPECT_GT(result["evaluations"], 0);
  // tests/golden/independent.json says how these two were computed.
  EXPECT_NEAR(object["results"][0]["albedo"].get<double>(), 0.971051675567, 1e-8);
  EXPECT_NEAR(result["albedo"].get<double>(), 0.488988056485, 5e-9);
}

TEST_F(CliTest, AtTellsTheCoherentPartWhereThereIsOne) {
  const Outcome outcome = run_albedo({"at", "he_torrance", "sigma0=0.1", "tau=1.7", "--theta", "0,80", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json results = Json::parse(outcome.out)["results"];
  // tests/golden/he_torrance.json
  EXPECT_NEAR(results[1]["coherent_albedo"].get<double>(), 0.79496552, 1e-8);
  EXPECT_NEAR(results[1]["albedo"].get<double>(), 0.79496552 + 0.24503613, 2e-8);

  const Outcome text = run_albedo({"at", "he_torrance", "--theta", "80"});
  EXPECT_NE(text.out.find("coherent"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("0.794965"), std::string::npos) << text.out;
  const Outcome diffuse = run_albedo({"at", "he_torrance", "part=directional_diffuse", "--theta", "80"});
  EXPECT_EQ(diffuse.out.find("coherent"), std::string::npos) << diffuse.out;
}

TEST_F(CliTest, AtTakesASumOfModels) {
  const Outcome outcome =
      run_albedo({"at", "sum", "lambert:rho=0.2", "ward:alpha=0.1,rho_s=0.3,weight=0.5", "--theta", "60", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json object = Json::parse(outcome.out);
  EXPECT_EQ(object["model"], "sum");
  EXPECT_EQ(object["parameters"]["1.model"], "lambert");
  EXPECT_EQ(object["parameters"]["2.weight"], 0.5);
  EXPECT_EQ(object["parameters"]["2.alpha_y"], 0.1);
  EXPECT_NEAR(object["results"][0]["albedo"].get<double>(), 0.2 + 0.15 * 0.488988056485, 5e-9);
  EXPECT_EQ(run_albedo({"curve", "sum", "lambert", "ggx:weight=0", "--tolerance", "1e-4"}).code, 0);
}

TEST_F(CliTest, AtPrintsAlignedColumnsOtherwise) {
  const Outcome outcome = run_albedo({"at", "lambert", "rho=0.5", "--theta", "0,89.5"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(line_count(outcome.out), 3U);
  EXPECT_TRUE(outcome.out.starts_with("theta  phi  ")) << outcome.out;
  const std::size_t width = outcome.out.find('\n');
  EXPECT_EQ(outcome.out.size(), 3 * (width + 1)) << outcome.out;
}

TEST_F(CliTest, AtNinetyDegreesIsTheLimitOrDivergent) {
  const Outcome divergent = run_albedo({"at", "ward", "--theta", "90", "--json"});
  EXPECT_EQ(divergent.code, 0) << divergent.err;
  const Json infinite = Json::parse(divergent.out)["results"][0];
  EXPECT_TRUE(infinite["albedo"].is_null());
  EXPECT_EQ(infinite["status"], "divergent");

  const Outcome limit = run_albedo({"at", "lambert", "rho=0.5", "--theta", "90", "--json"});
  EXPECT_EQ(limit.code, 0) << limit.err;
  EXPECT_NEAR(Json::parse(limit.out)["results"][0]["albedo"].get<double>(), 0.5, 1e-8);
}

TEST_F(CliTest, AtTakesAChoiceThatLooksLikeANumber) {
  const auto albedo = [](const std::string& equation) {
    const Outcome outcome = run_albedo({"at", "kurt", "equation=" + equation, "--theta", "60", "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out);
  };
  const Json nine = albedo("9"), ten = albedo("10");
  EXPECT_EQ(nine["parameters"]["equation"], "9");
  EXPECT_NE(nine["results"][0]["albedo"], ten["results"][0]["albedo"]);
}

TEST_F(CliTest, AtHasACoarserDefaultForTheStratifiedRuleAndRepeatsItsSeed) {
  const std::vector<std::string> arguments{"at",         "lambert", "--theta", "30",    "--rule",
                                           "stratified", "--seed",  "7",       "--json"};
  const Json first = Json::parse(run_albedo(arguments).out);
  EXPECT_EQ(first["tolerance"], 1e-4);
  EXPECT_EQ(first["seed"], 7);
  EXPECT_EQ(first["results"][0]["albedo"], Json::parse(run_albedo(arguments).out)["results"][0]["albedo"]);
}

TEST_F(CliTest, AtKnowsEveryRuleAndWarp) {
  for (const std::string rule : {"gauss", "cubature", "kronrod", "tanh_sinh", "stratified", "sobol", "monte_carlo"}) {
    for (const std::string warp : {"lobe", "hemisphere", "paper"}) {
      const Outcome outcome = run_albedo({"at", "lambert", "rho=0.5", "--theta", "30", "--rule", rule, "--warp", warp,
                                          "--tolerance", "1e-2", "--json"});
      EXPECT_EQ(outcome.code, 0) << rule << ", " << warp << ": " << outcome.err;
      const Json object = Json::parse(outcome.out);
      EXPECT_EQ(object["rule"], rule);
      EXPECT_EQ(object["warp"], warp);
      EXPECT_NEAR(object["results"][0]["albedo"].get<double>(), 0.5, 0.02) << rule << ", " << warp;
      const bool random = rule == "stratified" || rule == "sobol" || rule == "monte_carlo";
      EXPECT_EQ(object.contains("seed"), random) << rule;
      EXPECT_EQ(object["results"][0]["error_kind"] == "standard_error", random) << rule;
    }
  }
}

TEST_F(CliTest, AtHasACoarserDefaultForEveryMonteCarloRule) {
  for (const auto& [rule, tolerance] :
       {std::pair{"kronrod", 1e-8}, {"tanh_sinh", 1e-8}, {"sobol", 1e-4}, {"monte_carlo", 1e-4}}) {
    const Outcome outcome =
        run_albedo({"at", "lambert", "--theta", "30", "--rule", rule, "--budget", "1000", "--json"});
    EXPECT_EQ(Json::parse(outcome.out)["tolerance"], tolerance) << rule;
  }
}

TEST_F(CliTest, AtPrintsResultsThatMissedTheToleranceAndExitsWith3) {
  const Outcome outcome = run_albedo(
      {"at", "ward", "--theta", "0,60", "--rule", "cubature", "--warp", "hemisphere", "--budget", "100", "--json"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
  const Json results = Json::parse(outcome.out)["results"];
  EXPECT_EQ(results.size(), 2U);
  EXPECT_NE(results[1]["status"], "converged");
}

TEST_F(CliTest, AtHoldsItsResultsAgainstAssertions) {
  const auto at = [](const std::string& condition) {
    return run_albedo({"at", "ward", "alpha=0.1", "--theta", "0,60", "--assert", condition});
  };
  for (const std::string condition :
       {"max<=1", "at(60)==0.488988±1e-6", "at(60)==0.488988+-1e-6, error<=1e-6", "min>0.4"}) {
    EXPECT_EQ(at(condition).code, 0) << condition;
  }
  const Outcome failed = at("max<=1, at(60)<=0.4");
  EXPECT_EQ(failed.code, 1);
  EXPECT_EQ(line_count(failed.err), 1U);
  EXPECT_NE(failed.err.find("at(60)<=0.4"), std::string::npos) << failed.err;
  EXPECT_NE(failed.err.find("0.488988"), std::string::npos) << failed.err;
  EXPECT_EQ(line_count(failed.out), 3U);  // the results are printed all the same
}

TEST_F(CliTest, AnAlbedoThatIsInfiniteExceedsEveryBound) {
  EXPECT_EQ(run_albedo({"at", "ward", "--theta", "0,90", "--assert", "max<=1e300"}).code, 1);
}

TEST_F(CliTest, AFullDeviceIsAFailureToWrite) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"at", "ward", "--theta", "0"}, {"models"}, {"curve", "lambert"}, {"table", "lambert", "-o", "-"}}) {
    const Outcome outcome = run_albedo(arguments, "/dev/full");
    EXPECT_EQ(outcome.code, 4) << arguments.front();
    EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
  }
}

TEST_F(CliTest, AtAnswersTheSameOnAnyNumberOfThreads) {
  const auto on_threads = [&](const std::string& count) {
    const Outcome outcome = run_albedo({"at", "sum", "ggx:alpha=0.3,weight=0.5", "phong:n=7,weight=0.5", "--theta",
                                        "0,89,15,60,30,75,45,85,5", "--threads", count});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
  };
  const std::string alone = on_threads("1");
  EXPECT_EQ(on_threads("4"), alone);
  EXPECT_LT(alone.find("89"), alone.find("75"));  // in the order in which they were asked for
}

TEST_F(CliTest, AtNamesTheFirstDirectionThatIsNone) {
  const Outcome outcome = run_albedo({"at", "ward", "--theta", "0,91,92", "--threads", "4"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("91"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace albedo::test
