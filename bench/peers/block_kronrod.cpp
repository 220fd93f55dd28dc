#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "peers/peer.hpp"

namespace albedo::peers {
namespace {

/// Boost's nodes and weights on [0, 1]; Gauss's weight is 0 at Kronrod's own nodes.
template <unsigned order>
struct Nodes {
  std::array<double, order> position, weight, gauss_weight;

  Nodes() {
    using boost::math::quadrature::gauss;
    using boost::math::quadrature::gauss_kronrod;
    constexpr unsigned gauss_order = (order - 1) / 2;
    const auto& places = gauss_kronrod<double, order>::abscissa();
    const auto& weights = gauss_kronrod<double, order>::weights();
    const auto& gauss_weights = gauss<double, gauss_order>::weights();
    std::size_t next = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool shared = i % 2 == (gauss_order % 2 == 1 ? 0 : 1);
      for (const int side : {1, -1}) {
        if (side < 0 && places[i] == 0) continue;
        position[next] = (1 + side * places[i]) / 2;
        weight[next] = weights[i] / 2;
        gauss_weight[next] = shared ? gauss_weights[i / 2] / 2 : 0;
        ++next;
      }
    }
  }
};

/// Divides where Boost's rule would, but for an error that is scaled to the interval, which Boost's isn't.
template <unsigned order>
class NestedKronrod {
 public:
  NestedKronrod(Plane& plane, int panel, double tolerance) : plane_(plane), panel_(panel), tolerance_(tolerance) {}

  Answer run() {
    Answer answer = across(0, 1, most_halvings, 0);
    answer.claimed = answer.error <= tolerance_ * std::abs(answer.value);
    answer.error += inner_error_;
    return answer;
  }

 private:
  static constexpr int most_halvings = 15;
  using Row = std::array<double, order>;

  static const Nodes<order>& nodes() {
    static const Nodes<order> made;
    return made;
  }

  /// Whether Boost's rule would halve: not good enough for the whole, nor for this part's share of its parent's.
  [[nodiscard]] bool refused(const Answer& answer, double share) const {
    return answer.error > tolerance_ * std::abs(answer.value) && answer.error > share && !plane_.spent();
  }

  static Answer sum(const double* values, std::size_t pitch, double width) {
    double kronrod = 0, gauss = 0;
    for (std::size_t i = 0; i < order; ++i) {
      kronrod += nodes().weight[i] * values[i * pitch];
      gauss += nodes().gauss_weight[i] * values[i * pitch];
    }
    return {.value = width * kronrod, .error = width * std::abs(kronrod - gauss)};
  }

  static Row places(double begin, double end) {
    Row result;
    for (std::size_t i = 0; i < order; ++i) result[i] = begin + (end - begin) * nodes().position[i];
    return result;
  }

  Answer along(double v, double begin, double end, int halvings, double share) {
    const Row u = places(begin, end);
    Row values;
    plane_.blocks().grid(panel_, u.data(), order, &v, 1, values.data());
    plane_.evaluations += order;
    return along(values.data(), 1, v, begin, end, halvings, share);
  }

  /// @param pitch from one of the ray's values to the next
  Answer along(const double* values, std::size_t pitch, double v, double begin, double end, int halvings,
               double share) {
    const Answer whole = sum(values, pitch, end - begin);
    if (share == 0) share = tolerance_ * std::abs(whole.value);
    if (halvings == 0 || !refused(whole, share)) return whole;
    const double middle = (begin + end) / 2;
    const Answer left = along(v, begin, middle, halvings - 1, share / 2),
                 right = along(v, middle, end, halvings - 1, share / 2);
    return {.value = left.value + right.value, .error = left.error + right.error};
  }

  /// All rays of a rule at once: their first rules are one grid.
  Answer across(double begin, double end, int halvings, double share) {
    const Row u = places(0, 1), v = places(begin, end);
    std::array<double, std::size_t{order} * order> grid;
    plane_.blocks().grid(panel_, u.data(), order, v.data(), order, grid.data());
    plane_.evaluations += std::int64_t{order} * order;
    Row rays;
    for (std::size_t j = 0; j < order; ++j) {
      const Answer ray = along(grid.data() + j, order, v[j], 0, 1, most_halvings, 0);
      rays[j] = ray.value;
      inner_error_ = std::max(inner_error_, ray.error);
    }
    const Answer whole = sum(rays.data(), 1, end - begin);
    if (share == 0) share = tolerance_ * std::abs(whole.value);
    if (halvings == 0 || !refused(whole, share)) return whole;
    const double middle = (begin + end) / 2;
    const Answer left = across(begin, middle, halvings - 1, share / 2),
                 right = across(middle, end, halvings - 1, share / 2);
    return {.value = left.value + right.value, .error = left.error + right.error};
  }

  Plane& plane_;
  int panel_;
  double tolerance_;
  double inner_error_ = 0;
};

template <unsigned order>
Peer peer() {
  const auto integrate = [](Plane& plane, const Request& request) {
    return over_panels(plane, request,
                       [&](int panel) { return NestedKronrod<order>(plane, panel, request.tolerance).run(); });
  };
  return {.library = "boost's nodes",
          .rule = "nested gauss_kronrod " + std::to_string(order) + " in blocks",
          .vectorised = true,
          .integrate = integrate};
}

}  // namespace

std::vector<Peer> block_kronrod_peers() { return {peer<15>(), peer<21>(), peer<31>(), peer<61>()}; }

}  // namespace albedo::peers
