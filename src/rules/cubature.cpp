#include "rules/cubature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "rules/conclusion.hpp"

namespace albedo {
namespace {

struct Box {
  int panel;
  double u, v;            // centre
  double half_u, half_v;  // half widths
  double value = 0, error = 0, magnitude = 0;
  double estimate = 0;  // of the error, by this box's points alone
  bool split_u = false;
  bool unseen_feature = false;  // holds a feature that is smaller than the box

  std::array<double, 4> hidden{};  // beyond the points at each border

  [[nodiscard]] double all_hidden() const { return hidden[0] + hidden[1] + hidden[2] + hidden[3]; }
  [[nodiscard]] double priority() const { return unseen_feature ? std::numeric_limits<double>::infinity() : error; }
  friend bool operator<(const Box& a, const Box& b) { return a.priority() < b.priority(); }
};

constexpr int points_per_box = 17;

/// Genz and Malik's fully symmetric rules of degrees 7 and 5 in two dimensions.
class GenzMalik {
 public:
  explicit GenzMalik(const Integrand<double>& integrand) : integrand_(integrand) {}

  void measure(Box& box) const {
    constexpr int n = 2;
    static const double far = std::sqrt(9.0 / 10), near = std::sqrt(9.0 / 70), corner = std::sqrt(9.0 / 19);
    constexpr double two_n = 1 << n;
    constexpr double w1 = (12824.0 - 9120 * n + 400 * n * n) / 19683, w2 = 980.0 / 6561,
                     w3 = (1820.0 - 400 * n) / 19683, w4 = 200.0 / 19683, w5 = 6859.0 / 19683 / two_n;
    constexpr double e1 = (729.0 - 950 * n + 50 * n * n) / 729, e2 = 245.0 / 486, e3 = (265.0 - 100 * n) / 1458,
                     e4 = 25.0 / 729;
    std::array<double, points_per_box> u{}, v{}, w{};
    std::size_t k = 0;
    const auto put = [&](double x, double y) {
      u[k] = box.u + x * box.half_u;
      v[k] = box.v + y * box.half_v;
      ++k;
    };
    put(0, 0);
    for (const double s : {near, far}) put(s, 0), put(-s, 0), put(0, s), put(0, -s);
    for (const double s : {far, -far}) put(s, far), put(s, -far);
    for (const double s : {corner, -corner}) put(s, corner), put(s, -corner);
    integrand_.points(box.panel, u.data(), v.data(), w.data(), points_per_box);

    const double centre = w[0];
    const double near_u = w[1] + w[2], near_v = w[3] + w[4], far_u = w[5] + w[6], far_v = w[7] + w[8];
    const double cross = w[9] + w[10] + w[11] + w[12], corners = w[13] + w[14] + w[15] + w[16];
    const double area = 4 * box.half_u * box.half_v;
    box.value = area * (w1 * centre + w2 * (near_u + near_v) + w3 * (far_u + far_v) + w4 * cross + w5 * corners);
    const double fifth = area * (e1 * centre + e2 * (near_u + near_v) + e3 * (far_u + far_v) + e4 * cross);
    // it is the difference of two rules, not yet asymptotic in a large box, and blind to layers between its points
    const bool layered = integrand_.panels()[static_cast<std::size_t>(box.panel)].layered;
    box.estimate = box.error = (layered ? 16 : 4) * std::abs(box.value - fifth);
    box.magnitude = 0;
    for (const double value : w) box.magnitude += std::abs(value) * area / points_per_box;
    const double ratio = near * near / (far * far);
    const double bend_u = std::abs(near_u - 2 * centre - ratio * (far_u - 2 * centre));
    const double bend_v = std::abs(near_v - 2 * centre - ratio * (far_v - 2 * centre));
    box.split_u = bend_u != bend_v ? bend_u > bend_v : box.half_u >= box.half_v;
    notice_feature(box);
  }

