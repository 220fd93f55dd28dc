#include "albedo/table.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <thread>

#include "albedo/combinators/sum.hpp"
#include "albedo/core/errors.hpp"
#include "albedo/table_growth.hpp"
#include "albedo/table_source.hpp"

namespace albedo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> range(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(from + (to - from) * i / (count - 1));
  return values;
}

AlbedoTable square_table(int threads) {
  TableOptions options;
  options.albedo.tolerance = 1e-6;
  options.threads = threads;
  options.keep_errors = true;
  return AlbedoTable("ggx", {}, {{"alpha", range(0.05, 1, 64)}, {"cos_theta", range(0, 1, 64)}}, options);
}

TEST(Table, EntriesAreWithinTheirErrorsOf113Bits) {
  const AlbedoTable table = square_table(2);
  ASSERT_EQ(table.values().size(), 64U * 64U);
  ASSERT_EQ(table.errors().size(), 64U * 64U);
  EXPECT_EQ(table.unconverged(), 0U);
  EXPECT_EQ(table.divergent(), 0U);
  EXPECT_EQ(table.errors()[table.worst_entry()], table.worst_error());
  double worst = 0;
  for (std::size_t i = 0; i < table.values().size(); ++i) {
    ASSERT_TRUE(std::isfinite(table.values()[i])) << i;
    worst = std::max(worst, table.errors()[i]);
  }
  EXPECT_EQ(worst, table.worst_error());
  EXPECT_LE(worst, 1e-6);
  for (std::size_t i = 5; i < table.values().size(); i += 331) {
    const double alpha = table.axes()[0].values[i / 64], cosine = table.axes()[1].values[i % 64];
    const Estimate truth = directional_albedo(*make_model("ggx", {{"alpha", alpha}}), Direction::from_cosine(cosine),
                                              {.precision = Precision::quad, .tolerance = 1e-10});
    EXPECT_LE(std::abs(table.values()[i] - truth.value), table.errors()[i] + truth.error) << alpha << " " << cosine;
  }
}

TEST(Table, IsTheSameForAnyNumberOfThreads) {
  const AlbedoTable one = square_table(1);
  for (const int threads : {2, 3}) {
    const AlbedoTable other = square_table(threads);
    EXPECT_EQ(one.values(), other.values());  // all are finite
    EXPECT_EQ(one.errors(), other.errors());
    EXPECT_EQ(one.worst_error(), other.worst_error());
    EXPECT_EQ(one.worst_entry(), other.worst_entry());
    EXPECT_EQ(one.interpolation_error(), other.interpolation_error());
    EXPECT_EQ(one.evaluations(), other.evaluations());
  }
}

TEST(Table, TheLastAxisIsTheFastest) {
  TableOptions options;
  options.verified_cells = 0;
  const std::vector<double> roughness{0.2, 0.4}, phi{0, 30, 90}, theta{10, 50, 70, 80};
  const AlbedoTable table("ward", {{"rho_s", 0.8}, {"alpha_y", 0.1}},
                          {{"theta", theta}, {"alpha_x", roughness}, {"phi", phi}}, options);
  std::size_t entry = 0;
  for (const double t : theta) {
    for (const double a : roughness) {
      for (const double p : phi) {
        const auto model = make_model("ward", {{"rho_s", 0.8}, {"alpha_x", a}, {"alpha_y", 0.1}});
        EXPECT_EQ(table.values().at(entry++), directional_albedo(*model, Direction::from_degrees(t, p)).value);
      }
    }
  }
  EXPECT_EQ(table.values().size(), entry);
  EXPECT_TRUE(table.errors().empty());
  EXPECT_EQ(table.interpolation_error(), 0);
}

