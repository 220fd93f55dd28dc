#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <memory>

#include "albedo/microfacet/sampling.hpp"
#include "audit/parts.hpp"
#include "integration/integrand_of.hpp"
#include "numerics/function_integrand.hpp"
#include "numerics/larger.hpp"
#include "rules/gauss.hpp"
#include "rules/kronrod.hpp"
#include "rules/random.hpp"
#include "rules/stratified.hpp"

namespace albedo {
namespace {

constexpr std::uint32_t pilot_count = 4096, drawn_count = 32768;
constexpr int sectors = 8;

/// Polar coordinates of the directions V in which a lobe is round: γ from its middle, φ around it.
class Chart {
 public:
  struct Point {
    double gamma, phi;
  };
  struct Place {
    UnitVector<double> v;
    double jacobian;  ///< dω_V/(dγ dφ)
  };

  virtual ~Chart() = default;
  [[nodiscard]] virtual Point to(const Sampled<double>& drawn) const = 0;
  [[nodiscard]] virtual Place from(const Point& point) const = 0;
  [[nodiscard]] virtual double farthest() const = 0;  ///< γ of what is farthest
};

/// Around the mean of directions drawn.
class SphereChart final : public Chart {
 public:
  explicit SphereChart(const std::vector<Sampled<double>>& pilot) {
    UnitVector<double> sum{0, 0, 0};
    for (const Sampled<double>& drawn : pilot) {
      const UnitVector<double> v = drawn.viewer();
      sum = {sum.x + v.x, sum.y + v.y, sum.z + v.z};
    }
    const double length = std::sqrt(dot(sum, sum));
    if (length > 0) pole_ = {sum.x / length, sum.y / length, sum.z / length};
    const double planar = std::hypot(pole_.x, pole_.y);
    if (planar > 0) right_ = {-pole_.y / planar, pole_.x / planar, 0};
    up_ = {pole_.y * right_.z - pole_.z * right_.y, pole_.z * right_.x - pole_.x * right_.z,
           pole_.x * right_.y - pole_.y * right_.x};
  }

  [[nodiscard]] Point to(const Sampled<double>& drawn) const override {
    const UnitVector<double> v = drawn.viewer();
    const double x = dot(v, right_), y = dot(v, up_);
    return {std::atan2(std::hypot(x, y), dot(v, pole_)), std::atan2(y, x)};
  }
  [[nodiscard]] Place from(const Point& point) const override {
    const double sine = std::sin(point.gamma), along = std::cos(point.gamma);
    const double x = sine * std::cos(point.phi), y = sine * std::sin(point.phi);
    return {{along * pole_.x + x * right_.x + y * up_.x, along * pole_.y + x * right_.y + y * up_.y,
             along * pole_.z + x * right_.z + y * up_.z},
            sine};
  }
  [[nodiscard]] double farthest() const override { return pi<double>; }

 private:
  static double dot(const UnitVector<double>& a, const UnitVector<double>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }

  UnitVector<double> pole_{0, 0, 1}, right_{1, 0, 0}, up_{0, 1, 0};
};

/// Slopes of H in units of the lobe's widths, tanγ of them. Every V but −L has one H above the surface.
class SlopeChart final : public Chart {
 public:
  SlopeChart(const UnitVector<double>& l, const SlopeLobe& lobe) : l_(l), x_(lobe.width_x), y_(lobe.width_y) {}

  [[nodiscard]] Point to(const Sampled<double>& drawn) const override {
    const double x = drawn.pair.slope_x / x_, y = drawn.pair.slope_y / y_;
    return {std::atan(std::hypot(x, y)), std::atan2(y, x)};
  }
  [[nodiscard]] Place from(const Point& point) const override {
    const double r = std::tan(point.gamma);
    const DirectionPair<double> d = reflected(l_, x_ * r * std::cos(point.phi), y_ * r * std::sin(point.phi));
    const double cos3 = d.cos_theta_h * d.cos_theta_h * d.cos_theta_h;
    return {{d.v_x, d.v_y, d.cos_theta_v}, 4 * d.cos_theta_d * cos3 * x_ * y_ * r * (1 + r * r)};
  }
  /// Beyond, where little is, V is so close to −L that their sum has lost H.
  [[nodiscard]] double farthest() const override { return std::atan(1e8); }

