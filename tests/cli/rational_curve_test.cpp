#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

using Json = nlohmann::ordered_json;

bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// The value of a form's JSON, as its description says.
double value_of(const Json& form, double c) {
  const std::string variable = form["variable"];
  const double d = form["d"], s2 = (1 - c) * (1 + c), s = std::sqrt(s2), slope = c / std::sqrt(c * c + d * s2);
  const std::map<std::string, double> variables{{"c", c},
                                                {"c^(1/2)", std::sqrt(c)},
                                                {"c^(1/4)", std::pow(c, 0.25)},
                                                {"c/(1+s)", c / (1 + s)},
                                                {"c/(c+s)", c / (c + s)},
                                                {"(c+d)^(1/2)", std::sqrt(c + d)},
                                                {"c/(c^2+d*s^2)^(1/2)", slope},
                                                {"1-(1-c/(c^2+d*s^2)^(1/2))^(1/2)", 1 - std::sqrt(1 - slope)}};
  const double x = variables.at(variable);
  double value = form["gain"];
  for (const double zero : form["zeros"]) value *= x - zero;
  for (const Json& pair : form["zero_pairs"]) value *= std::pow(x - pair[0].get<double>(), 2) + pair[1].get<double>();
  for (const double pole : form["poles"]) value /= x - pole;
  for (const Json& pair : form["pole_pairs"]) value /= std::pow(x - pair[0].get<double>(), 2) + pair[1].get<double>();
  return std::pow(value, 1 / form["exponent"].get<double>()) * std::pow(c, form["power"].get<double>() / 2);
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

struct Written {
  std::vector<std::string> model;
  std::string function;
};
const std::vector<Written> written{{{"ward", "alpha=0.3"}, "ward_albedo"},
                                   {{"ggx", "alpha=0.3"}, "ggx_albedo"},
                                   {{"ashikhmin_shirley", "n=100"}, "ashikhmin_shirley_albedo"},
                                   {{"phong", "n=20", "--pump", "2"}, "pumped_albedo"}};

std::vector<std::string> joined(std::vector<std::string> first, const std::vector<std::string>& then) {
  first.insert(first.end(), then.begin(), then.end());
  return first;
}

TEST_F(CliTest, RationalCurveIsCompiledAsCpp) {
  if (!is_installed("c++")) GTEST_SKIP() << "no c++";
  std::string heads, checks;
  for (const auto& [model, function] : written) {
    const std::string file = function + ".hpp";
    ASSERT_EQ(run_albedo(joined(joined({"curve"}, model), {"--form", "rational", "-o", file})).code, 0) << function;
    heads += "#include \"" + file + "\"\n";
    const Outcome at = run_albedo(joined(joined({"at"}, model), {"--theta", "0,7,33,70,89.9,89.99", "--json"}));
    const Json results = Json::parse(at.out)["results"];
    for (const Json& result : results) {
      checks += "  good = good && is_close(" + function + "(std::cos(" + result["theta_deg"].dump() + " * degree)), " +
                result["albedo"].dump() + ", 1e-6) && is_close(" + function + "(float(std::cos(" +
                result["theta_deg"].dump() + " * degree))), " + result["albedo"].dump() + ", 3e-6);\n";
    }
  }
  write_text("main.cpp",
             heads +
                 "bool is_close(double a, double b, double e) { return std::abs(a / b - 1) < e; }\n"
                 "int main() {\n  const double degree = 3.14159265358979323846 / 180;\n  bool good = true;\n" +
                 checks + "  return good ? 0 : 1;\n}\n");
  ASSERT_EQ(std::system("c++ -std=c++17 -Wall -Werror main.cpp -o main"), 0);
  EXPECT_EQ(std::system("./main"), 0);
}

TEST_F(CliTest, RationalCurveIsCompiledAsGlsl) {
  for (const auto& [model, function] : written) {
    const std::string file = function + ".glsl";
    ASSERT_EQ(run_albedo(joined(joined({"curve"}, model), {"--form", "rational", "-o", file})).code, 0) << function;
    const std::string text = read_text(file);
    EXPECT_NE(text.find("float " + function + "(float cos_theta) {"), std::string::npos) << text;
    if (!is_installed("glslangValidator")) GTEST_SKIP() << "no glslangValidator";
    for (const std::string version : {"#version 330\n", "#version 300 es\nprecision highp float;\n"}) {
      write_text("shader.frag", version + "in float cosine;\nout vec4 colour;\n" + text +
                                    "void main() { colour = vec4(" + function + "(cosine)); }\n");
      EXPECT_EQ(std::system("glslangValidator shader.frag >log.txt"), 0) << version << read_text("log.txt");
    }
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
