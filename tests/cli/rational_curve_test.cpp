#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

using Json = nlohmann::ordered_json;

bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// The value of a form's JSON, as its description says.
double value_of(const Json& form, double cos_theta) {
  const double x = std::pow(cos_theta, 1 / form["root"].get<double>());
  double value = form["gain"].get<double>() * std::pow(x, form["power"].get<double>());
  for (const double zero : form["zeros"]) value *= x - zero;
  for (const Json& pair : form["zero_pairs"]) value *= std::pow(x - pair[0].get<double>(), 2) + pair[1].get<double>();
  for (const double pole : form["poles"]) value /= x - pole;
  for (const Json& pair : form["pole_pairs"]) value /= std::pow(x - pair[0].get<double>(), 2) + pair[1].get<double>();
  return value;
}

TEST_F(CliTest, RationalCurveSaysWhatItIs) {
  const Outcome outcome = run_albedo({"curve", "ward", "alpha=0.3", "--form", "rational", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json printed = Json::parse(outcome.out);
  EXPECT_LE(printed["relative_error"], 1e-6);
  EXPECT_LE(printed["coefficients"], 16);
  EXPECT_EQ(printed["status"], "converged");
  const Json at = Json::parse(run_albedo({"at", "ward", "alpha=0.3", "--theta", "61", "--json"}).out);
  const double albedo = at["results"][0]["albedo"];
  EXPECT_NEAR(value_of(printed["form"], std::cos(61 * M_PI / 180)), albedo, 1e-6 * albedo);
}

TEST_F(CliTest, RationalCurveIsCompiledAsCpp) {
  ASSERT_EQ(run_albedo({"curve", "ggx", "alpha=0.3", "--form", "rational", "-o", "ggx.hpp"}).code, 0);
  if (!is_installed("c++")) GTEST_SKIP() << "no c++";
  const Json at = Json::parse(run_albedo({"at", "ggx", "alpha=0.3", "--theta", "70", "--json"}).out);
  const double albedo = at["results"][0]["albedo"];
  write_text("main.cpp",
             "#include \"ggx.hpp\"\n"
             "int main() {\n"
             "  const double c = std::cos(70 * 3.14159265358979323846 / 180), a = " +
                 std::to_string(albedo) +
                 ";\n"
                 "  const auto is_close = [&](double b, double e) { return std::abs(b / a - 1) < e; };\n"
                 "  return is_close(ggx_albedo(c), 3e-6) && is_close(ggx_albedo(float(c)), 5e-6) ? 0 : 1;\n"
                 "}\n");
  ASSERT_EQ(std::system("c++ -std=c++17 -Wall -Werror main.cpp -o main"), 0);
  EXPECT_EQ(std::system("./main"), 0);
}

TEST_F(CliTest, RationalCurveIsCompiledAsGlsl) {
  ASSERT_EQ(run_albedo({"curve", "ward", "alpha=0.3", "--form", "rational", "-o", "ward.glsl"}).code, 0);
  const std::string text = read_text("ward.glsl");
  EXPECT_NE(text.find("float ward_albedo(float cos_theta) {"), std::string::npos) << text;
  if (!is_installed("glslangValidator")) GTEST_SKIP() << "no glslangValidator";
  for (const std::string version : {"#version 330\n", "#version 300 es\nprecision highp float;\n"}) {
    write_text("shader.frag", version + "in float cosine;\nout vec4 colour;\n" + text +
                                  "void main() { colour = vec4(ward_albedo(cosine)); }\n");
    EXPECT_EQ(std::system("glslangValidator shader.frag >log.txt"), 0) << version << read_text("log.txt");
  }
}

TEST_F(CliTest, RationalCurveThatMissesItsToleranceExitsWith3) {
  const Outcome outcome =
      run_albedo({"curve", "ggx", "--form", "rational", "--coefficients", "3", "-o", "ggx.json", "--assert", "max<=1"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("is off by up to"), std::string::npos) << outcome.err;
  EXPECT_EQ(Json::parse(read_text("ggx.json"))["status"], "budget_exhausted");
}

TEST_F(CliTest, RationalCurveRefusesWrongInput) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"curve", "ggx", "--form", "rational", "-o", "a.csv"},
        {"curve", "ggx", "--form", "rational", "--coefficients", "2"},
        {"curve", "ggx", "--coefficients", "8"},
        {"curve", "ggx", "--form", "ratoinal"},
        {"curve", "ggx", "--form", "rational", "--assert", "at(89.995)<1"}}) {
    const Outcome outcome = run_albedo(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments.back() << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace albedo::test
