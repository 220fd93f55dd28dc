#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> ggx{"table", "ggx", "alpha=0.2:1:5", "cos_theta=0.125:1:8", "--tolerance", "1e-6", "-o"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST_F(CliTest, TableWritesEveryFormatAndNothingElse) {
  for (const std::string name : {"t.csv", "t.json", "u.npy", "t.exr", "t.hpp"}) {
    const Outcome outcome = run_albedo(with(ggx, {name}));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "");
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"t.csv", "t.exr", "t.hpp", "t.json", "u.json", "u.npy"}));

  const Json table = Json::parse(read_text("t.json"));
  EXPECT_EQ(table["shape"], (Json{5, 8}));
  const std::string npy = read_text("u.npy");
  ASSERT_GE(npy.size(), 40 * sizeof(double));
  double last = 0;
  std::memcpy(&last, npy.data() + npy.size() - sizeof last, sizeof last);
  EXPECT_EQ(table["albedo"][4][7], last);
  const Imf::InputFile image("t.exr");
  EXPECT_EQ(image.header().dataWindow().max.x, 7);
  EXPECT_EQ(image.header().dataWindow().max.y, 4);
}

TEST_F(CliTest, TableCarriesItsProvenance) {
  ASSERT_EQ(run_albedo(with(ggx, {"t.json", "--errors"})).code, 0);
  const Json table = Json::parse(read_text("t.json"));
  const Json& provenance = table["provenance"];
  EXPECT_EQ(provenance["command"],
            "albedo table ggx alpha=0.2:1:5 cos_theta=0.125:1:8 --tolerance 1e-6 -o t.json --errors");
  EXPECT_EQ(provenance["model"], "ggx");
  EXPECT_EQ(provenance["parameters"]["masking"], "correlated");
  EXPECT_FALSE(provenance["parameters"].contains("alpha_x"));  // varied by an axis
  EXPECT_EQ(provenance["axes"]["alpha"]["count"], 5);
  EXPECT_EQ(provenance["tolerance"], 1e-6);
  EXPECT_EQ(provenance["rule"], "gauss");
  EXPECT_GT(provenance["interpolation_error"], 1e-4);
  double largest = 0;
  for (const Json& row : table["error"]) {
    for (const Json& error : row) largest = std::max(largest, error.get<double>());
  }
  EXPECT_EQ(provenance["largest_error"], largest);
}

TEST_F(CliTest, TableEntriesAreTheAlbedosOfAt) {
  ASSERT_EQ(run_albedo({"table", "ward", "rho_d=0.25", "theta=0,30,60", "alpha=0.1,0.5", "-o", "t.json"}).code, 0);
  const Json table = Json::parse(read_text("t.json"));
  const Json at = Json::parse(run_albedo({"at", "ward", "rho_d=0.25", "alpha=0.5", "--theta", "30", "--json"}).out);
  EXPECT_EQ(table["shape"], (Json{3, 2}));
  EXPECT_NEAR(table["albedo"][1][1].get<double>(), at["results"][0]["albedo"].get<double>(), 1e-8);
}

TEST_F(CliTest, TableHas32TexelCentresUnlessDirectionsAreGiven) {
  ASSERT_EQ(run_albedo({"table", "lambert", "-o", "t.json"}).code, 0);
  const Json axis = Json::parse(read_text("t.json"))["axes"][0];
  EXPECT_EQ(axis["name"], "cos_theta");
  EXPECT_EQ(axis["values"].size(), 32U);
  EXPECT_EQ(axis["values"][0], 0.5 / 32);

  ASSERT_EQ(run_albedo({"table", "ward", "alpha_x=0.1,0.5", "theta=60", "phi=90", "-o", "u.json"}).code, 0);
  const Json fixed = Json::parse(read_text("u.json"));  // a single direction is no axis
  EXPECT_EQ(fixed["shape"], Json{2});
  EXPECT_EQ(fixed["provenance"]["theta"], 60);
  EXPECT_EQ(fixed["provenance"]["phi"], 90);
}

