#include <cubature.h>

#include <array>
#include <cmath>

#include "peers/peer.hpp"

namespace albedo::peers {
namespace {

struct Place {
  Plane* plane;
  int panel;
  std::vector<double> u, v;
};

int at_point(unsigned, const double* x, void* data, unsigned, double* value) {
  const Place& place = *static_cast<const Place*>(data);
  *value = place.plane->at(place.panel, x[0], x[1]);
  return 0;
}

int at_points(unsigned, std::size_t count, const double* x, void* data, unsigned, double* values) {
  Place& place = *static_cast<Place*>(data);
  place.u.resize(count), place.v.resize(count);
  for (std::size_t i = 0; i < count; ++i) place.u[i] = inside(x[2 * i]), place.v[i] = x[2 * i + 1];
  place.plane->blocks().points(place.panel, place.u.data(), place.v.data(), values, static_cast<int>(count));
  place.plane->evaluations += static_cast<std::int64_t>(count);
  return 0;
}

/// hcubature, pcubature or their _v, which differ in the integrand's type.
template <class Rule, class Function>
Peer peer(const std::string& name, Rule rule, Function function, bool vectorised) {
  const auto integrate = [=](Plane& plane, const Request& request) {
    Place place{&plane, 0, {}, {}};
    const double absolute = absolute_share(plane, request);
    return over_panels(plane, request, [&](int panel) {
      constexpr std::array low{0.0, 0.0}, high{1.0, 1.0};
      place.panel = panel;
      Answer answer;
      const int code = rule(1, function, &place, 2, low.data(), high.data(), static_cast<std::size_t>(request.budget),
                            absolute, request.tolerance, ERROR_INDIVIDUAL, &answer.value, &answer.error);
      answer.claimed =
          code == 0 && (answer.error <= absolute || answer.error <= request.tolerance * std::abs(answer.value));
      return answer;
    });
  };
  return {.library = "cubature", .rule = name, .vectorised = vectorised, .integrate = integrate};
}

}  // namespace

std::vector<Peer> cubature_peers() {
  return {peer("hcubature", hcubature, at_point, false), peer("pcubature", pcubature, at_point, false),
          peer("hcubature_v", hcubature_v, at_points, true), peer("pcubature_v", pcubature_v, at_points, true)};
}

}  // namespace albedo::peers
