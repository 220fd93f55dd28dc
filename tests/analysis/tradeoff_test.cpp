#include "analysis/studies/tradeoff.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "albedo/core/errors.hpp"
#include "analysis/studies/tradeoff_writer.hpp"

namespace albedo::analysis {
namespace {

/// Two materials in two directions: seconds of work.
TradeoffRequest small_request() {
  TradeoffRequest request = default_tradeoff(1e-8, 1e-2);
  request.materials = {{"ward", "smooth", {{"alpha", 0.1}}}, {"phong", "rough", {{"n", 20.0}}}};
  request.thetas = {0, 60};
  request.budget = 50'000;
  request.repeats = 1;
  request.reference_tolerance = 1e-12;
  return request;
}

const Tradeoff& small_study() {
  static const Tradeoff study = measure_tradeoff(small_request());
  return study;
}

TEST(TradeoffStudy, MeasuresEveryRuleOnEveryWarp) {
  EXPECT_EQ(small_study().methods().size(), 21U);
  EXPECT_EQ(small_study().cells.size(), 4U);
  EXPECT_EQ(small_study().unconverged(), 0U);
  for (const TradeoffCell& cell : small_study().cells) {
    for (const TradeoffRun& run : cell.runs) {
      EXPECT_GT(run.seconds, 0);
      EXPECT_LE(run.estimate.evaluations, 50'000);
    }
  }
}

TEST(TradeoffStudy, TrueErrorOfGaussFallsWithTheToleranceAndStaysBelowIt) {
  for (const TradeoffCell& cell : small_study().cells) {
    double last = 1, first = 0;
    std::size_t count = 0;
    for (const TradeoffRun& run : cell.runs) {
      if (run.method != Method{}) continue;
      EXPECT_EQ(run.estimate.status, Status::converged);
      EXPECT_LE(run.true_error, run.tolerance);
      if (count++ == 0) first = run.true_error;
      last = run.true_error;
    }
    EXPECT_EQ(count, small_study().request.tolerances.size());
    EXPECT_LE(last, 1e-8);
    EXPECT_LE(last, first);
    EXPECT_NE(cell.reaching({}, 1e-8), nullptr);
  }
}

TEST(TradeoffStudy, ReportsAtLeastTheTrueErrorWhereItClaimsConvergence) {
  std::size_t claims = 0;
  for (const TradeoffCell& cell : small_study().cells) {
    for (const TradeoffRun& run : cell.runs) {
      if (run.estimate.status != Status::converged || is_monte_carlo(run.method.rule)) continue;
      EXPECT_LE(run.true_error, run.reported_error + cell.slack());
      EXPECT_FALSE(run.wrong(cell.slack()));
      ++claims;
    }
  }
  EXPECT_GT(claims, 100U);
}

TEST(TradeoffStudy, MonteCarloIsWithinItsStandardErrors) {
  for (const TradeoffCell& cell : small_study().cells) {
    for (const TradeoffRun& run : cell.runs) {
      if (!is_monte_carlo(run.method.rule)) continue;
      EXPECT_FALSE(run.wrong(cell.slack())) << run.true_error;
    }
  }
}

TEST(TradeoffStudy, EndsALadderThatIsStuck) {
  TradeoffRequest request = small_request();
  request.materials = {{"ward", "", {{"alpha", 0.1}}}};
  request.thetas = {60};
  request.rules = {Rule::monte_carlo};
  request.warps = {Warp::lobe};
  request.random_tolerances = {1e-1, 1e-7, 1e-8, 1e-9};
  request.budget = 5000;
  const Tradeoff study = measure_tradeoff(request);
  ASSERT_EQ(study.cells.at(0).runs.size(), 2U);
  EXPECT_EQ(study.cells[0].runs[1].estimate.status, Status::budget_exhausted);
}

TEST(TradeoffStudy, LeavesOutTheWarpThatAModelHasNoSamplerFor) {
  TradeoffRequest request = small_request();
  request.materials = usual_materials("he_torrance");
  request.thetas = {0};
  request.rules = {Rule::gauss};
  const Tradeoff study = measure_tradeoff(request);
  EXPECT_EQ(study.methods(), (std::vector<Method>{{Rule::gauss, Warp::lobe}, {Rule::gauss, Warp::hemisphere}}));
}

/// A cell whose runs have these true errors.
TradeoffCell cell_of(const std::vector<double>& true_errors) {
  TradeoffCell cell{.reference = {.value = 1}};
  for (const double error : true_errors) {
    cell.runs.push_back({.true_error = error, .seconds = static_cast<double>(cell.runs.size() + 1)});
  }
  return cell;
}

TEST(TradeoffStudy, CountsATargetAsReachedOnlyWhereItStaysReached) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(cell_of({1e-2, 1e-5, 1e-3, 1e-6, 1e-7}).reaching({}, 1e-4)->seconds, 4);  // the second was luck
  EXPECT_EQ(cell_of({1e-2, 1e-3}).reaching({}, 1e-4), nullptr);
  EXPECT_EQ(cell_of({1e-5, nan}).reaching({}, 1e-4), nullptr);
  EXPECT_EQ(cell_of({1e-5}).reaching({Rule::sobol, Warp::lobe}, 1e-4), nullptr);

  Tradeoff study{.request = default_tradeoff(), .cells = {cell_of({1e-5}), cell_of({1e-2, 1e-5}), cell_of({1e-2})}};
  const MethodSummary summary = summary_of(study, {}, 1e-4);
  EXPECT_EQ(summary.cells, 3U);
  EXPECT_EQ(summary.reached, 2U);
  EXPECT_EQ(summary.seconds, 2);  // of 1, 2 and never
  EXPECT_EQ(summary.ratio, 1);
}

TEST(TradeoffStudy, KnowsWhatIsWrong) {
  TradeoffRun run{.estimate = {.status = Status::converged}, .true_error = 3e-6, .reported_error = 1e-6};
  EXPECT_TRUE(run.wrong(0));
  EXPECT_FALSE(run.wrong(2e-6));
  run.method.rule = Rule::stratified;  // within four standard errors
  EXPECT_FALSE(run.wrong(0));
  run.true_error = 5e-6;
  EXPECT_TRUE(run.wrong(0));
  run.true_error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(run.wrong(0));
  run.estimate.status = Status::budget_exhausted;
  EXPECT_FALSE(run.wrong(0));
}

TEST(TradeoffStudy, RefusesGrazingIncidence) {
  TradeoffRequest request = small_request();
  request.thetas = {90};
  EXPECT_THROW(measure_tradeoff(request), ParameterError);
}

TEST(TradeoffStudy, IsWrittenWithOneLineARun) {
  std::ostringstream out;
  write_csv(describe(small_study().request), small_study(), out);
  std::size_t runs = 0, lines = 0, columns = 0;
  for (const TradeoffCell& cell : small_study().cells) runs += cell.runs.size();
  std::istringstream in(out.str());
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("# ")) continue;
    const auto commas = static_cast<std::size_t>(std::ranges::count(line, ','));
    if (lines++ == 0) columns = commas;
    EXPECT_EQ(commas, columns) << line;
  }
  EXPECT_EQ(lines, runs + 1);
  const auto object = with_cells(describe(small_study().request), small_study());
  EXPECT_EQ(object["cells"].size(), 4U);
  EXPECT_EQ(object["cells"][1]["reference"].get<std::string>().substr(0, 10), "4.88988056");
}

}  // namespace
}  // namespace albedo::analysis
