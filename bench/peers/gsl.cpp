#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_monte_miser.h>
#include <gsl/gsl_monte_plain.h>
#include <gsl/gsl_monte_vegas.h>
#include <gsl/gsl_rng.h>

#include <array>
#include <cmath>
#include <memory>

#include "peers/peer.hpp"

namespace albedo::peers {
namespace {

constexpr std::size_t dimensions = 2;

template <auto release>
struct Release {
  template <class T>
  void operator()(T* pointer) const {
    release(pointer);
  }
};
template <class T, auto release>
using Handle = std::unique_ptr<T, Release<release>>;

using Cquad = Handle<gsl_integration_cquad_workspace, gsl_integration_cquad_workspace_free>;
using Random = Handle<gsl_rng, gsl_rng_free>;

/// A 1-D integral of cquad's within another.
struct Nest {
  Plane* plane;
  int panel;
  double absolute, relative;  // of the inner ones
  gsl_integration_cquad_workspace* workspace;
  double inner_error;
};

double on_ray(double u, void* data) { return static_cast<Plane*>(data)->on_ray(u); }

double along_ray(double v, void* data) {
  Nest& nest = *static_cast<Nest*>(data);
  nest.plane->set_ray(nest.panel, v);
  const gsl_function function{on_ray, nest.plane};
  double value = 0, error = 0;
  gsl_integration_cquad(&function, 0, 1, nest.absolute, nest.relative, nest.workspace, &value, &error, nullptr);
  nest.inner_error = std::max(nest.inner_error, error);
  return value;
}

/// Inner integrals are asked for a tenth of the tolerance, relative or of the whole integral, so that the outer rule
/// doesn't chase their noise.
Peer cquad() {
  constexpr std::size_t intervals = 100;
  const std::shared_ptr<Cquad::element_type> inner{Cquad(gsl_integration_cquad_workspace_alloc(intervals))},
      outer{Cquad(gsl_integration_cquad_workspace_alloc(intervals))};
  const auto integrate = [=](Plane& plane, const Request& request) {
    const double absolute = absolute_share(plane, request), inner_tolerance = request.tolerance / 10;
    return over_panels(plane, request, [&](int panel) {
      Nest nest{&plane, panel, inner_tolerance * request.reference / plane.panels(), inner_tolerance, inner.get(), 0};
      const gsl_function function{along_ray, &nest};
      Answer answer;
      const int code = gsl_integration_cquad(&function, 0, 1, absolute, request.tolerance, outer.get(), &answer.value,
                                             &answer.error, nullptr);
      answer.claimed = code == GSL_SUCCESS &&
                       (answer.error <= absolute || answer.error <= request.tolerance * std::abs(answer.value));
      answer.error += nest.inner_error;
      return answer;
    });
  };
  return {.library = "gsl", .rule = "nested cquad", .integrate = integrate};
}

struct Place {
  Plane* plane;
  int panel;
};

double at_point(double* x, std::size_t, void* data) {
  const Place& place = *static_cast<const Place*>(data);
  return place.plane->at(place.panel, x[0], x[1]);
}

/// plain, miser or vegas, which differ in the type of their state.
template <class State, class Allocate, class Start, class Rule>
Peer monte_carlo(const std::string& name, Allocate allocate, Start start, void (*release)(State*), Rule rule) {
  const std::shared_ptr<State> state(allocate(dimensions), release);
  const std::shared_ptr<gsl_rng> random{Random(gsl_rng_alloc(gsl_rng_taus2))};
  const auto integrate = [=](Plane& plane, const Request& request) {
    gsl_rng_set(random.get(), request.seed);
    double variance = 0;
    Answer sum = over_panels(plane, request, [&](int panel) {
      constexpr std::array low{0.0, 0.0}, high{1.0, 1.0};
      Place place{&plane, panel};
      gsl_monte_function function{at_point, dimensions, &place};
      start(state.get());
      Answer answer;
      rule(&function, low.data(), high.data(), dimensions, static_cast<std::size_t>(request.calls / plane.panels()),
           random.get(), state.get(), &answer.value, &answer.error);
      variance += answer.error * answer.error;
      return answer;
    });
    sum.error = std::sqrt(variance);
    sum.claimed = sum.claimed && sum.error <= request.tolerance * std::abs(sum.value);
    return sum;
  };
  return {.library = "gsl", .rule = name, .monte_carlo = true, .integrate = integrate};
}

}  // namespace

std::vector<Peer> gsl_peers() {
  gsl_set_error_handler_off();  // a rule that gives up says so by its code
  const auto plain = [](auto* f, auto* low, auto* high, auto... rest) {
    return gsl_monte_plain_integrate(f, low, high, rest...);
  };
  const auto miser = [](auto* f, auto* low, auto* high, auto... rest) {
    return gsl_monte_miser_integrate(f, low, high, rest...);
  };
  const auto vegas = [](auto* f, auto* low, auto* high, auto n, auto calls, auto... rest) {
    constexpr std::size_t iterations = 5;  // vegas's own default, each of so many calls
    std::array from{low[0], low[1]}, to{high[0], high[1]};
    return gsl_monte_vegas_integrate(f, from.data(), to.data(), n, calls / iterations, rest...);
  };
  return {cquad(), monte_carlo("plain", gsl_monte_plain_alloc, gsl_monte_plain_init, gsl_monte_plain_free, plain),
          monte_carlo("miser", gsl_monte_miser_alloc, gsl_monte_miser_init, gsl_monte_miser_free, miser),
          monte_carlo("vegas", gsl_monte_vegas_alloc, gsl_monte_vegas_init, gsl_monte_vegas_free, vegas)};
}

}  // namespace albedo::peers
