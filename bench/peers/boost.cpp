#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/quadrature/naive_monte_carlo.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>

#include "peers/peer.hpp"

namespace albedo::peers {
namespace {

using boost::math::quadrature::gauss_kronrod;
using boost::math::quadrature::naive_monte_carlo;
using boost::math::quadrature::tanh_sinh;

/// `rule(f, tolerance, error)` integrates a function of one variable over [0, 1]; nested, with u inside.
template <class Rule>
Answer nested(Plane& plane, const Request& request, const Rule& rule) {
  return over_panels(plane, request, [&](int panel) {
    double inner_error = 0;
    const auto along_ray = [&](double v) {
      plane.set_ray(panel, v);
      double error = 0;
      const double value = rule([&plane](double u) { return plane.on_ray(u); }, request.tolerance, error);
      inner_error = std::max(inner_error, error);
      return value;
    };
    Answer answer;
    answer.value = rule(along_ray, request.tolerance, answer.error);
    answer.claimed = answer.error <= request.tolerance * std::abs(answer.value);
    answer.error += inner_error;
    return answer;
  });
}

template <unsigned order>
Peer kronrod() {
  const auto integrate = [](Plane& plane, const Request& request) {
    return nested(plane, request, [](const auto& f, double tolerance, double& error) {
      constexpr unsigned most_halvings = 15;
      return gauss_kronrod<double, order>::integrate(f, 0.0, 1.0, most_halvings, tolerance, &error);
    });
  };
  return {.library = "boost", .rule = "nested gauss_kronrod " + std::to_string(order), .integrate = integrate};
}

Peer tanh_sinh_peer() {
  const auto rules = std::make_shared<tanh_sinh<double>>();
  const auto integrate = [rules](Plane& plane, const Request& request) {
    return nested(plane, request, [&](const auto& f, double tolerance, double& error) {
      return rules->integrate(f, 0.0, 1.0, tolerance, &error);
    });
  };
  return {.library = "boost", .rule = "nested tanh_sinh", .integrate = integrate};
}

/// It has no number of calls: it is asked for a standard error, looks every tenth of a second whether it has it, and is
/// cancelled when the calls are spent.
Peer naive_monte_carlo_peer() {
  const auto integrate = [](Plane& plane, const Request& request) {
    double variance = 0;
    Answer sum = over_panels(plane, request, [&](int panel) {
      const double goal = request.tolerance * request.reference / std::sqrt(plane.panels());
      const auto most = request.calls / plane.panels() * (panel + 1);
      std::function<void()> cancel = [] {};
      const auto f = [&](const std::vector<double>& x) {
        if (plane.evaluations == most) cancel();
        return plane.at(panel, x[0], x[1]);
      };
      naive_monte_carlo<double, decltype(f)> rule(f, {{0.0, 1.0}, {0.0, 1.0}}, goal, true, 1, request.seed);
      cancel = [&rule] { rule.cancel(); };
      Answer answer;
      answer.value = rule.integrate().get();
      answer.error = rule.current_error_estimate();
      variance += answer.error * answer.error;
      return answer;
    });
    sum.error = std::sqrt(variance);
    sum.claimed = sum.claimed && sum.error <= request.tolerance * std::abs(sum.value);
    return sum;
  };
  return {
      .library = "boost", .rule = "naive_monte_carlo", .monte_carlo = true, .threaded = true, .integrate = integrate};
}

}  // namespace

std::vector<Peer> boost_peers() {
  return {kronrod<15>(), kronrod<21>(), kronrod<31>(), kronrod<61>(), tanh_sinh_peer(), naive_monte_carlo_peer()};
}

}  // namespace albedo::peers
