#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

using Json = nlohmann::ordered_json;

TEST_F(CliTest, ShaderTablesOfASumAndOfNames) {
  const std::string sum =
      run_albedo({"shader", "sum", "lambert:rho=0.2", "phong", "2.n=1,30", "--pump", "1", "-o", "s.json"}).err;
  EXPECT_EQ(sum, "");
  EXPECT_NE(read_text("s.json").find("\"2.n\""), std::string::npos);
  const std::string names =
      run_albedo({"shader", "ggx", "masking=correlated,separable", "--correct", "balance", "-o", "n.json"}).err;
  EXPECT_EQ(names, "");
  EXPECT_NE(read_text("n.json").find("[\"correlated\", \"separable\"]"), std::string::npos);
}

TEST_F(CliTest, ShaderWritesAFunctionForEachStep) {
  const Outcome outcome = run_albedo(
      {"shader", "phong", "n=10,20,40", "--pump", "2", "--resolution", "128", "--json", "--output", "phong.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out)["functions"], Json({"1/a_0", "1/a_1"}));
  const Json table = Json::parse(read_text("phong.json"));
  EXPECT_EQ(table["axes"].size(), 3U);
  ASSERT_EQ(table["factor"].size(), 2U);
  ASSERT_EQ(table["factor"][0].size(), 3U);
  ASSERT_EQ(table["factor"][0][1].size(), 128U);
  EXPECT_NEAR(table["factor"][0][1][127].get<double>(), 1, 1e-7);  // Phong's albedo at normal incidence
  for (const char* name : {"t.exr", "t.npy", "t.hpp", "t.csv"}) {
    EXPECT_EQ(run_albedo({"shader", "ggx", "alpha=0.5", "--correct", "balance", "--resolution", "8", "-o", name}).code,
              0);
  }
}

TEST_F(CliTest, ShaderCodeIsGlsl) {
  if (std::system("command -v glslangValidator >/dev/null") != 0) GTEST_SKIP() << "glslangValidator isn't installed";
  write_text("shader.frag", "#version 330\nout vec4 colour;\nuniform sampler2D functions;\n" +
                                read_text(ALBEDO_MATERIALS_DIR "/../../examples/shader/corrections.glsl") +
                                "void main() {\n"
                                "  colour = vec4(pumping(functions, 3, 0.5, 0.6), balance(functions, 0.1, 0.2),\n"
                                "                multiscatter(functions, 0.1, 0.2), turquin(functions, 0.3, 1.0));\n"
                                "}\n");
  EXPECT_EQ(std::system("glslangValidator shader.frag >log.txt"), 0) << read_text("log.txt");
}

TEST_F(CliTest, ShaderSaysWhatItCant) {
  EXPECT_EQ(run_albedo({"shader", "ggx", "-o", "t.csv"}).code, 2);
  EXPECT_EQ(run_albedo({"shader", "ggx", "theta=3", "--pump", "1", "-o", "t.csv"}).code, 2);
  EXPECT_EQ(run_albedo({"shader", "ggx", "--pump", "1", "--resolution", "1", "-o", "t.csv"}).code, 2);
  EXPECT_EQ(run_albedo({"shader", "ggx", "--pump", "1", "-o", "no/such/folder/t.csv"}).code, 4);
  const Outcome coarse =
      run_albedo({"shader", "phong", "--pump", "1", "--error", "1e-9", "--resolution", "64", "-o", "t.csv"});
  EXPECT_EQ(coarse.code, 0) << coarse.err;
  EXPECT_NE(coarse.out.find("interpolation error"), std::string::npos);
}

TEST_F(CliTest, TablesOfCorrectedModels) {
  EXPECT_EQ(run_albedo({"table", "phong", "n=5,20", "theta=0,60,89", "--pump", "2", "-o", "t.csv", "--assert",
                        "max<=1, min>0.6"})
                .code,
            0);
  const Json of_file = [] {
    run_albedo(
        {"table", "ggx", "alpha=0.3,0.6", "theta=0,60,89", "--correct", "balance", "--rho", "0.5", "-o", "t.json"});
    return Json::parse(read_text("t.json"));
  }();
  ASSERT_EQ(of_file["albedo"].size(), 2U);
  for (const Json& row : of_file["albedo"]) {
    for (const Json& value : row) EXPECT_NEAR(value.get<double>(), 0.5, 1e-6);
  }
  EXPECT_EQ(of_file["provenance"]["corrections"]["correct"], "balance");
}

TEST_F(CliTest, CorrectedModelsAreModels) {
  EXPECT_EQ(run_albedo({"at", "ggx", "alpha=0.5", "--correct", "balance", "--theta", "0,60,89", "--assert",
                        "max<=1, min>=0.999999999", "--tolerance", "1e-10"})
                .code,
            0);
  EXPECT_EQ(run_albedo({"at", "ggx", "alpha=0.5", "--correct", "multiscatter", "--rho", "0.5", "--theta", "60",
                        "--assert", "at(60)<0.99, at(60)>0.8"})
                .code,
            0);
  const Outcome audit = run_albedo({"audit", "phong", "--correct", "turquin", "--checks", "reciprocity", "--json"});
  EXPECT_EQ(audit.code, 0) << audit.err;
  EXPECT_EQ(Json::parse(audit.out)["audits"][0]["reciprocity"]["verdict"], "not claimed");
  const Json pump = Json::parse(
      run_albedo({"pump", "ggx", "alpha=0.5", "--times", "1", "--correct", "balance,turquin", "--json"}).out);
  EXPECT_NEAR(pump["corrections"]["balance"]["smallest"].get<double>(), 1, 1e-7);
  EXPECT_NEAR(pump["corrections"]["turquin"]["average"].get<double>(), 1, 1e-7);
  EXPECT_LT(pump["corrections"]["balance"]["iterations"].get<int>(), 100);
}

}  // namespace
}  // namespace albedo::test