TEST_F(CliTest, TableDoesNotDependOnTheNumberOfThreads) {
  const auto albedos = [](const std::string& threads) {
    EXPECT_EQ(run_albedo(with(ggx, {"t.json", "--threads", threads})).code, 0);
    return Json::parse(read_text("t.json"))["albedo"];
  };
  EXPECT_EQ(albedos("1"), albedos("3"));
}

TEST_F(CliTest, TableSummaryIsOneLineOfJson) {
  const Outcome outcome = run_albedo(with(ggx, {"t.csv", "--summary"}));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "");
  ASSERT_EQ(line_count(outcome.err), 1U);
  const Json summary = Json::parse(outcome.err);
  EXPECT_EQ(summary["entries"], 40);
  EXPECT_EQ(summary["unconverged"], 0);
  EXPECT_EQ(summary["divergent"], 0);
  EXPECT_EQ(summary["output"], "t.csv");
  for (const std::string key : {"worst_error", "interpolation_error", "evaluations", "seconds"}) {
    EXPECT_TRUE(summary[key].is_number()) << key;
  }
}

TEST_F(CliTest, TableAssertions) {
  const auto code = [](const std::string& condition) {
    return run_albedo({"table", "ward", "theta=0:80:9", "-o", "t.csv", "--assert", condition}).code;
  };
  EXPECT_EQ(code("max<=1, min>0, error<=1e-6, at(60)==0.488988056+-1e-7"), 0);
  EXPECT_EQ(code("max<=0.9"), 1);
  EXPECT_EQ(code("at(85)<=1"), 2);  // outside the table
}

TEST_F(CliTest, TableMarksInfiniteEntries) {
  const Outcome outcome = run_albedo({"table", "ward", "theta=0,90", "-o", "t.json", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out)["divergent"], 1);
  EXPECT_TRUE(Json::parse(read_text("t.json"))["albedo"][1].is_null());
}

