#include "albedo/shader_tables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <random>

#include "shader/corrections.hpp"

namespace albedo::analysis {
namespace {

using Evaluate = std::function<double(const ShaderTable& table, double f, double cos_l, double cos_v)>;

/// The shader's code on the exported numbers against the library's model, relative to f* where f isn't negligible.
void expect_same(const std::string& name, const Parameters& parameters, const Corrections& corrections,
                 const Evaluate& evaluate) {
  const auto base = make_model(name, parameters);
  const auto corrected = corrections.applied_to(make_model(name, parameters));
  const ShaderTable table = tabulate(shader_functions(make_model(name, parameters), corrections), 0, 1e-7);
  EXPECT_LE(table.error, 1e-7) << name;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < 500; ++i) {
    const double cos_l = 1 - unit(random), cos_v = i % 3 == 0 ? cos_l : 1 - unit(random);
    const Direction l = Direction::from_cosine(cos_l), v = Direction::from_cosine(cos_v, 360 * unit(random));
    const double f = brdf<double>(*base, l, v), exact = brdf<double>(*corrected, l, v);
    EXPECT_NEAR(evaluate(table, f, cos_l, cos_v), exact, 1e-6 * std::max(f, exact))
        << name << ' ' << cos_l << ' ' << cos_v;
  }
}

int size(const ShaderTable& table) { return static_cast<int>(table.size); }

TEST(ShaderTables, PumpingIsTheLibrarys) {
  for (const auto& [control, of_shader] : {std::pair{PumpControl::none, shader::Control::none},
                                           {PumpControl::step, shader::Control::step},
                                           {PumpControl::total, shader::Control::total}}) {
    const auto pumped = [of_shader = of_shader](const ShaderTable& table, double f, double cos_l, double cos_v) {
      return f * shader::pumping(table.values.data(), 2, size(table), cos_l, cos_v, of_shader);
    };
    expect_same("ggx", {{"alpha", 0.5}}, {.pump = {.times = 2, .control = control}}, pumped);
    expect_same("phong", {{"n", 20.0}}, {.pump = {.times = 2, .control = control}}, pumped);
  }
}

TEST(ShaderTables, CorrectionsAreTheLibrarys) {
  const Parameters rough{{"alpha", 0.5}};
  expect_same("ggx", rough, {.correct = Correction::balance},
              [](const ShaderTable& table, double f, double cos_l, double cos_v) {
                return f * shader::balance(table.values.data(), size(table), cos_l, cos_v);
              });
  expect_same("ggx", rough, {.correct = Correction::multiscatter, .rho = 0.8},
              [](const ShaderTable& table, double f, double cos_l, double cos_v) {
                return f + shader::multiscatter(table.values.data(), size(table), cos_l, cos_v);
              });
  expect_same("ggx", rough, {.correct = Correction::turquin, .rho = 0.8},
              [](const ShaderTable& table, double f, double cos_l, double) {
                return f * shader::turquin(table.values.data(), size(table), cos_l, 0.8);
              });
}

TEST(ShaderTables, PumpingThenBalanceHasAFunctionForEach) {
  const auto functions = shader_functions(make_model("phong"), {.pump = {.times = 2}, .correct = Correction::balance});
  ASSERT_EQ(functions.size(), 3U);
  EXPECT_EQ(functions[0].name, "1/a_0");
  EXPECT_EQ(functions[1].name, "1/a_1");
  EXPECT_EQ(functions[2].name, "1/s");
}

TEST(ShaderTables, TheDocumentHasTheCodeThatIsTested) {
  const auto text_of = [](const std::string& path) {
    std::ifstream file(ALBEDO_MATERIALS_DIR "/../../" + path);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string document = text_of("doc/corrections.md");
  for (const char* const name : {"examples/shader/corrections.hpp", "examples/shader/corrections.glsl"}) {
    const std::string code = text_of(name);
    EXPECT_GT(code.size(), 500U) << name;
    EXPECT_NE(document.find(code), std::string::npos) << name;
  }
}

TEST(ShaderTables, GrowUntilTheyAreGoodEnough) {
  const auto functions = shader_functions(make_model("phong"), {.pump = {.times = 1}});
  const ShaderTable coarse = tabulate(functions, 0, 1e-3), fine = tabulate(functions, 0, 1e-6);
  EXPECT_LT(coarse.size, fine.size);
  EXPECT_LE(fine.error, 1e-6);
  EXPECT_EQ(tabulate(functions, 100, 1e-6).size, 100U);
}

}  // namespace
}  // namespace albedo::analysis
