#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

using Json = nlohmann::ordered_json;

TEST_F(CliTest, ClaimsOfOnePaper) {
  const Outcome outcome = run_albedo({"claims", "--paper", "ashikhmin"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const std::string part : {"Ashikhmin, Shirley 2000\n", "\nA1   holds ", "\nA3   fails ", "\nA10  "}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << '\n' << outcome.out;
  }
  EXPECT_EQ(outcome.out.find("Walter"), std::string::npos);
}

TEST_F(CliTest, ClaimsAsJson) {
  const Outcome outcome = run_albedo({"claims", "--paper", "walter", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json object = Json::parse(outcome.out);
  EXPECT_EQ(object["command"], "albedo claims --paper walter --json");
  ASSERT_EQ(object["claims"].size(), 5U);
  for (const Json& claim : object["claims"]) {
    EXPECT_EQ(claim["paper"], "walter");
    EXPECT_FALSE(claim["quantities"].empty());
    for (const char* key : {"id", "where", "claim", "verdict", "found"}) {
      EXPECT_FALSE(claim[key].get<std::string>().empty()) << key;
    }
    EXPECT_EQ(claim["condition"].get<std::string>().empty(), claim["verdict"] != "holds if");
  }
}

TEST_F(CliTest, ClaimsAsAPage) {
  const Outcome outcome = run_albedo({"claims", "--paper", "walter", "--markdown"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.substr(0, 2), "# ");
  EXPECT_NE(outcome.out.find("\n## Walter 2005\n"), std::string::npos);
  EXPECT_NE(outcome.out.find("\n| W1 | "), std::string::npos);
}

TEST_F(CliTest, ClaimsAreTheSameForAnyNumberOfThreads) {
  const Outcome one = run_albedo({"claims", "--paper", "walter", "--threads", "1"});
  const Outcome four = run_albedo({"claims", "--paper", "walter", "--threads", "4"});
  EXPECT_EQ(one.out, four.out);
}

TEST_F(CliTest, ClaimsRefusesNonsense) {
  const std::vector<std::vector<std::string>> questions{
      {"claims", "--paper", "walther"}, {"claims", "--json", "--markdown"}, {"claims", "--threads", "0"}};
  for (const auto& question : questions) {
    const Outcome outcome = run_albedo(question);
    EXPECT_EQ(outcome.code, 2) << question[1];
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
  }
}

}  // namespace
}  // namespace albedo::test