 private:
  UnitVector<double> l_;
  double x_, y_;
};

/// Rings that hold about as many directions each, in eight sectors. Beyond the farthest of a first batch they widen
/// geometrically.
class Cells {
 public:
  Cells(const Chart& chart, const std::vector<Sampled<double>>& pilot) : chart_(chart) {
    std::vector<double> angles;
    for (const Sampled<double>& drawn : pilot) angles.push_back(chart.to(drawn).gamma);
    std::sort(angles.begin(), angles.end());
    constexpr int rings = 16;
    const double farthest = chart.farthest();
    const auto add = [&](double edge) {
      if (edge > edges_.back() && edge < farthest) edges_.push_back(edge);
    };
    for (int i = 1; i < rings; ++i) add(angles[static_cast<std::size_t>(i) * angles.size() / rings]);
    for (std::size_t tail = angles.size() / rings / 2; tail > 4; tail /= 2) add(angles[angles.size() - tail]);
    for (double edge = 1.5 * angles.back(); edge > 0 && edge < farthest; edge *= 3) add(edge);
    edges_.push_back(farthest);
  }

  [[nodiscard]] int count() const { return static_cast<int>(edges_.size() - 1) * sectors; }

  [[nodiscard]] int of(const Sampled<double>& drawn) const {
    const Chart::Point point = chart_.to(drawn);
    const auto ring = std::upper_bound(edges_.begin(), edges_.end() - 1, point.gamma) - edges_.begin() - 1;
    const double turn = point.phi / (2 * pi<double>);
    const int sector = static_cast<int>(std::floor((turn < 0 ? turn + 1 : turn) * sectors));
    return static_cast<int>(ring) * sectors + std::min(sector, sectors - 1);
  }

  /// ∫ density over a cell.
  template <class Density>
  [[nodiscard]] Estimate integral(int cell, const Density& density, const RuleOptions& options) const {
    const auto ring = static_cast<std::size_t>(cell / sectors);
    const double begin = edges_[ring], width = edges_[ring + 1] - begin, turn = 2 * pi<double> / sectors;
    const auto integrand = [&](int, double u, double v) {
      const Chart::Place place = chart_.from({begin + width * u, turn * (cell % sectors + v)});
      return density(place.v) * place.jacobian * width * turn;
    };
    return kronrod(FunctionIntegrand({Panel{}}, integrand), options);
  }

 private:
  const Chart& chart_;
  std::vector<double> edges_{0};
};

/// χ² of the counts in cells that are expected to hold 5 or more; the others are taken together.
void compare(const std::vector<double>& expected, const std::vector<double>& counts, SamplerAudit& audit) {
  constexpr double enough = 5;
  double rest_expected = 0, rest_count = 0;
  int terms = 0;
  const auto add = [&](double of, double count) {
    audit.chi_squared += square(count - of) / of;
    ++terms;
  };
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] >= enough) {
      add(expected[i], counts[i]);
    } else {
      rest_expected += expected[i], rest_count += counts[i];
    }
  }
  if (rest_expected >= enough || rest_count >= enough) add(std::max(rest_expected, enough), rest_count);
  audit.degrees_of_freedom = terms - 1;
  if (terms < 2) return;
  const boost::math::chi_squared distribution(audit.degrees_of_freedom);
  audit.p_value =
      std::isfinite(audit.chi_squared) ? boost::math::cdf(boost::math::complement(distribution, audit.chi_squared)) : 0;
}

bool is_finite(const Sampled<double>& drawn) {
  const auto [x, y, z] = drawn.viewer();
  return std::isfinite(x + y + z + drawn.pair.slope_x + drawn.pair.slope_y);
}

/// Of a sampler that draws no direction.
SamplerAudit nothing_known(SamplerAudit audit) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  audit.density_mismatch = audit.density_integral.value = audit.density_integral.error = nan;
  audit.density_integral.status = Status::non_finite;
  audit.p_value = 0;
  return audit;
}

