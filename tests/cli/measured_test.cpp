#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "measured_files.hpp"

/// Measured materials on the command line: a result for each channel.
namespace albedo::test {
namespace {

using Json = nlohmann::json;

/// f cosθ_V is a constant: the albedo is that times 2π.
class MeasuredCli : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    RglContent content;
    content.rgb = [](std::size_t, int channel, double, double) { return (channel + 1) * 0.1; };
    write_text("material.bsdf", rgl_bytes(content));
  }
  static double albedo(int channel) { return (channel + 1) * 0.1 * std::numbers::pi / 2; }
};

TEST_F(MeasuredCli, AtHasARowForEachChannel) {
  const Outcome outcome = run_albedo({"at", "measured", "file=material.bsdf", "--theta", "0,60", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json object = Json::parse(outcome.out);
  EXPECT_EQ(object["parameters"], Json({{"file", "material.bsdf"}, {"negative", "kept"}}));
  ASSERT_EQ(object["results"].size(), 6U);
  for (int i = 0; i < 6; ++i) {
    const Json& result = object["results"][static_cast<std::size_t>(i)];
    EXPECT_EQ(result["channel"], std::string(1, "RGB"[i / 2]));
    EXPECT_NEAR(result["albedo"].get<double>(), albedo(i / 2), 1e-7);
  }
  const Outcome text = run_albedo({"at", "measured", "file=material.bsdf", "--theta", "30"});
  EXPECT_EQ(line_count(text.out), 4U);
  EXPECT_EQ(text.out.rfind("channel", 0), 0U) << text.out;
}

TEST_F(MeasuredCli, AGivenChannelIsTheOnlyOne) {
  const Outcome outcome = run_albedo({"at", "measured", "file=material.bsdf", "channel=B", "--theta", "30", "--json",
                                      "--assert", "at(30)==0.471238898+-1e-7"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json object = Json::parse(outcome.out);
  EXPECT_EQ(object["parameters"]["channel"], "B");
  ASSERT_EQ(object["results"].size(), 1U);
  EXPECT_FALSE(object["results"][0].contains("channel"));
}

TEST_F(MeasuredCli, ASumHasTheChannelsOfItsParts) {
  const Outcome outcome = run_albedo(
      {"at", "sum", "measured:file=material.bsdf,weight=0.5", "lambert:rho=0.25", "--theta", "10", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json results = Json::parse(outcome.out)["results"];
  ASSERT_EQ(results.size(), 3U);
  EXPECT_NEAR(results[2]["albedo"].get<double>(), albedo(2) / 2 + 0.25, 1e-7);
}

TEST_F(MeasuredCli, CurveHasTheChannelInFront) {
  const Outcome outcome = run_albedo({"curve", "measured", "file=material.bsdf", "--tolerance", "1e-3"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\nchannel,theta_deg,cos_theta,albedo,error\n"), std::string::npos) << outcome.out;
  for (const char* line : {"\nR,0,1,", "\nG,0,1,", "\nB,0,1,"}) {
    EXPECT_NE(outcome.out.find(line), std::string::npos) << outcome.out;
  }
  const Outcome json = run_albedo({"curve", "measured", "file=material.bsdf", "--tolerance", "1e-3", "--json"});
  const Json channels = Json::parse(json.out)["channels"];
  EXPECT_NEAR(channels["G"]["nodes"][0]["albedo"].get<double>(), albedo(1), 1e-3);
  const Outcome one = run_albedo({"curve", "measured", "file=material.bsdf", "channel=G", "--tolerance", "1e-3"});
  EXPECT_NE(one.out.find("\ntheta_deg,"), std::string::npos) << one.out;
}

TEST_F(MeasuredCli, TableHasAChannelAxis) {
  const Outcome outcome = run_albedo({"table", "measured", "file=material.bsdf", "theta=0,45", "-o", "table.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string text = read_text("table.json");
  for (const char* part : {"channel", "\"R\"", "\"G\"", "\"B\"", "0.157079", "0.314159", "0.471238"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  }
  write_text("list.json", R"([{"name": "film", "model": "measured", "parameters": {"file": "material.bsdf"}}])");
  const Outcome list = run_albedo({"table", "--materials", "list.json", "theta=0,45", "-o", "list.csv"});
  ASSERT_EQ(list.code, 0) << list.err;
  EXPECT_NE(read_text("list.csv").find("film,B,"), std::string::npos) << read_text("list.csv");
}

TEST_F(MeasuredCli, ModelsSaysThatAFileIsNeeded) {
  const Outcome outcome = run_albedo({"models", "measured"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("must be given"), std::string::npos) << outcome.out;
  EXPECT_EQ(run_albedo({"models", "--json"}).code, 0);
}

TEST_F(MeasuredCli, WrongInputIsOneLineAndExitCodeTwo) {
  write_text("truncated.bsdf", read_text("material.bsdf").substr(0, 600));
  write_text("empty.bsdf", "");
  std::string huge = read_text("material.bsdf").substr(0, 1000);
  const std::size_t shape = huge.find("theta_i") + 7 + 2 + 1 + 8;
  huge.replace(shape, 8, std::string("\0\0\0\xc0\0\0\0\0", 8));  // 3 · 2^30 numbers in 1000 bytes
  write_text("huge.bsdf", huge);
  std::string merl = merl_bytes({3, 3, 3}, [](int, int, int, int) { return 1.0; });
  merl[0] = '\x5a';
  write_text("wrong.binary", merl);
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"measured"}, "file is not given"},
      {{"measured", "file=none.bsdf"}, "'none.bsdf' does not exist"},
      {{"measured", "file=."}, "is not a file"},
      {{"measured", "file=empty.bsdf"}, "is empty"},
      {{"measured", "file=truncated.bsdf"}, "is truncated"},
      {{"measured", "file=huge.bsdf"}, "3221225472 in a file of 1000 bytes"},
      {{"measured", "file=wrong.binary"}, "as the latter its header has a dimension of 90"},
      {{"measured", "file=material.bsdf", "channel=X"}, "channel is 'X' and must be one of R, G, B"},
      {{"measured", "file=material.bsdf", "file=material.bsdf"}, "file is set twice"},
      {{"measured", "file=material.bsdf", "--assert", "at(10)<1"}, "several channels"}};
  for (const auto& [arguments, message] : cases) {
    std::vector<std::string> all{"at"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    all.insert(all.end(), {"--theta", "10"});
    const Outcome outcome = run_albedo(all);
    EXPECT_EQ(outcome.code, 2) << message;
    EXPECT_EQ(outcome.out, "") << message;
    EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << message << ": " << outcome.err;
  }
  EXPECT_EQ(run_albedo({"curve", "measured", "file=material.bsdf", "-o", "curve.npy"}).code, 2);
}

/// The file of the test and, where there are any, RGL's: what is left of them at every twentieth of their length.
TEST_F(MeasuredCli, TruncatedFilesAreOneLineAndExitCodeTwo) {
  std::vector<std::string> wholes{read_text("material.bsdf")};
  if (const char* directory = std::getenv("ALBEDO_MEASURED_DIR")) {
    for (const auto& entry : std::filesystem::directory_iterator(directory)) {
      if (entry.path().extension() != ".bsdf") continue;
      wholes.push_back(read_text(entry.path()));
      break;
    }
  }
  for (const std::string& whole : wholes) {
    for (std::size_t i = 0; i < 20; ++i) {
      write_text("piece.bsdf", whole.substr(0, whole.size() * i / 20));
      const Outcome outcome = run_albedo({"table", "measured", "file=piece.bsdf", "theta=0,45", "-o", "table.csv"});
      EXPECT_EQ(outcome.code, 2) << i << ": " << outcome.err;
      EXPECT_EQ(outcome.out, "");
      EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
      EXPECT_NE(outcome.err.find("'piece.bsdf'"), std::string::npos) << outcome.err;
      EXPECT_EQ(files(), (std::vector<std::string>{"material.bsdf", "piece.bsdf"}));
    }
  }
}

/// A MERL file has 90, 90, 180 in front: others that would fit are read, none that doesn't.
TEST_F(MeasuredCli, AWrongHeaderOfABinaryIsOneLineAndExitCodeTwo) {
  const auto zeros = [](int, int, int, int) { return 0.5; };
  const std::string whole = merl_bytes({6, 5, 4}, zeros);
  write_text("whole.binary", whole);
  EXPECT_EQ(run_albedo({"at", "measured", "file=whole.binary", "channel=G", "--theta", "0"}).code, 0);
  const std::vector<std::pair<std::array<std::int32_t, 3>, std::string>> cases{
      {{-90, 90, 180}, "a dimension of -90"},        {{0, 5, 4}, "a dimension of 0"}, {{6, 5, 1}, "a dimension of 1"},
      {{90, 90, 180}, "a dimension of 90"},          {{5, 5, 4}, "must have 2412"},   {{6, 6, 4}, "a dimension of 4"},
      {{1 << 30, 4, 4}, "a dimension of 1073741824"}};
  for (const auto& [counts, message] : cases) {
    std::string changed = whole;
    std::memcpy(changed.data(), counts.data(), sizeof counts);
    write_text("wrong.binary", changed);
    const Outcome outcome = run_albedo({"at", "measured", "file=wrong.binary", "--theta", "0"});
    EXPECT_EQ(outcome.code, 2) << message;
    EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << message << ": " << outcome.err;
  }
}

}  // namespace
}  // namespace albedo::test
