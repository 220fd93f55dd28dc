#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

using Json = nlohmann::ordered_json;

TEST_F(CliTest, EveryHelpEndsWithAnExampleThatWorks) {
  for (const std::string command : {"", "models", "at", "curve", "table", "pump", "tradeoff", "stability", "plan"}) {
    const Outcome outcome = command.empty() ? run_albedo({"--help"}) : run_albedo({command, "--help"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.rfind("Example"), std::string::npos) << command;
    EXPECT_NE(outcome.out.rfind("\n  albedo " + command), std::string::npos) << command;
  }
  EXPECT_EQ(run_albedo({"at", "ward", "alpha=0.1", "--theta", "0,60,89.9", "--assert", "at(60)==0.488988+-1e-6"}).code,
            0);
}

TEST_F(CliTest, VersionIsOneLine) {
  const Outcome outcome = run_albedo({"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.out.starts_with("albedo ")) << outcome.out;
  EXPECT_EQ(line_count(outcome.out), 1U);
}

TEST_F(CliTest, ModelsSaysEverythingAboutAModel) {
  const Json ward = Json::parse(run_albedo({"models", "ward", "--json"}).out);
  EXPECT_EQ(ward["name"], "ward");
  EXPECT_EQ(ward["shorthands"]["alpha"], (Json{"alpha_x", "alpha_y"}));
  EXPECT_EQ(ward["parameters"][0]["name"], "alpha_x");
  EXPECT_EQ(ward["parameters"][0]["default"], 0.1);
  EXPECT_EQ(ward["parameters"][0]["range"].size(), 2U);
  EXPECT_TRUE(ward["claims"]["reciprocal"]);
  EXPECT_FALSE(ward["claims"]["bounded"]);

  const std::string text = run_albedo({"models", "ward"}).out;
  for (const std::string part :
       {"Ward 1992", "Walter 2005", "deviation", "alpha_x=0.1", "roughness along x", "alpha sets"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

TEST_F(CliTest, ModelsListsTheSameModelsInEveryForm) {
  const Json list = Json::parse(run_albedo({"models", "--json"}).out);
  const std::string text = run_albedo({"models"}).out;
  const std::string markdown = run_albedo({"models", "--markdown"}).out;
  EXPECT_GE(list.size(), 12U);
  EXPECT_EQ(line_count(markdown), list.size() + 2);
  for (const Json& model : list) {
    const auto name = model["name"].get<std::string>();
    EXPECT_NE(markdown.find("| `" + name + "` |"), std::string::npos) << name;
    EXPECT_NE(("\n" + text).find("\n" + name + ": "), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace albedo::test