TEST_F(CliTest, AFailureToWriteHasItsOwnExitCodeAndLeavesNothing) {
  write_text("file.csv", "mine");
  std::filesystem::create_directory("directory.csv");
  std::filesystem::create_symlink("/dev/full", "full.csv");
  const auto before = files();
  for (const std::string path : {"file.csv/t.csv", "directory.csv", "missing/t.csv", "/proc/t.csv", "full.csv"}) {
    const Outcome outcome = run_albedo({"table", "lambert", "-o", path});
    EXPECT_EQ(outcome.code, 4) << path;
    EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
    EXPECT_NE(outcome.err.find("cannot write '" + path + "'"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(files(), before);
  EXPECT_EQ(read_text("file.csv"), "mine");
}

/// The one albedo that `albedo at` answers for these words at an angle.
double albedo_at(const std::vector<std::string>& words, const std::string& theta) {
  std::vector<std::string> line{"at"};
  line.insert(line.end(), words.begin(), words.end());
  const Outcome outcome = run_albedo(with(line, {"--theta", theta, "--json"}));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return Json::parse(outcome.out)["results"][0]["albedo"].get<double>();
}

TEST_F(CliTest, TableOfAChoiceHasAnAxisOfNames) {
  const std::vector<std::string> line{"table",         "ggx",        "masking=correlated,separable",
                                      "alpha=0.1,0.7", "theta=0,80", "-o"};
  for (const std::string name : {"t.csv", "t.json", "u.npy", "t.exr", "t.hpp"}) {
    const Outcome outcome = run_albedo(with(line, {name}));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  const Json table = Json::parse(read_text("t.json"));
  EXPECT_EQ(table["axes"][0]["labels"], (Json{"correlated", "separable"}));
  EXPECT_EQ(table["provenance"]["axes"]["masking"], (Json{{"count", 2}}));
  EXPECT_FALSE(table["provenance"]["parameters"].contains("masking"));
  EXPECT_EQ(table["albedo"][1][1][1], albedo_at({"ggx", "masking=separable", "alpha=0.7"}, "80"));
  EXPECT_EQ(table["albedo"][0][1][1], albedo_at({"ggx", "masking=correlated", "alpha=0.7"}, "80"));
  EXPECT_EQ(Json::parse(read_text("u.json"))["axes"], table["axes"]);
  EXPECT_NE(read_text("t.csv").find("\nseparable,"), std::string::npos);
  const Imf::InputFile image("t.exr");
  EXPECT_NE(image.header().channels().findChannel("masking=separable.Y"), nullptr);
}

TEST_F(CliTest, TableOfASumVariesItsParts) {
  ASSERT_EQ(run_albedo({"table", "sum", "lambert:rho=0.2", "ward:alpha=0.1", "theta=0,60", "-o", "t.json"}).code, 0);
  EXPECT_EQ(Json::parse(read_text("t.json"))["albedo"][1],
            albedo_at({"sum", "lambert:rho=0.2", "ward:alpha=0.1"}, "60"));

  const Outcome outcome = run_albedo({"table", "sum", "lambert", "ward:rho_s=0.3", "1.rho=0.1:0.5:3", "2.alpha=0.1,0.4",
                                      "2.weight=0.5", "theta=0,60", "-o", "u.json", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json table = Json::parse(read_text("u.json"));
  EXPECT_EQ(table["shape"], (Json{3, 2, 2}));
  EXPECT_EQ(table["provenance"]["model"], "sum");
  EXPECT_EQ(table["provenance"]["parameters"]["2.rho_s"], 0.3);
  EXPECT_EQ(table["provenance"]["parameters"]["2.weight"], 0.5);
  EXPECT_FALSE(table["provenance"]["parameters"].contains("1.rho"));
  EXPECT_FALSE(table["provenance"]["parameters"].contains("2.alpha_x"));
  EXPECT_EQ(table["albedo"][2][1][1],
            albedo_at({"sum", "lambert:rho=0.5", "ward:rho_s=0.3,alpha=0.4,weight=0.5"}, "60"));
}

TEST_F(CliTest, TableOfCombinationsIsCorrectedAndHeldAsOthers) {
  const std::vector<std::string> pumped{"sum", "lambert:rho=0.2", "phong:n=20", "--pump", "1"};
  ASSERT_EQ(run_albedo(with(with({"table"}, pumped), {"theta=0,60", "-o", "t.json"})).code, 0);
  EXPECT_EQ(Json::parse(read_text("t.json"))["albedo"][1], albedo_at(pumped, "60"));

  ASSERT_EQ(
      run_albedo({"table", "coupled", "ggx:f0=0.04", "r_m=0,0.5", "surface.alpha=0.2,0.6", "theta=0,60", "-o", "u.npy"})
          .code,
      0);
  const std::string npy = read_text("u.npy");
  double last = 0;
  std::memcpy(&last, npy.data() + npy.size() - sizeof last, sizeof last);
  EXPECT_EQ(last, albedo_at({"coupled", "ggx:f0=0.04,alpha=0.6", "r_m=0.5"}, "60"));
}

TEST_F(CliTest, TableSaysWhatOfACombinationCantVary) {
  const auto refused = [](const std::vector<std::string>& words, const std::string& says) {
    const Outcome outcome = run_albedo(with(with({"table"}, words), {"theta=0,60", "-o", "t.json"}));
    EXPECT_EQ(outcome.code, 2) << says;
    EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
    EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
  };
  refused({"sum", "lambert", "rho=0.1,0.2"}, "begin with their number, such as 1.weight");
  refused({"sum", "lambert", "2.rho=0.1,0.2"}, "sum has no parameter '2.rho'");
  refused({"sum", "lambert:rho=0.2", "1.rho=0.1,0.2"}, "rho is set twice");
  refused({"sum", "lambert", "1.weight=1", "1.weight=2"}, "1.weight is set twice");
  refused({"sum", "lambert", "1.rho=0.1,2"}, "rho is 2");
  refused({"sum", "lambert", "ward", "2.weight=0,-1"}, "weight of part 2 is -1");
  refused({"coupled", "ggx", "alpha=0.1,0.2"}, "such as surface.alpha");
  refused({"coupled", "ggx", "r_m=0,2"}, "r_m is 2");
  refused({"ggx", "masking=separable,separable"}, "has 'separable' twice");
  refused({"ggx", "masking=correlated,separable", "--fill", "proxy"}, "the axis 'masking' holds names");
  EXPECT_TRUE(files().empty());
}

TEST_F(CliTest, MaterialsHaveARowForEveryChannel) {
  write_text("m.jsonl", R"({"name": "grey", "model": "lambert", "parameters": {"rho": 0.5}})"
                        "\n"
                        R"({"name": "gold", "model": "ward", "parameters": {"alpha": 0.1, "rho_s": [1, 0.5, 0.25]}})"
                        "\n");
  const Outcome outcome =
      run_albedo({"table", "--materials", "m.jsonl", "theta=0,60", "-o", "t.json", "--summary", "--errors"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json table = Json::parse(read_text("t.json"));
  EXPECT_EQ(table["shape"], (Json{2, 3, 2}));
  EXPECT_EQ(table["axes"][0]["labels"], (Json{"grey", "gold"}));
  EXPECT_EQ(table["axes"][1]["labels"], (Json{"R", "G", "B"}));
  const double gold = 0.488988056485;  // Ward's model at 60°, from tests/golden/independent.json
  EXPECT_NEAR(table["albedo"][0][2][1].get<double>(), 0.5, 1e-8);
  EXPECT_NEAR(table["albedo"][1][0][1].get<double>(), gold, 1e-8);
  EXPECT_NEAR(table["albedo"][1][2][1].get<double>(), gold / 4, 1e-8);
  EXPECT_GT(Json::parse(outcome.err)["interpolation_error"], 1e-3);
}

TEST_F(CliTest, MaterialsWithoutColourHaveOneChannelAndTenAngles) {
  write_text("m.json", R"([{"name": "grey", "model": "lambert", "parameters": {"rho": 0.5}}])");
  const Outcome outcome =
      run_albedo({"table", "--materials", "m.json", "-o", "t.json", "--assert", "at(50)==0.5+-1e-7, max<0.51"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json table = Json::parse(read_text("t.json"));
  EXPECT_EQ(table["axes"][1]["labels"], Json{"all"});
  EXPECT_EQ(table["axes"][2]["values"], (Json{0, 15, 30, 45, 60, 75, 80, 85, 88, 89}));
}

TEST_F(CliTest, MaterialsMeasuredByNganAreAllConverged) {
  for (const std::string name : {"ngan_ward", "ngan_cook_torrance", "ngan_ashikhmin_shirley"}) {
    const Outcome one = run_albedo(
        {"table", "--materials", ALBEDO_MATERIALS_DIR "/" + name + ".json", "-o", "1.json", "--threads", "1"});
    const Outcome two = run_albedo(
        {"table", "--materials", ALBEDO_MATERIALS_DIR "/" + name + ".json", "-o", "2.json", "--threads", "2"});
    ASSERT_EQ(one.code + two.code, 0) << name << ": " << one.err;
    const Json table = Json::parse(read_text("1.json"));
    EXPECT_EQ(table["albedo"], Json::parse(read_text("2.json"))["albedo"]) << name;
    EXPECT_EQ(table["shape"][0], 86) << name;
    EXPECT_EQ(table["provenance"]["unconverged"], 0) << name;
  }
}

}  // namespace
}  // namespace albedo::test
