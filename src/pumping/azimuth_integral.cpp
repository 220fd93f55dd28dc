#include "pumping/azimuth_integral.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "warps/sample.hpp"
#include "warps/turn.hpp"

namespace albedo {
namespace {

/// Kronrod's 15 nodes on [−1, 1], their weights, and those of the 7 of Gauss among them.
struct KronrodRule {
  std::array<double, 16> place{}, weight{}, gauss{};  // the last one fills a block and weighs nothing

  KronrodRule() {
    using Kronrod = boost::math::quadrature::gauss_kronrod<double, 15>;
    using Gauss = boost::math::quadrature::gauss<double, 7>;
    for (std::size_t i = 0; i < 8; ++i) {
      const double w = i % 2 == 0 ? Gauss::weights()[i / 2] : 0;
      place[7 + i] = Kronrod::abscissa()[i], weight[7 + i] = Kronrod::weights()[i], gauss[7 + i] = w;
      place[7 - i] = -place[7 + i], weight[7 - i] = weight[7 + i], gauss[7 - i] = w;
    }
  }
};

/// The error of a rule that differs by `change` from one with half its nodes   [Piessens et al. 1983].
double refined_error(double value, double change) {
  const double size = std::abs(value);
  return size > 0 ? size * std::min(1.0, std::pow(200 * change / size, 1.5)) : change;
}

}  // namespace

AzimuthIntegral::AzimuthIntegral(const Model& model, const Direction& l)
    : model_(model),
      lobes_(model.lobes()),
      halved_(model.claims().isotropic),
      l_(unit_vector<double>(l)),
      l_block_(broadcast<Block>(l_)),
      cos_phi_(-l.cos_phi),
      sin_phi_(-l.sin_phi) {}

AzimuthIntegral::Result AzimuthIntegral::operator()(double x, double absolute, double relative) {
  Result sum;
  for (const Lobe& lobe : lobes_) {
    const Ring one = ring(lobe, x);
    Result part;
    constexpr double narrow = 0.1;
    if (one.width < narrow || !over_turn(one, absolute, relative, part)) over_panels(one, absolute, relative, part);
    sum.value += part.value;
    sum.error += part.error;
  }
  return sum;
}

AzimuthIntegral::Ring AzimuthIntegral::ring(const Lobe& lobe, double x) const {
  const UnitVector<double> axis = lobe_axis(lobe, l_);
  Ring ring{lobe, broadcast<Block>(axis), cos_phi_, sin_phi_, std::exp(-x), std::sqrt(-std::expm1(-2 * x)), 4};
  const double planar = std::hypot(axis.x, axis.y);
  if (planar > 0 && (l_.x != 0 || l_.y != 0)) ring.cos_c = axis.x / planar, ring.sin_c = axis.y / planar;
  if (lobe.is<CosineLobe>()) return ring;
  double width = std::min(lobe.widths().narrow, 1.0) / std::max(ring.sin_v, 1e-3);
  // half vectors turn faster than V where both directions are near the horizon
  if (!lobe.is<MirrorLobe>()) width *= std::min(1.0, l_.z + ring.cos_v);
  ring.width = std::clamp(width, 1e-12, 4.0);
  return ring;
}

Block AzimuthIntegral::evaluate(const Ring& ring, const Block& quarters, double side, int count) {
  evaluations_ += count;
  Block sine, cosine;
  sincos_quarter(quarters, sine, cosine);
  sine = side * sine;
  const UnitVector<Block> v{ring.sin_v * (ring.cos_c * cosine - ring.sin_c * sine),
                            ring.sin_v * (ring.sin_c * cosine + ring.cos_c * sine), Block(ring.cos_v)};
  return model_.evaluate(ring.lobe.component, direction_pair(l_block_, v, ring.axis));
}

/// The trapezoidal rule, which is exact to a power of the number of its nodes for a smooth function of period 2π;
/// nodes are doubled. Returns whether that was good enough.
bool AzimuthIntegral::over_turn(const Ring& ring, double absolute, double relative, Result& result) {
  constexpr int first = 8, last = 128;
  const auto sum = [&](int count, double offset, int parts) {  // of nodes (i + offset) π / parts
    double total = 0;
    for (const double side : {1.0, -1.0}) {
      if (side < 0 && halved_) break;
      for (int i = 0; i < count; i += block_width) {
        const int filled = std::min(block_width, count - i);
        const auto place = [&](int lane) { return 2 * (i + std::min(lane, filled - 1) + offset) / parts; };
        const Block f = evaluate(ring, Block::generate(place), side, filled);
        for (int lane = 0; lane < filled; ++lane) {
          const bool is_end = offset == 0 && (i + lane == 0 || i + lane == parts);
          total += (is_end ? 0.5 : 1) * f[lane];
        }
      }
    }
    return total * (halved_ ? 2 : 1);
  };
  double all = sum(first + 1, 0, first), value = all * pi<double> / first;
  for (int parts = first; parts < last; parts *= 2) {
    const double before = value;
    all += sum(parts, 0.5, parts);
    value = all * pi<double> / (2 * parts);
    const double error = refined_error(value, std::abs(value - before));
    if (error > std::max(absolute, relative * std::abs(value))) continue;
    result = {value, error};
    return true;
  }
  return false;
}

AzimuthIntegral::Result AzimuthIntegral::kronrod(const Ring& ring, double begin, double end, double side) {
  static const KronrodRule rule;
  const double middle = (begin + end) / 2, half = (end - begin) / 2, w = ring.width;
  double kronrod = 0, gauss = 0;
  for (std::size_t i = 0; i < 16; i += block_width) {
    const Block e = exp(middle + half * Block::load(rule.place.data() + i)), inverse = 1 / e;
    const Block f = evaluate(ring, w / pi<double> * (e - inverse), side, i == 0 ? 8 : 7) * (w / 2 * (e + inverse));
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      kronrod += rule.weight[i + lane] * f[static_cast<int>(lane)];
      gauss += rule.gauss[i + lane] * f[static_cast<int>(lane)];
    }
  }
  return {kronrod * half, refined_error(kronrod * half, std::abs(kronrod - gauss) * half)};
}

/// Adaptive Gauss–Kronrod rules in t, where the azimuth from the lobe's centre is w sinh t.
void AzimuthIntegral::over_panels(const Ring& ring, double absolute, double relative, Result& result) {
  const double last = std::asinh(pi<double> / ring.width);
  constexpr double first_panel = 2.5, narrowest = 1e-6;
  const int count = std::max(1, static_cast<int>(std::ceil(last / first_panel)));
  for (const double side : {1.0, -1.0}) {
    if (side < 0 && halved_) break;
    std::vector<std::pair<double, double>> open;
    for (int i = count - 1; i >= 0; --i) open.emplace_back(last * i / count, last * (i + 1) / count);
    while (!open.empty()) {
      const auto [begin, end] = open.back();
      open.pop_back();
      const Result part = kronrod(ring, begin, end, side);
      const double allowed = std::max(absolute, relative * (std::abs(result.value) + std::abs(part.value)));
      if (part.error > allowed && end - begin > narrowest * last) {
        open.emplace_back((begin + end) / 2, end);
        open.emplace_back(begin, (begin + end) / 2);
        continue;
      }
      result.value += (halved_ ? 2 : 1) * part.value;
      result.error += (halved_ ? 2 : 1) * part.error;
    }
  }
}

}  // namespace albedo