 private:
  void notice_feature(Box& box) const {
    const Panel& panel = integrand_.panels()[static_cast<std::size_t>(box.panel)];
    bool divide_u = false;
    box.unseen_feature =
        hides_feature(panel, box.u - box.half_u, box.v - box.half_v, 2 * box.half_u, 2 * box.half_v, divide_u);
    if (box.unseen_feature) box.split_u = divide_u;
  }

  const Integrand<double>& integrand_;
};

struct Sums {
  double value = 0, error = 0, magnitude = 0;
  bool unseen_feature = false;
};

Sums sum(const std::vector<Box>& boxes) {
  Sums sums;
  for (const Box& box : boxes) {
    sums.value += box.value;
    sums.error += box.error;
    sums.magnitude += box.magnitude;
    sums.unseen_feature = sums.unseen_feature || box.unseen_feature;
  }
  return sums;
}

/// A panel, or what is between two of its corners.
struct Strip {
  int panel;
  double begin, end;  // along v
};

std::vector<Strip> strips_of(const Integrand<double>& integrand) {
  std::vector<Strip> strips;
  for (int panel = 0; panel < static_cast<int>(integrand.panels().size()); ++panel) {
    double begin = 0;
    for (const double corner : integrand.corners(panel)) {
      if (corner > begin && corner < 1) strips.push_back({panel, begin, corner}), begin = corner;
    }
    strips.push_back({panel, begin, 1});
  }
  return strips;
}

/// The part of a box between its outermost points and one of its borders: an edge there isn't seen.
constexpr double hidden_strip = 0.0257;

/// What halving changed is the parent's true error, nearly. Where its estimate had foreseen it, a part of it is left to
/// the halves (more where layers may hide between points); where it hadn't, all of it, and their own estimates are as
/// much too small.
void keep_honest(const Box& parent, Box& a, Box& b, bool layered) {
  const double foreseen = layered ? 2 : 16;
  const double change = std::abs(a.value + b.value - parent.value);
  const bool surprise = change > parent.estimate;
  const double factor = surprise && parent.estimate > 0 ? change / parent.estimate : 1;
  const double floor = surprise ? change / 2 : change / foreseen;
  for (Box* half : {&a, &b}) half->error = std::max(half->error * factor, floor);
}

/// What an edge could have that lies between a box's outermost points and one of its borders: where the halves differ,
/// that is at the border between them.
void keep_hidden(const Box& parent, Box& a, Box& b) {
  constexpr std::size_t left = 0, right = 1, bottom = 2, top = 3;
  for (Box* half : {&a, &b}) {
    for (std::size_t side = 0; side < 4; ++side) half->hidden[side] = parent.hidden[side] / 2;
  }
  const double step = hidden_strip * std::abs(a.value - b.value);
  a.hidden[parent.split_u ? right : top] = step;
  b.hidden[parent.split_u ? left : bottom] = step;
  for (Box* half : {&a, &b}) half->error = std::max(half->error, half->all_hidden());
}

/// The same for the first boxes, `rows` × `rows` in every strip: where neighbours differ, and at the panel's own
/// borders.
void hide_at_borders(const Integrand<double>& integrand, std::vector<Box>& boxes, int rows) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    Box& box = boxes[i];
    if (!integrand.panels()[static_cast<std::size_t>(box.panel)].edged) continue;
    const auto size = static_cast<std::size_t>(rows);
    const std::size_t column = i % size, row = i / size % size;
    const auto step = [&](bool at_border, std::size_t neighbour) {
      return hidden_strip * (at_border ? box.magnitude : std::abs(box.value - boxes[neighbour].value));
    };
    box.hidden = {step(column == 0, i - 1), step(column + 1 == size, i + 1), step(row == 0, i - size),
                  step(row + 1 == size, i + size)};
    box.error = std::max(box.error, box.all_hidden());
  }
}

}  // namespace