TEST(Table, HoldsInfinityWhereTheModelDiverges) {
  const AlbedoTable table("ward", {}, {{"alpha", {0.1, 0.3}}, {"theta", {0, 60, 90}}});
  EXPECT_EQ(table.divergent(), 2U);
  EXPECT_EQ(table.unconverged(), 0U);
  EXPECT_EQ(table.values()[2], infinity);
  EXPECT_EQ(table.values()[5], infinity);
  EXPECT_TRUE(std::isfinite(table.worst_error()));
  EXPECT_TRUE(std::isfinite(table.interpolation_error()));
  EXPECT_GT(table.interpolation_error(), 0);
}

TEST(Table, MeasuresLinearInterpolation) {
  TableOptions options;
  // Lambert's albedo is rho: linear interpolation has nothing to miss.
  EXPECT_LT(
      AlbedoTable("lambert", {}, {{"rho", range(0, 1, 5)}, {"theta", {0, 45, 90}}}, options).interpolation_error(),
      1e-14);
  // One cell of a 2 × 2 table, whose centre is known.
  const std::vector<double> alpha{0.2, 0.6}, cosine{0.5, 0.9};
  const AlbedoTable table("ggx", {}, {{"alpha", alpha}, {"cos_theta", cosine}}, options);
  const auto& v = table.values();
  const double truth = directional_albedo(*make_model("ggx", {{"alpha", 0.4}}), Direction::from_cosine(0.7)).value;
  EXPECT_NEAR(table.interpolation_error(), std::abs((v[0] + v[1] + v[2] + v[3]) / 4 - truth), 1e-14);
  EXPECT_GT(table.interpolation_error(), 1e-4);
  // A finer table misses less, and a table of one point has no cells.
  const auto error_of = [](int count) {
    return AlbedoTable("ggx", {}, {{"alpha", range(0.2, 0.6, count)}, {"cos_theta", range(0.5, 0.9, count)}})
        .interpolation_error();
  };
  EXPECT_NEAR(error_of(9) / error_of(17), 4, 1.5);
  EXPECT_EQ(AlbedoTable("ggx", {}, {{"theta", {30}}}).interpolation_error(), 0);
}

TEST(Table, CountsEntriesThatMissTheTolerance) {
  TableOptions options;
  options.albedo.tolerance = 1e-12;
  options.albedo.budget = 100;
  options.verified_cells = 0;
  const AlbedoTable table("ward", {}, {{"theta", {10, 80, 89}}}, options);
  EXPECT_EQ(table.unconverged(), 3U);
  EXPECT_GT(table.worst_error(), 1e-12);
}

/// Makes models no faster than one in 2 ms: progress is reported ten times a second.
std::unique_ptr<Model> slowly(std::unique_ptr<Model> model) {
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return model;
}

TEST(Table, ReportsProgressFromTheCallingThread) {
  TableOptions options;
  options.correction = slowly;
  options.threads = 2;
  options.albedo.tolerance = 1e-10;
  std::size_t last = 0;
  const std::thread::id caller = std::this_thread::get_id();
  options.progress = [&](std::size_t done, std::size_t total) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_EQ(total, 4000U);
    EXPECT_GT(done, last);
    last = done;
  };
  AlbedoTable("phong", {}, {{"n", range(1, 1000, 200)}, {"cos_theta", range(0.01, 1, 20)}}, options);
  EXPECT_LE(last, 4000U);
  EXPECT_GT(last, 0U);
}

TEST(Table, CarriesExceptionsOutOfItsThreads) {
  TableOptions options;
  options.threads = 3;
  options.albedo.tolerance = 2;  // directional_albedo refuses it
  EXPECT_THROW(AlbedoTable("ggx", {}, {{"cos_theta", range(0, 1, 500)}}, options), ParameterError);
  options.albedo.tolerance = 1e-10;
  options.correction = slowly;
  options.progress = [](std::size_t, std::size_t) { throw std::runtime_error("stop"); };
  EXPECT_THROW(AlbedoTable("phong", {}, {{"n", range(1, 1000, 200)}, {"cos_theta", range(0.01, 1, 20)}}, options),
               std::runtime_error);
}

