#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

using Json = nlohmann::ordered_json;

TEST_F(CliTest, AuditLooksAtEveryModel) {
  const Outcome outcome = run_albedo({"audit", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const Json audits = Json::parse(outcome.out)["audits"];
  const Json models = Json::parse(run_albedo({"models", "--json"}).out);
  EXPECT_EQ(audits.size(), models.size() - 1);  // measured needs a file
  for (const Json& audit : audits) {
    EXPECT_EQ(audit["verdict"], "pass") << audit["model"];
    for (const char* check : {"energy", "bounded", "reciprocity", "distribution", "masking", "samplers"}) {
      EXPECT_NE(audit[check]["verdict"], "fails") << audit["model"] << ' ' << check;
    }
    EXPECT_GT(audit["average_albedo"]["value"].get<double>(), 0) << audit["model"];
  }
}

TEST_F(CliTest, AuditTellsWhatItFound) {
  const Outcome outcome = run_albedo({"audit", "ward", "alpha=0.2"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(line_count(outcome.out), 8U);
  for (const std::string part :
       {"ward alpha_x=0.2 alpha_y=0.2 rho_s=1 rho_d=0\n", "not claimed     largest albedo infinite at 90 degrees",
        "passes 1 at 89.9558 degrees", "(N.L)^-0.5 from the limit integral", "\n  samplers      pass "}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << '\n' << outcome.out;
  }
}

TEST_F(CliTest, AuditOfMaterials) {
  const std::string file = std::string(ALBEDO_MATERIALS_DIR) + "/ngan_ward.json";
  const Outcome outcome = run_albedo({"audit", "--materials", file, "--checks", "average", "-o", "ward.csv"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(line_count(outcome.out), 2U);  // the summary: one model
  EXPECT_NE(outcome.out.find("ngan_ward   ward         86             86         86               -"),
            std::string::npos)
      << outcome.out;
  const std::string text = read_text("ward.csv");
  const std::size_t data = text.find("\nlist,material,channel,model,") + 1;
  EXPECT_EQ(line_count(text.substr(data)), 1U + 86 * 3);
}

TEST_F(CliTest, AuditIsTheSameForAnyNumberOfThreads) {
  const std::vector<std::string> question{"audit", "ashikhmin_shirley", "n_u=10", "n_v=200", "--json"};
  std::vector<std::string> one = question, four = question;
  one.insert(one.end(), {"--threads", "1"});
  four.insert(four.end(), {"--threads", "4"});
  const Json first = Json::parse(run_albedo(one).out), second = Json::parse(run_albedo(four).out);
  EXPECT_EQ(first["audits"], second["audits"]);
}

TEST_F(CliTest, AuditThatCannotTellExitsWithThree) {
  const Outcome outcome = run_albedo({"audit", "ggx", "--budget", "30", "--checks", "average"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.out.find("undecided"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.err.find("could not be decided"), std::string::npos) << outcome.err;
}

TEST_F(CliTest, AuditRefusesNonsense) {
  const std::vector<std::vector<std::string>> questions{
      {"audit", "gxx"},
      {"audit", "ward", "alpha=nan"},
      {"audit", "ward", "--checks", "samplerz"},
      {"audit", "ward", "--warp", "paper"},
      {"audit", "ward", "--materials", "nothing.json"},
      {"audit", "--materials", "nothing.json"},
      {"audit", "ward", "-o", "ward.txt"},
      {"audit", "ward", "--json", "-o", "-"},
      {"divergence", "alpha=1"},
      {"divergence", "gxx"},
      {"divergence", "ward", "--tolerance", "-1"},
      {"divergence", "ward", "--phi", "inf"},
  };
  for (const auto& question : questions) {
    const Outcome outcome = run_albedo(question);
    EXPECT_EQ(outcome.code, 2) << question[1];
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
  }
  EXPECT_EQ(run_albedo({"audit", "lambert", "-o", "no/such/folder.csv"}).code, 4);
  EXPECT_TRUE(files().empty());
}

TEST_F(CliTest, DivergenceOfCookTorrance) {
  const Outcome outcome =
      run_albedo({"divergence", "cook_torrance", "m=0.1", "cook_torrance", "m=0.1", "masking=none", "ward", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json results = Json::parse(outcome.out)["results"];
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[0]["limit"]["exponent"], 0);
  EXPECT_NEAR(results[0]["limit"]["constant"], 1, 1e-8);
  EXPECT_TRUE(results[0]["critical"].is_null());
  EXPECT_NEAR(results[1]["limit"]["exponent"], 1, 1e-9);
  EXPECT_NEAR(results[1]["critical"]["theta_deg"], 85.07349349, 1e-6);
  EXPECT_NEAR(results[2]["fit"]["exponent"], 0.5, 1e-5);
  for (const Json& result : results) EXPECT_TRUE(result["agree"]);

  const Outcome all = run_albedo({"divergence"});
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_NE(all.out.find("masking=none"), std::string::npos);
}

}  // namespace
}  // namespace albedo::test
