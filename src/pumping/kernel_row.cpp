#include "pumping/kernel_row.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/larger.hpp"
#include "rules/nodes.hpp"
#include "warps/sample.hpp"

namespace albedo {
namespace {

constexpr double last_flux = 40;  // x_V: what is below cosθ_V ~ 4e-18 gets less than that
constexpr std::size_t most_panels = 400;
constexpr double narrowest = 1e-10;     // panel
constexpr double share = 1.0 / 200;     // of the tolerance, for a panel
constexpr double own_share = 1.0 / 20;  // of the tolerance, for a panel with that much of its own integral

const Nodes<double>& gauss_nodes() {
  static const Nodes<double>& rule = nodes_of<double>(AxisKind::interval, 16);
  return rule;
}

/// What the last coefficients of an expansion leave open.
double last_coefficients(const std::array<double, 16>& values) {
  constexpr std::size_t last = 3;
  static const auto rows = [] {
    const Nodes<double>& rule = gauss_nodes();
    const auto terms = static_cast<std::size_t>(rule.terms);
    std::array<std::array<double, 16>, last> of_coefficient{};
    for (std::size_t k = 0; k < last; ++k) {
      for (std::size_t i = 0; i < 16; ++i) of_coefficient[k][i] = rule.transform[i * terms + terms - last + k];
    }
    return of_coefficient;
  }();
  double largest = 0;
  for (const auto& row : rows) {
    double c = 0;
    for (std::size_t i = 0; i < values.size(); ++i) c += row[i] * values[i];
    keep_larger(largest, std::abs(c));
  }
  return largest;
}

}  // namespace

KernelRow::KernelRow(const Model& model, double x_l, double azimuth, double tolerance, Least least)
    : x_l_(x_l), tolerance_(tolerance), least_(least), same_(std::max(1e-11, share * tolerance)) {
  Direction l = Direction::from_degrees(0, azimuth);
  l.cos_theta = std::exp(-x_l), l.sin_theta = std::sqrt(-std::expm1(-2 * x_l));
  coherent_ = static_cast<double>(model.coherent_albedo(l));
  AzimuthIntegral flux(model, l);
  integrate(flux);
  evaluations_ = flux.evaluations();
}

/// Panels from N to the horizon, narrower around what the lobes are centred on, and with an edge at L.
std::vector<double> KernelRow::first_edges(const AzimuthIntegral& flux) const {
  std::vector<double> edges{0, last_flux};
  const double nearest = std::min(x_l_, last_flux);
  for (const double step : {1.5, 4.0, 8.0, 16.0}) {
    edges.push_back(step);
    edges.push_back(nearest + step);
  }
  edges.push_back(nearest);
  for (const Lobe& lobe : flux.lobes()) {
    const double width = std::min(lobe.widths().narrow, 1.0);
    if (width > 0.2 || lobe.is<CosineLobe>()) continue;
    const UnitVector<double> axis = lobe_axis(lobe, flux.light());
    const double centre = std::atan2(std::hypot(axis.x, axis.y), axis.z);
    for (double distance = 4 * width; distance < 1; distance *= 6) {
      for (const double theta : {centre - distance, centre + distance}) {
        if (theta > 0 && theta < 1.57) edges.push_back(-std::log(std::cos(theta)));
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<double> kept{0};
  for (const double edge : edges) {
    if (edge > last_flux) break;
    const bool is_light = edge == nearest;
    const double least = std::min(0.02, edge / 4);
    if (edge - kept.back() > least) {
      kept.push_back(edge);
    } else if (is_light && edge > kept.back()) {
      if (kept.size() > 1)
        kept.back() = edge;
      else
        kept.push_back(edge);
    }
  }
  kept.back() = last_flux;
  return kept;
}

void KernelRow::integrate(AzimuthIntegral& flux) {
  const std::vector<double> edges = first_edges(flux);
  double total = coherent_;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    panels_.push_back(evaluated(flux, edges[i], edges[i + 1]));
    total += panels_.back().sum;
  }
  for (std::size_t i = 0; i < panels_.size();) {
    const Panel& panel = panels_[i];
    const double width = panel.end - panel.begin;
    if (!(panel.doubt > tolerance_ * std::max(share * total * least_divisor(panel.end), own_share * panel.sum)) ||
        panels_.size() >= most_panels || width < narrowest * std::max(1.0, panel.end)) {
      ++i;
      continue;
    }
    const double begin = panel.begin, middle = (panel.begin + panel.end) / 2, end = panel.end, before = panel.sum;
    panels_[i] = evaluated(flux, begin, middle);
    panels_.insert(panels_.begin() + static_cast<std::ptrdiff_t>(i) + 1, evaluated(flux, middle, end));
    total += panels_[i].sum + panels_[i + 1].sum - before;
  }
  for (Panel& panel : panels_) panel.error += panel.doubt;
  conclude();
}

KernelRow::Panel KernelRow::evaluated(AzimuthIntegral& flux, double begin, double end) {
  Panel panel{begin, end};
  const Nodes<double>& rule = gauss_nodes();
  for (std::size_t i = 0; i < nodes; ++i) {
    const double x = begin + (end - begin) * rule.position[i], cos2 = std::exp(-2 * x);
    const auto [value, error] =
        flux(x, share * tolerance_ * largest_ * least_divisor(x) / cos2, own_share * tolerance_);
    panel.flux[i] = cos2 * value;
    panel.error += (end - begin) * rule.weight[i] * cos2 * error;
    largest_ = std::max(largest_, panel.flux[i]);
  }
  weigh(panel);
  return panel;
}

Block KernelRow::Panel::places(std::size_t i) const {
  return begin + width() * Block::load(gauss_nodes().position.data() + i);
}

KernelRow::Panel KernelRow::part_of(const Panel& panel, double begin, double end) {
  const Nodes<double>& rule = gauss_nodes();
  Panel part{begin, end};
  part.error = panel.error * part.width() / panel.width();
  const auto terms = static_cast<std::size_t>(rule.terms);
  Values coefficients{};
  for (std::size_t i = 0; i < nodes; ++i) {
    for (std::size_t k = 0; k < nodes; ++k) coefficients[k] += rule.transform[i * terms + k] * panel.flux[i];
  }
  for (std::size_t i = 0; i < nodes; i += block_width) {
    const Block t = 2 * (part.places(i) - panel.begin) / panel.width() - 1;
    Block sum = 0, previous = 0, current = 1;  // P_k by its recurrence
    for (std::size_t k = 0; k < nodes; ++k) {
      sum += coefficients[k] * current;
      const auto degree = static_cast<double>(k);
      const Block next = ((2 * degree + 1) * t * current - degree * previous) / (degree + 1);
      previous = current, current = next;
    }
    sum.store(part.flux.data() + i);
  }
  return part;
}

void KernelRow::divide(std::size_t panel, double x) {
  const Panel whole = panels_[panel];
  panels_[panel] = part_of(whole, whole.begin, x);
  panels_.insert(panels_.begin() + static_cast<std::ptrdiff_t>(panel) + 1, part_of(whole, x, whole.end));
}

void KernelRow::divide(std::size_t panel, double x, const PumpDivisor& divisor) {
  divide(panel, x);
  for (const std::size_t half : {panel, panel + 1}) {
    Panel& part = panels_[half];
    for (std::size_t i = 0; i < nodes; ++i) {
      part.log_d[i] = divisor.log_divisor(order_, x_l_, part.begin + part.width() * gauss_nodes().position[i]);
    }
  }
}

/// Which terms of the next step's max() and min() hold: where that changes, D has a kink.
int KernelRow::branch(const PumpDivisor& divisor, double x_v, double log_v) const {
  const bool from_v = log_v > log_l_ + same_;
  double g = from_v ? log_v : log_l_;
  const double floor = -std::min(x_l_, x_v);
  int which = from_v ? 1 : 0;
  if (divisor.control() == PumpControl::step && g < floor - same_) g = floor, which = 2;
  if (divisor.only_up() && g > same_) g = 0, which = 3;
  if (divisor.control() != PumpControl::total) return which;
  return divisor.log_divisor(order_, x_l_, x_v) + g < floor - same_ ? 4 : which;
}

void KernelRow::divide_at_kinks(const PumpDivisor& divisor) {
  const auto branch_at = [&](double x) { return branch(divisor, x, divisor.log_albedo(order_, x)); };
  for (std::size_t p = 0; p < panels_.size() && panels_.size() < most_panels; ++p) {
    const double begin = panels_[p].begin, end = panels_[p].end, width = end - begin;
    if (width < 1e-6) continue;
    constexpr int steps = 2 * block_width - 1;
    constexpr double aside = 1e-4;  // of a panel: a kink that near an end is no kink to the rule
    double before = 0, after = -1;
    int which = -1;
    for (int i = 0; i <= steps && after < 0; i += block_width) {
      const Block x =
          Block::generate([&](int lane) { return begin + width * (aside + (1 - 2 * aside) * (i + lane) / steps); });
      const Block log_v = divisor.albedos.log(order_, x);
      for (int lane = 0; lane < block_width; ++lane) {
        const int other = branch(divisor, x[lane], log_v[lane]);
        if (which >= 0 && other != which) {
          after = x[lane];
          break;
        }
        which = other, before = x[lane];
      }
    }
    if (after < 0) continue;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = (before + after) / 2;
      (branch_at(middle) == which ? before : after) = middle;
    }
    divide(p, after, divisor);
  }
}

/// The sum of flux / D and what the rule leaves of it.
void KernelRow::weigh(Panel& panel) {
  const Nodes<double>& rule = gauss_nodes();
  Values values;
  Block sum = 0;
  for (std::size_t i = 0; i < nodes; i += block_width) {
    const Block value = Block::load(panel.flux.data() + i) * exp(-Block::load(panel.log_d.data() + i));
    value.store(values.data() + i);
    sum += Block::load(rule.weight.data() + i) * value;
  }
  panel.sum = 0;
  for (int lane = 0; lane < block_width; ++lane) panel.sum += sum[lane];
  panel.sum *= panel.width();
  panel.doubt = panel.width() * last_coefficients(values);
}

void KernelRow::conclude() {
  value_ = coherent_ * std::exp(-coherent_log_d_);
  error_ = 0;
  for (const Panel& panel : panels_) {
    const double smallest = *std::min_element(panel.log_d.begin(), panel.log_d.end());
    value_ += panel.sum;
    error_ += (order_ > 0 ? panel.doubt : 0) + panel.error * std::exp(-smallest);
  }
}

void KernelRow::advance(const PumpDivisor& divisor) {
  log_l_ = divisor.log_albedo(order_, x_l_);
  divide_at_kinks(divisor);
  const auto step = [&](Panel& panel) {
    for (std::size_t i = 0; i < nodes; i += block_width) {
      const Block x = panel.places(i), before = Block::load(panel.log_d.data() + i);
      divisor.step(before, log_l_, divisor.albedos.log(order_, x), x_l_, x).store(panel.log_d.data() + i);
    }
    weigh(panel);
  };
  double total = 0;
  for (Panel& panel : panels_) {
    step(panel);
    total += panel.sum;
  }
  coherent_log_d_ = divisor.step(coherent_log_d_, log_l_, log_l_, x_l_, x_l_);
  ++order_;
  for (std::size_t p = 0; p < panels_.size();) {
    const Panel& panel = panels_[p];
    if (!(panel.doubt > share * tolerance_ * total) || panels_.size() >= most_panels || panel.width() < 1e-6) {
      ++p;
      continue;
    }
    divide(p, (panel.begin + panel.end) / 2, divisor);
    weigh(panels_[p]), weigh(panels_[p + 1]);
  }
  conclude();
}

KernelRow::Sum KernelRow::divided_by(const CosineTables& s) {
  const int last = s.count() - 1;
  Sum sum{coherent_ * std::exp(-s.log(last, x_l_)), 0};
  for (std::size_t p = 0; p < panels_.size();) {
    Panel& panel = panels_[p];
    for (std::size_t i = 0; i < nodes; i += block_width) s.log(last, panel.places(i)).store(panel.log_d.data() + i);
    weigh(panel);
    if (panel.doubt > share * tolerance_ * std::max(sum.value, panel.sum) && panels_.size() < most_panels &&
        panel.width() > 1e-6) {
      divide(p, (panel.begin + panel.end) / 2);
      continue;
    }
    sum.value += panel.sum;
    sum.error += panel.doubt + panel.error * std::exp(-*std::min_element(panel.log_d.begin(), panel.log_d.end()));
    ++p;
  }
  return sum;
}

}  // namespace albedo
