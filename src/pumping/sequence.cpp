#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <map>

#include "albedo/core/errors.hpp"
#include "albedo/directional_albedo.hpp"
#include "core/check.hpp"
#include "numerics/larger.hpp"
#include "pumping/kernel_row.hpp"

namespace albedo {
namespace {

constexpr int terms = CosineTables::terms;
constexpr std::size_t most_panels = 64, most_panels_of_azimuths = 14;
constexpr double azimuths_tolerance = 1e-6;  // what the largest over azimuths is not asked for less than
constexpr double narrowest_panel = 1e-3;
constexpr double at_an_edge = 1e-6;     // a kink that near one is no kink
constexpr int azimuths = 12;            // of L, where they matter
constexpr double measured_share = 0.3;  // of the tolerance: errors at the test places
constexpr double rounding = 1e-13;
constexpr double same = 1e-9;  // of ln a: no kink of the diagonal

/// What all azimuths of L at one polar angle make of a_k.
struct Brightest {
  double value = 0, relative_error = 0;
};

}  // namespace

struct PumpSequence::Parts {
  const Model& model;
  double tolerance;
  bool isotropic;
  PumpDivisor divisor;
  std::map<double, std::vector<KernelRow>> rows{};  // by x_L
  std::vector<double> margins{};                    // by which the tables are raised
  std::vector<double> bounds{};
  Status status = Status::converged;
  std::int64_t evaluations = 0;
  int row_count = 0;

  [[nodiscard]] std::size_t panels_allowed() const { return isotropic ? most_panels : most_panels_of_azimuths; }

  /// @param aside azimuths between those of the tables
  Brightest brightest(double x, int order, bool aside) {
    std::vector<KernelRow>& of_x = rows[x];
    const std::size_t wanted = isotropic ? 1 : aside ? 2 * azimuths : azimuths;
    while (of_x.size() < wanted) {
      const auto i = static_cast<int>(of_x.size());
      const double phi = i < azimuths ? 360.0 / azimuths * i : 360.0 / azimuths * (i - azimuths + 0.5);
      of_x.emplace_back(model, x, phi, isotropic ? tolerance : std::max(tolerance, azimuths_tolerance));
      evaluations += of_x.back().evaluations();
      ++row_count;
    }
    Brightest all;
    for (KernelRow& row : of_x) {
      while (row.order() < order) row.advance(divisor);
      all.value = std::isnan(row.value()) ? row.value() : std::max(all.value, row.value());
      keep_larger(all.relative_error, row.error() / row.value());
    }
    check_positive_albedo("pumping", model, all.value, std::exp(-x));
    return all;
  }

  void tabulate() {
    const int order = divisor.orders();
    double worst = 0, row_error = 0;
    std::vector<double> expansions;
    for (std::size_t panel = 0; panel + 1 < divisor.albedos.edges().size();) {
      const double begin = divisor.albedos.edges()[panel], end = divisor.albedos.edges()[panel + 1];
      std::array<double, terms> values;
      for (int i = 0; i < terms; ++i) {
        const Brightest a = brightest(CosineTables::node(begin, end, i), order, false);
        values[static_cast<std::size_t>(i)] = std::log(a.value);
        keep_larger(row_error, a.relative_error);
      }
      const auto expansion = CosineTables::expansion(values);
      double error = 0;
      for (const double t : CosineTables::test_places) {
        const Brightest a = brightest(CosineTables::place(begin, end, t), order, true);
        keep_larger(error, std::abs(std::log(a.value) - CosineTables::sum(expansion, t)));
        keep_larger(row_error, a.relative_error);
      }
      if (error > measured_share * tolerance && divisor.albedos.edges().size() <= panels_allowed() &&
          end - begin > narrowest_panel) {
        divisor.albedos.split(panel, CosineTables::place(begin, end, 0));
        continue;
      }
      keep_larger(worst, error);
      expansions.insert(expansions.end(), expansion.begin(), expansion.end());
      ++panel;
    }
    divisor.albedos.add(expansions);
    if (order == 0) keep_larger(row_error, disagreement());
    margins.push_back(CosineTables::unmeasured * worst + row_error + rounding);
    bounds.push_back(std::expm1(margins.back()));
    divisor.albedos.raise_last(margins.back());
    if (!(bounds.back() <= tolerance)) status = Status::budget_exhausted;
    split_at_kinks();
  }

