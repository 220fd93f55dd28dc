#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

using Json = nlohmann::ordered_json;

/// A study of a second, with what it is asked for besides.
std::vector<std::string> quick(const std::vector<std::string>& more) {
  std::vector<std::string> words{"tradeoff", "phong", "n=20", "--theta", "0", "--rule", "gauss,sobol", "--quick"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(CliTest, TradeoffSummarisesEveryMethod) {
  const Outcome outcome = run_albedo(quick({}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(line_count(outcome.out), 7U) << outcome.out;  // two rules on three warps
  for (const std::string part : {"gauss", "sobol", "lobe", "hemisphere", "paper", "wrong"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
  }
  EXPECT_TRUE(files().empty());
}

TEST_F(CliTest, TradeoffWritesEveryRunWithItsProvenance) {
  ASSERT_EQ(run_albedo(quick({"-o", "t.json", "--warp", "lobe"})).code, 0);
  const Json study = Json::parse(read_text("t.json"));
  EXPECT_EQ(study["command"], "albedo tradeoff phong n=20 --theta 0 --rule gauss,sobol --quick -o t.json --warp lobe");
  ASSERT_EQ(study["cells"].size(), 1U);
  EXPECT_EQ(study["cells"][0]["parameters"]["n"], 20);
  EXPECT_EQ(study["cells"][0]["reference_status"], "converged");
  for (const Json& run : study["cells"][0]["runs"]) {
    EXPECT_EQ(run["warp"], "lobe");
    if (run["rule"] != "gauss") continue;
    EXPECT_LE(run["true_error"], run["reported_error"]);
  }

  ASSERT_EQ(run_albedo(quick({"-o", "t.csv"})).code, 0);
  const std::string csv = read_text("t.csv");
  for (const std::string part : {"# generator: albedo ", "# command: albedo tradeoff phong n=20 ", "# budget: 100000\n",
                                 "\nmodel,material,theta_deg,rule,warp,", "\nphong,n=20,0,gauss,lobe,"}) {
    EXPECT_NE(csv.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(run_albedo(quick({"-o", "-"})).out.substr(0, 2), "# ");
}

TEST_F(CliTest, TradeoffCannotWriteWhereNothingCanBe) {
  const Outcome outcome = run_albedo(quick({"-o", "missing/t.csv"}));
  EXPECT_EQ(outcome.code, 4);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
  EXPECT_NE(outcome.err.find("cannot write 'missing/t.csv'"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace albedo::test
