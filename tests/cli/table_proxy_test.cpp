#include <cstring>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

using Json = nlohmann::ordered_json;

TEST_F(CliTest, ProxyTableIsTheDirectOne) {
  const std::vector<std::string> axes{"alpha=0.2:1:20", "cos_theta=0.05:1:30"};
  const auto table = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> arguments{"table", "ggx", axes[0], axes[1], "-o", name, "--summary"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_albedo(arguments);
  };
  const Outcome direct = table("direct.json", {});
  const Outcome proxy = table("proxy.json", {"--fill", "proxy", "--tolerance", "1e-5", "--verify", "50"});
  ASSERT_EQ(direct.code, 0) << direct.err;
  ASSERT_EQ(proxy.code, 0) << proxy.err;
  const Json summary = Json::parse(proxy.err);
  EXPECT_LE(summary["proxy"]["relative_error"], 1e-5);
  EXPECT_EQ(summary["proxy"]["verified_places"], 50);
  const Json a = Json::parse(read_text("direct.json")), b = Json::parse(read_text("proxy.json"));
  const Json flat_a = a["albedo"].flatten(), flat_b = b["albedo"].flatten();
  ASSERT_EQ(flat_a.size(), 600U);
  ASSERT_EQ(flat_b.size(), 600U);
  for (const auto& [key, value] : flat_a.items()) {
    EXPECT_NEAR(value.get<double>(), flat_b[key].get<double>(), 1.5e-5) << key;
  }
}

TEST_F(CliTest, ProxyTableInTilesIsTheOneInMemory) {
  const auto table = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "table", "ggx", "alpha=0.2:1:60", "cos_theta=0.05:1:50", "--fill", "proxy", "--verify", "20", "-o", name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_albedo(arguments);
  };
  ASSERT_EQ(table("memory.json", {}).code, 0);
  const Json entries = Json::parse(read_text("memory.json"))["albedo"].flatten();
  for (const std::string tile : {"7", "64", "3000"}) {
    const Outcome outcome = table("tiles.npy", {"--tile", tile, "--summary"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_LE(Json::parse(outcome.err)["proxy"]["relative_error"], 1e-6);
    const std::string bytes = read_text("tiles.npy");
    const std::size_t header = bytes.size() - 3000 * sizeof(double);
    for (std::size_t i = 0; i < 3000; ++i) {
      double entry = 0;
      std::memcpy(&entry, bytes.data() + header + i * sizeof entry, sizeof entry);
      ASSERT_EQ(entry, entries["/" + std::to_string(i / 50) + "/" + std::to_string(i % 50)].get<double>()) << i;
    }
  }
}

TEST_F(CliTest, ProxyTableSaysWhereItMissesItsTolerance) {
  const Outcome outcome =
      run_albedo({"table", "kurt", "m=0.1:0.5:9", "equation=9", "cos_theta=0.05:1:9", "-o", "k.json", "--fill", "proxy",
                  "--tolerance", "1e-12", "--verify", "10", "--budget", "2000"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("--fill proxy bounds no error"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("81 of 81 results did not reach the tolerance"), std::string::npos) << outcome.err;
  const Outcome in_tiles =
      run_albedo({"table", "kurt", "m=0.1:0.5:9", "equation=9", "cos_theta=0.05:1:9", "-o", "k.npy", "--fill", "proxy",
                  "--tolerance", "1e-12", "--verify", "10", "--budget", "2000"});
  EXPECT_EQ(in_tiles.code, 3) << in_tiles.err;
  EXPECT_EQ(in_tiles.err, outcome.err);
}

TEST_F(CliTest, ProxyTableReachesItsToleranceAcrossAKink) {
  const auto table = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"table", "cook_torrance", "m=0.3:0.5:40", "cos_theta=0.1:1:60", "-o", name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_albedo(arguments);
  };
  ASSERT_EQ(table("direct.json", {"--tolerance", "1e-7"}).code, 0);
  const Outcome proxy = table("proxy.json", {"--fill", "proxy", "--verify", "50"});
  ASSERT_EQ(proxy.code, 0) << proxy.err;
  const Json a = Json::parse(read_text("direct.json"))["albedo"].flatten(),
             b = Json::parse(read_text("proxy.json"))["albedo"].flatten();
  for (const auto& [key, value] : a.items()) EXPECT_NEAR(value.get<double>(), b[key].get<double>(), 1.1e-6) << key;
}

TEST_F(CliTest, ProxyTableOfAnInfiniteAlbedoIsRefused) {
  const Outcome outcome = run_albedo(
      {"table", "ward", "alpha=0.2:0.5:20", "cos_theta=0:1:20", "-o", "w.json", "--fill", "proxy", "--verify", "10"});
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("needs finite albedos"), std::string::npos) << outcome.err;
  EXPECT_TRUE(files().empty());
}

TEST_F(CliTest, ProxyTableRefusesWrongInput) {
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--errors"}, {"--max-error", "1e-3"}, {"--verify", "0"}, {"cos_theta=0:1:5"}}) {
    std::vector<std::string> arguments{"table", "ward", "alpha=0.2:0.5:3", "-o", "a.json", "--fill", "proxy"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_albedo(arguments);
    EXPECT_EQ(outcome.code, 2) << more.front() << outcome.err;
  }
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace albedo::test
