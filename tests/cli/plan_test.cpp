#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* wall = R"([{"name": "wall", "model": "lambert", "parameters": {"rho": 0.5}}])";
constexpr const char* mixed = R"([
  {"name": "wall <b>&amp;", "model": "lambert", "parameters": {"rho": [0.5, 0.4, 0.3]}},
  {"name": "gold", "model": "ggx", "parameters": {"alpha": 0.3, "fresnel": "conductor",
    "eta": [0.14, 0.37, 1.44], "k": [3.98, 2.38, 1.6]}},
  {"name": "brushed", "model": "ggx", "parameters": {"alpha_x": 0.1, "alpha_y": 0.5, "f0": 0.9}},
  {"name": "ward", "model": "ward", "parameters": {"alpha": 0.2, "rho_s": 0.3, "rho_d": 0.2}}])";

TEST_F(CliTest, PlanOfALambertianWallIsEmptyAndSaysWhy) {
  write_text("wall.json", wall);
  const Outcome outcome = run_albedo({"plan", "wall.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("needs no table"), std::string::npos);
  EXPECT_NE(outcome.out.find("Lambertian"), std::string::npos);
  const Json plan = Json::parse(run_albedo({"plan", "wall.json", "--json"}).out);
  EXPECT_TRUE(plan["tables"].empty());
  EXPECT_EQ(plan["bytes"], 0);
  EXPECT_EQ(plan["materials"][0]["channels"]["all"]["need"], "nothing");
  EXPECT_EQ(files(), std::vector<std::string>{"wall.json"});
}

TEST_F(CliTest, PlanWritesItsTablesAndItsPage) {
  write_text("mixed.json", mixed);
  const Outcome outcome = run_albedo({"plan", "mixed.json", "--error", "1/255", "-o", "out/plan", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json plan = Json::parse(outcome.out);
  EXPECT_NEAR(plan["error"].get<double>(), 1.0 / 255, 1e-15);
  EXPECT_EQ(plan["materials"].size(), 4U);
  EXPECT_EQ(plan["materials"][1]["channels"].size(), 3U);
  EXPECT_EQ(plan["materials"][2]["channels"]["all"]["isotropic_suffices"], false);
  EXPECT_LE(plan["verified_error"]["furnace"].get<double>(), 1.0 / 255);
  EXPECT_LE(plan["verified_error"]["point"].get<double>(), 1.0 / 255);
  EXPECT_GE(plan["usual_bytes"].get<double>(), 20 * plan["bytes"].get<double>());
  EXPECT_EQ(Json::parse(read_text("out/plan/plan.json")), plan);
  ASSERT_FALSE(plan["tables"].empty());
  for (const Json& table : plan["tables"]) {
    const std::string stem = "out/plan/" + table["name"].get<std::string>();
    for (const char* ending : {".exr", ".npy", ".json", ".hpp"}) {
      EXPECT_TRUE(std::filesystem::is_regular_file(stem + ending)) << stem << ending;
    }
    const Json document = Json::parse(read_text(stem + ".json"));
    EXPECT_EQ(document["axes"].back()["values"], table["cos_theta"]);
    EXPECT_EQ(document["provenance"]["bytes"], table["bytes"]);
  }
  const std::string page = read_text("out/plan/plan.html");
  EXPECT_NE(page.find("wall &lt;b&gt;&amp;amp;"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_FALSE(std::regex_search(page, std::regex("(https?:)?//[a-z]|url\\("))) << "the page asks for something";
}

TEST_F(CliTest, PlanTakesNumbersAndFractions) {
  write_text("metal.json", R"([{"name": "metal", "model": "ggx", "parameters": {"alpha": 0.6}}])");
  const auto bytes = [](const std::string& error) {
    const Outcome outcome = run_albedo({"plan", "metal.json", "--error", error, "--json", "--pumpings", "0"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out)["bytes"].get<int>();
  };
  EXPECT_EQ(bytes("0.015625"), bytes("1/64"));
  EXPECT_LT(bytes("1/16"), bytes("1/64"));
  EXPECT_LT(bytes("1/64"), bytes("1/1023"));
}

TEST_F(CliTest, PlanRefusesWhatItCantRead) {
  write_text("wall.json", wall);
  write_text("bad.json", R"([{"name": "a", "model": "ggx", "parameters": {"alpha": -1}}])");
  write_text("nan.json", R"([{"name": "a", "model": "ggx", "parameters": {"alpha": NaN}}])");
  write_text("scene.txt", "<scene/>");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"plan"},
                                             {"plan", "missing.json"},
                                             {"plan", "bad.json"},
                                             {"plan", "nan.json"},
                                             {"plan", "scene.txt"},
                                             {"plan", "wall.json", "--error", "0"},
                                             {"plan", "wall.json", "--error", "1/0"},
                                             {"plan", "wall.json", "--error", "nan"},
                                             {"plan", "wall.json", "--error", "1/255/2"},
                                             {"plan", "wall.json", "--error", "-1/255"},
                                             {"plan", "wall.json", "--angles", "85"},
                                             {"plan", "wall.json", "--angles", "0:90"},
                                             {"plan", "wall.json", "--angles", "50:40"},
                                             {"plan", "wall.json", "--angles", "0:inf"},
                                             {"plan", "wall.json", "--pumpings", "-1"},
                                             {"plan", "wall.json", "--eror", "1"}}) {
    const Outcome outcome = run_albedo(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments.back() << ": " << outcome.err;
    EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  write_text("file", "");
  EXPECT_EQ(run_albedo({"plan", "wall.json", "-o", "file"}).code, 4);
  EXPECT_EQ(run_albedo({"plan", "wall.json", "-o", "/proc/plan"}).code, 4);
}

TEST_F(CliTest, PlanSaysWhatHasNoTable) {
  write_text("m.json", R"([{"name": "below", "model": "lafortune", "parameters": {"c_x": 0, "c_y": 0, "c_z": -1}},
                           {"name": "metal", "model": "ggx", "parameters": {}}])");
  const Outcome outcome = run_albedo({"plan", "m.json", "--json"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
  const Json plan = Json::parse(outcome.out);
  EXPECT_EQ(plan["materials"][0]["channels"]["all"]["need"], "unknown");
  EXPECT_EQ(plan["materials"][1]["channels"]["all"]["need"], "curve");
}

/// Opens the page in a browser that measures its figures and reports what goes to its console.
TEST_F(CliTest, PlanPageIsWholeInABrowser) {
  if (std::system("command -v chromium > /dev/null 2>&1") != 0) GTEST_SKIP() << "chromium isn't installed";
  write_text("mixed.json", mixed);
  ASSERT_EQ(run_albedo({"plan", "mixed.json", "-o", "."}).code, 0);
  std::string page = read_text("plan.html");
  const std::string measure =
      "<script>const charts = [...document.querySelectorAll('svg')];"
      "const seen = charts.filter(s => { const b = s.getBoundingClientRect(), c = getComputedStyle(s);"
      " return b.width > 100 && b.height > 50 && b.left >= 0 && b.right <= innerWidth && c.visibility === 'visible'"
      " && s.querySelectorAll('polyline').length > 0 && [...s.querySelectorAll('polyline')].every("
      "p => p.getBBox().width > 10 && getComputedStyle(p).stroke !== 'none'); });"
      "document.body.dataset.charts = charts.length; document.body.dataset.seen = seen.length;"
      "document.body.dataset.wide = document.documentElement.scrollWidth > innerWidth;</script></body>";
  page.replace(page.find("</body>"), 7, measure);
  write_text("measured.html", page);
  const std::string command =
      "HOME=$PWD timeout 100 chromium --headless --no-sandbox --disable-gpu --user-data-dir=$PWD/profile "
      "--window-size=1200,900 --enable-logging=stderr --virtual-time-budget=2000 --dump-dom file://$PWD/measured.html "
      "> dom.html 2> log.txt";
  ASSERT_EQ(std::system(command.c_str()), 0) << read_text("log.txt");
  EXPECT_EQ(read_text("log.txt").find("CONSOLE"), std::string::npos) << read_text("log.txt");
  const std::string dom = read_text("dom.html");
  const std::size_t charts = 2 * Json::parse(read_text("plan.json"))["tables"].size();
  EXPECT_NE(dom.find("data-charts=\"" + std::to_string(charts) + '"'), std::string::npos);
  EXPECT_NE(dom.find("data-seen=\"" + std::to_string(charts) + '"'), std::string::npos);
  EXPECT_NE(dom.find("data-wide=\"false\""), std::string::npos) << "the page is wider than its window";
}

TEST_F(CliTest, TableGrowsUntilItIsGoodEnough) {
  const auto summary = [](const std::string& error, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"table",       "ggx", "alpha=0.1:1:2", "cos_theta=0.05:1:2", "-o", "t.json",
                                       "--max-error", error, "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_albedo(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out);
  };
  const Json coarse = summary("0.02"), fine = summary("0.002");
  EXPECT_LT(coarse["entries"], fine["entries"]);
  EXPECT_LE(fine["interpolation_error"].get<double>(), 0.002);
  const Json held = summary("0.01", {"--bits", "8"});
  EXPECT_LE(held["interpolation_error"].get<double>(), 0.01);
  const Json table = Json::parse(read_text("t.json"));
  EXPECT_EQ(table["provenance"]["bits"], 8);
  EXPECT_GT(table["provenance"]["quantisation_error"].get<double>(), 1e-4);
  for (const Json& row : table["albedo"]) {
    for (const Json& entry : row) EXPECT_NEAR(std::remainder(entry.get<double>() * 255, 1), 0, 1e-9);
  }
}

TEST_F(CliTest, TableSaysWhenItCantGrowSoFar) {
  const auto code = [](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"table", "ward", "-o", "t.csv"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_albedo(arguments).code;
  };
  EXPECT_EQ(code({"theta=0,60", "--max-error", "0.001", "--bits", "8"}), 3);  // rounding alone is more
  EXPECT_NE(run_albedo({"table", "ward", "theta=0,60", "--max-error", "0.001", "--bits", "8", "-o", "t.csv"})
                .err.find("8 bits alone by 0.00196"),
            std::string::npos);
  EXPECT_EQ(code({"theta=0,90", "--max-error", "0.01"}), 3);  // infinite at 90 degrees
  EXPECT_EQ(code({"theta=0,60", "--max-error", "0"}), 2);
  EXPECT_EQ(code({"theta=0,60,30", "--max-error", "0.1"}), 2);
  EXPECT_EQ(code({"theta=0,60", "--bits", "12"}), 2);
}

TEST_F(CliTest, TablesOfMaterialsGrowToo) {
  const Outcome outcome = run_albedo({"table", "--materials", ALBEDO_MATERIALS_DIR "/ngan_ward.json", "theta=0,80",
                                      "--max-error", "0.005", "--bits", "16", "-o", "t.npy", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json summary = Json::parse(outcome.out);
  EXPECT_GT(summary["entries"], 86 * 3 * 2);
  EXPECT_LE(summary["interpolation_error"].get<double>(), 0.005);
}

}  // namespace
}  // namespace albedo::test