const TableAxis masking{.name = "masking", .labels = {"correlated", "separable"}};

TEST(Table, AnAxisOfNamesIsAChoice) {
  const AlbedoTable table("ggx", {{"f0", 0.5}}, {{"alpha", {0.2, 0.7}}, masking, {"theta", {0, 40, 80}}});
  std::size_t entry = 0;
  for (const double alpha : {0.2, 0.7}) {
    for (const std::string& name : masking.labels) {
      for (const double theta : {0, 40, 80}) {
        const auto model = make_model("ggx", {{"f0", 0.5}, {"masking", name}, {"alpha", alpha}});
        EXPECT_EQ(table.values().at(entry++), directional_albedo(*model, Direction::from_degrees(theta)).value);
      }
    }
  }
  EXPECT_EQ(table.values().size(), entry);
}

TEST(Table, InterpolatesWithinANameOnly) {
  const auto error_of = [](const std::vector<TableAxis>& axes) {
    return AlbedoTable("ggx", {}, axes).interpolation_error();
  };
  const TableAxis theta{"theta", range(0, 80, 5)};
  double largest = 0;
  for (const std::string& name : masking.labels) {
    largest = std::max(largest, error_of({{.name = "masking", .labels = {name}}, theta}));
  }
  EXPECT_EQ(error_of({masking, theta}), largest);
  EXPECT_EQ(error_of({theta, masking}), largest);
}

/// A sum whose weights are the place, and a count of how many were made.
struct CountedSums {
  std::shared_ptr<int> made = std::make_shared<int>(0);
  std::shared_ptr<const Model> operator()(const std::vector<double>& place) const {
    ++*made;
    std::vector<SumModel::Part> parts(2);
    parts[0] = {place.at(0), make_model("lambert", {{"rho", 0.5}})};
    parts[1] = {place.at(1), make_model("ward")};
    return std::make_shared<SumModel>(std::move(parts));
  }
};

TEST(Table, VariesAnyModels) {
  const CountedSums sums;
  const TableOptions options{.threads = 1, .verified_cells = 0};
  const std::vector<TableAxis> axes{{"a", {0.25, 0.5}}, {"theta", {0, 60}}, {.name = "b", .labels = {"off", "on"}}};
  const AlbedoTable table(TableSource(sums, axes, options));
  const auto ward = make_model("ward");
  std::size_t entry = 0;
  for (const double a : {0.25, 0.5}) {
    for (const double theta : {0, 60}) {
      const double alone = directional_albedo(*ward, Direction::from_degrees(theta)).value;
      for (const double b : {0, 1}) EXPECT_NEAR(table.values().at(entry++), 0.5 * a + b * alone, 2e-8);
    }
  }
  EXPECT_EQ(*sums.made, 8);  // b is the fastest
  const CountedSums others;
  EXPECT_EQ(AlbedoTable(TableSource(kept(others), axes, options)).values(), table.values());
  EXPECT_EQ(*others.made, 4);
  EXPECT_THROW(TableSource(sums, {axes[0], axes[2]}, options), ParameterError);
  EXPECT_THROW(TableSource(sums, {axes[0], axes[0], axes[1]}, options), ParameterError);
  EXPECT_THROW(TableSource(sums, axes, {.correction = [](std::unique_ptr<Model> model) { return model; }}),
               ParameterError);
}

TEST(Table, GrowsWithinNamesWhereverTheyStand) {
  const TableEntries entries = [](const std::vector<TableAxis>& axes) {
    return AlbedoTable("ggx", {}, axes, {.verified_cells = 0}).values();
  };
  const TableAxis theta{"theta", range(0, 80, 3)};
  const GrownTable first = grown({masking, theta}, entries, {.max_error = 1e-2});
  const GrownTable last = grown({theta, masking}, entries, {.max_error = 1e-2});
  EXPECT_TRUE(first.is_reached);
  EXPECT_GT(first.axes[1].size(), 3U);
  EXPECT_EQ(first.axes[1].values, last.axes[0].values);
  EXPECT_EQ(first.error, last.error);
  EXPECT_EQ(first.axes[0].labels, masking.labels);
}