SamplerAudit look(const Model& model, const Lobe& lobe, double theta, double phi, const AlbedoOptions& options) {
  SamplerAudit audit{.component = lobe.component, .theta_degrees = theta, .phi_degrees = phi};
  const Direction direction = Direction::from_degrees(theta, phi);
  const UnitVector<double> l = unit_vector<double>(direction);
  const RandomStream stream(options.seed);
  const auto draw = [&](std::uint32_t i, std::uint32_t batch) {
    const auto [u, v] = stream.uniform_pair({{i, batch, static_cast<std::uint32_t>(lobe.component), 0}});
    return model.sample(lobe.component, l, u, v);
  };
  std::vector<Sampled<double>> pilot;
  for (std::uint32_t i = 0; i < pilot_count; ++i) pilot.push_back(draw(i, 0));
  if (!std::ranges::all_of(pilot, is_finite)) return nothing_known(audit);
  std::unique_ptr<Chart> chart;
  if (const auto* slopes = lobe.as<SlopeLobe>()) {
    chart = std::make_unique<SlopeChart>(l, *slopes);
  } else {
    chart = std::make_unique<SphereChart>(pilot);
  }
  const Cells cells(*chart, pilot);

  std::vector<double> counts(static_cast<std::size_t>(cells.count())), expected;
  for (std::uint32_t i = 0; i < drawn_count; ++i) {
    const Sampled<double> drawn = draw(i, 1);
    if (!is_finite(drawn)) return nothing_known(audit);
    const UnitVector<double> v = drawn.viewer();
    ++counts[static_cast<std::size_t>(cells.of(drawn))];
    if (v.z <= 0) audit.below_horizon += 1.0 / drawn_count;
    constexpr double opposite = 0.01;  // L + V loses the digits of H
    if (drawn.pair.cos_theta_d < opposite) continue;
    const double mismatch = std::abs(model.density(lobe.component, l, v) / drawn.density - 1);
    keep_larger(audit.density_mismatch, mismatch);
  }
  const auto density = [&](const UnitVector<double>& v) { return model.density(lobe.component, l, v); };
  Estimate& sum = audit.density_integral;
  sum.error_kind = ErrorKind::rule_difference;
  for (int cell = 0; cell < cells.count(); ++cell) {
    // relative to all, not to a cell that may hold nothing
    const Estimate part = cells.integral(cell, density, {.tolerance = 1e-5, .budget = 20'000, .seed = 1});
    expected.push_back(part.value * drawn_count);
    sum.value += part.value;
    sum.error += part.error;
    sum.evaluations += part.evaluations;
    if (part.status == Status::non_finite) sum.status = part.status;
  }
  compare(expected, counts, audit);

  AlbedoOptions sampled = options, exact = options;
  // drawn and weighed in double: 113 bits would take seconds for what a standard error hides
  if (options.precision == Precision::quad) sampled.precision = exact.precision = Precision::float64;
  sampled.warp = Warp::paper, sampled.tolerance = 1e-4;
  const RuleOptions strata{.tolerance = 1e-3, .budget = 65'536, .seed = options.seed};
  audit.mean_weight = stratified(*integrand_of(model, lobe, direction, sampled), strata);
  exact.warp = Warp::lobe;
  const auto integrand = integrand_of(model, lobe, direction, exact);
  audit.albedo = gauss_estimate(*integrand, {exact.tolerance, exact.budget, exact.seed});
  return audit;
}

Verdict verdict_of(const SamplerAudit& audit, double least_p) {
  constexpr double deviations = 5, mismatch = 1e-5, slack = 1e-3;
  const Estimate& one = audit.density_integral;
  // too few directions above the horizon, and the mean weight says nothing
  const bool weighs = !std::isfinite(audit.mean_weight.error) || !std::isfinite(audit.albedo.value) ||
                      std::abs(audit.mean_weight.value - audit.albedo.value) <=
                          deviations * audit.mean_weight.error + audit.albedo.error + 1e-7 * audit.albedo.value;
  const bool normalised = std::abs(one.value - 1) <= std::min(one.error, slack) + slack;
  return audit.p_value >= least_p && normalised && audit.density_mismatch <= mismatch && weighs ? Verdict::pass
                                                                                                : Verdict::fails;
}

}  // namespace

std::vector<SamplerAudit> audit_samplers(const Model& model, const AuditOptions& options) {
  std::vector<SamplerAudit> audits;
  const double phi = model.claims().isotropic ? 0 : 25;
  for (const Lobe& lobe : model.lobes()) {
    if (!model.has_sampler(lobe.component)) continue;
    for (const double theta : {0.0, 45.0, 80.0}) audits.push_back(look(model, lobe, theta, phi, options.albedo));
  }
  if (audits.empty()) return audits;
  const double tests = static_cast<double>(audits.size());
  const double least_p = -std::expm1(std::log1p(-options.significance) / tests);
  for (SamplerAudit& audit : audits) audit.verdict = verdict_of(audit, least_p);
  return audits;
}

}  // namespace albedo