  /// By how much the rows' albedo and that of the ordinary integration differ beyond what both know, at a few angles: a
  /// lobe that the rows had missed would show.
  double disagreement() {
    double most = 0;
    for (const double theta : {0.0, 35.0, 60.0, 80.0, 89.0}) {
      const double x = -std::log(Direction::from_degrees(theta).cos_theta);
      for (const double phi : {0.0, 90.0}) {
        if (isotropic && phi > 0) continue;
        const Estimate a = directional_albedo(model, Direction::from_degrees(theta, phi), {.tolerance = tolerance});
        evaluations += a.evaluations;
        const double change = std::log(a.value) - divisor.log_albedo(0, x);
        if (isotropic || !(change <= 0)) keep_larger(most, std::abs(change) - a.error / a.value);
      }
    }
    return most;
  }

  /// Where the light from L itself begins or ends to be held by the floor of control or by 1, all of a_k's integrand
  /// changes at once: a kink of the next tables.
  void split_at_kinks() {
    const int order = divisor.orders() - 1;
    const auto branch = [&](double x) {
      const double g = divisor.log_albedo(order, x), before = divisor.log_divisor(order, x, x);
      if (divisor.control() == PumpControl::step && g < -x - same) return 1;
      if (divisor.control() == PumpControl::total && before + g < -x - same) return 1;
      return divisor.only_up() && g > same ? 2 : 0;
    };
    if (divisor.control() == PumpControl::none && !divisor.only_up()) return;
    constexpr int steps = 32;
    for (std::size_t panel = 0; panel + 1 < divisor.albedos.edges().size(); ++panel) {
      const double begin = divisor.albedos.edges()[panel], end = divisor.albedos.edges()[panel + 1];
      if (divisor.albedos.edges().size() > panels_allowed()) return;
      for (int i = 0; i < steps; ++i) {
        double before = begin + (end - begin) * i / steps, after = begin + (end - begin) * (i + 1) / steps;
        const int which = branch(before);
        if (branch(after) == which) continue;
        for (int halving = 0; halving < 50; ++halving) {
          const double middle = (before + after) / 2;
          (branch(middle) == which ? before : after) = middle;
        }
        if (after - begin < at_an_edge || end - after < at_an_edge) continue;
        divisor.albedos.split(panel, after);
        break;
      }
    }
  }
};

PumpSequence::PumpSequence(const Model& model, PumpControl control, bool only_up, double tolerance) {
  check_number("pumping: tolerance", tolerance, {1e-12, 0.1}, "[1e-12, 0.1]");
  check_reciprocal("pumping", model);
  parts_.reset(new Parts{model, tolerance, model.claims().isotropic, {control, only_up}});
  parts_->tabulate();
}

PumpSequence::~PumpSequence() = default;

void PumpSequence::advance() {
  constexpr double black = 1e-12;
  if (albedo(0, std::exp(-CosineTables::last_x)) < black) {  // D takes any power of that, and every error with it
    throw ParameterError("pumping: the albedo of " + parts_->model.info().name +
                         " vanishes at grazing incidence and can't be pumped more than once");
  }
  parts_->tabulate();
}

const PumpDivisor& PumpSequence::divisor() const { return parts_->divisor; }

double PumpSequence::albedo(int order, double cos_theta) const {
  return std::exp(parts_->divisor.log_albedo(order, -std::log(cos_theta)) -
                  parts_->margins[static_cast<std::size_t>(order)]);
}

double PumpSequence::upper(int order, double cos_theta) const {
  return std::exp(parts_->divisor.log_albedo(order, -std::log(cos_theta)));
}

double PumpSequence::average(int order) const {
  double sum = 0;
  const std::vector<double>& edges = parts_->divisor.albedos.edges();
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    sum += boost::math::quadrature::gauss<double, 20>::integrate(
        [&](double x) { return 2 * std::exp(-2 * x) * albedo(order, std::exp(-x)); }, edges[i],
        std::min(edges[i + 1], edges[i] + 30));
  }
  return sum;
}

double PumpSequence::relative_bound(int order) const { return parts_->bounds[static_cast<std::size_t>(order)]; }
Status PumpSequence::status() const { return parts_->status; }
std::int64_t PumpSequence::evaluations() const { return parts_->evaluations; }
int PumpSequence::rows() const { return parts_->row_count; }

}  // namespace albedo