Estimate cubature(const Integrand<double>& integrand, const RuleOptions& options) {
  const GenzMalik rule(integrand);
  const auto panel_of = [&](const Box& box) -> const Panel& {
    return integrand.panels()[static_cast<std::size_t>(box.panel)];
  };
  std::vector<Box> heap;
  std::int64_t evaluations = 0;
  constexpr int enough = 5;  // per axis: a first look that isn't fooled by symmetry
  const std::vector<Strip> strips = strips_of(integrand);
  const double affordable = static_cast<double>(options.budget) / points_per_box / static_cast<double>(strips.size());
  const int initial = affordable < enough * enough ? static_cast<int>(std::sqrt(affordable)) : enough;
  if (initial == 0) return unaffordable(ErrorKind::rule_difference);
  for (const Strip& strip : strips) {
    for (int i = 0; i < initial * initial; ++i) {
      const double height = (strip.end - strip.begin) / initial;
      Box box{strip.panel, (0.5 + i % initial) / initial, strip.begin + (0.5 + i / initial) * height, 0.5 / initial,
              0.5 * height};
      rule.measure(box);
      // two rules may agree by accident: what hasn't been halved once isn't believed beyond this
      constexpr double unhalved = 1.0 / 32;
      box.error = std::max(box.error, unhalved * box.magnitude);
      heap.push_back(box);
    }
    evaluations += initial * initial * points_per_box;
  }
  hide_at_borders(integrand, heap, initial);
  std::make_heap(heap.begin(), heap.end());
  Sums sums = sum(heap);
  const auto met = [&] {
    return !sums.unseen_feature && initial == enough &&
           sums.error + rounding_of(sums.magnitude) + integrand.truncation() * std::abs(sums.value) <=
               options.tolerance * std::abs(sums.value);
  };
  std::size_t since_resummed = 0;
  while (std::isfinite(sums.value) && !met() && evaluations + 2 * points_per_box <= options.budget) {
    if (!sums.unseen_feature && sums.error <= rounding_of(sums.magnitude)) break;  // nothing left but rounding
    std::pop_heap(heap.begin(), heap.end());
    const Box parent = heap.back();
    heap.pop_back();
    Box a = parent;
    double Box::*half = parent.split_u ? &Box::half_u : &Box::half_v;
    double Box::*centre = parent.split_u ? &Box::u : &Box::v;
    a.*half /= 2;
    Box b = a;
    a.*centre -= a.*half;
    b.*centre += b.*half;
    rule.measure(a);
    rule.measure(b);
    keep_honest(parent, a, b, panel_of(parent).layered);
    if (panel_of(parent).edged) keep_hidden(parent, a, b);
    evaluations += 2 * points_per_box;
    for (const Box& box : {a, b}) {
      heap.push_back(box);
      std::push_heap(heap.begin(), heap.end());
    }
    // running sums drift by rounding, and only a full sum knows whether a feature is still unseen
    sums.value += a.value + b.value - parent.value;
    sums.error += a.error + b.error - parent.error;
    sums.magnitude += a.magnitude + b.magnitude - parent.magnitude;
    if (++since_resummed * 8 > heap.size() || sums.unseen_feature || met()) {
      sums = sum(heap);
      since_resummed = 0;
    }
  }
  sums = sum(heap);
  const double rounding = rounding_of(sums.magnitude);
  Estimate estimate{sums.value, sums.error + rounding + integrand.truncation() * std::abs(sums.value),
                    ErrorKind::rule_difference, evaluations, Status::converged};
  if (!std::isfinite(sums.value) || !std::isfinite(sums.error)) {
    estimate.status = Status::non_finite;
  } else if (!met()) {
    estimate.status = !sums.unseen_feature && initial == enough && sums.error <= rounding ? Status::rounding_limited
                                                                                          : Status::budget_exhausted;
  }
  return estimate;
}

}  // namespace albedo