struct Refused {
  std::string model;
  Parameters fixed;
  std::vector<TableAxis> axes;
  std::string says;
};

TEST(Table, RefusesWhatMakesNoSenseAndSaysWhy) {
  const TableAxis theta{"theta", {0, 45}};
  const std::vector<double> many(1'000'000, 0.5);
  const std::vector<Refused> cases{
      {"ggx", {}, {}, "needs an axis 'cos_theta' or 'theta'"},
      {"ggx", {}, {{"alpha", {0.1}}}, "needs an axis 'cos_theta' or 'theta'"},
      {"ggx", {}, {theta, {"cos_theta", {0.5}}}, "exclude each other"},
      {"ggx", {}, {theta, {"alpa", {0.5}}}, "did you mean 'alpha'?"},
      {"ggx", {}, {{"thete", {0.5}}}, "did you mean 'theta'?"},
      {"ggx", {}, {theta, {"alpha", {}}}, "'alpha' has no values"},
      {"ggx", {}, {theta, {"alpha", {0.5, 0}}}, "alpha_x is 0 on its axis and must be within [1e-06, 100]"},
      {"ggx", {}, {theta, {"f0", {0.5, std::nan("")}}}, "f0 is nan"},
      {"ggx", {}, {{"theta", {0, 90.5}}}, "theta is 90.5 on its axis and must be within [0, 90]"},
      {"ggx", {}, {{"cos_theta", {-0.1}}}, "cos_theta is -0.1"},
      {"ggx", {}, {theta, {"phi", {infinity}}}, "phi is inf"},
      {"ggx", {}, {theta, {"masking", {1}}}, "masking is a choice of names and can't be an axis"},
      {"ggx", {}, {theta, {.name = "masking", .labels = {"separable", "nine"}}}, "masking is 'nine'"},
      {"ggx", {}, {theta, {.name = "alpha", .labels = {"rough"}}}, "alpha_x"},
      {"ggx", {}, {{.name = "theta", .labels = {"steep"}}}, "theta is a direction and its axis holds numbers"},
      {"ggx", {}, {theta, theta}, "theta is varied twice"},
      {"ggx", {}, {theta, {"alpha", {0.1}}, {"alpha_x", {0.1}}}, "varied twice, by the axes 'alpha' and 'alpha_x'"},
      {"ggx",
       {{"alpha", 0.2}},
       {theta, {"alpha_y", {0.1}}},
       "alpha_y is fixed by 'alpha' and varied by the axis 'alpha_y'"},
      {"ggx", {{"f0", 2.0}}, {theta}, "f0 is 2"},
      {"ggx", {{"rho", 1.0}}, {theta}, "no parameter 'rho'"},
      {"ggx", {}, {{"cos_theta", many}, {"alpha_x", many}, {"alpha_y", many}, {"f0", many}}, "more entries than"},
  };
  for (const Refused& c : cases) {
    SCOPED_TRACE(c.says);
    try {
      AlbedoTable(c.model, c.fixed, c.axes);
      ADD_FAILURE() << "accepted";
    } catch (const ParameterError& e) {
      EXPECT_NE(std::string(e.what()).find(c.says), std::string::npos) << e.what();
    }
  }
  EXPECT_THROW(AlbedoTable("gxx", {}, {theta}), UnknownModel);
  EXPECT_THROW(AlbedoTable("ggx", {}, {theta}, {.threads = -1}), ParameterError);
  EXPECT_THROW(AlbedoTable("ggx", {}, {theta}, {.verified_cells = -1}), ParameterError);
}

}  // namespace
}  // namespace albedo
