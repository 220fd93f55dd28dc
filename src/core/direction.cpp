#include "albedo/core/direction.hpp"

#include <boost/math/special_functions/cos_pi.hpp>
#include <boost/math/special_functions/sin_pi.hpp>
#include <cmath>
#include <limits>

#include "albedo/core/errors.hpp"
#include "core/text.hpp"

namespace albedo {
namespace {

void set_azimuth(Direction& direction, double phi) {
  if (!std::isfinite(phi)) throw ParameterError("phi is not a finite number of degrees");
  const double turn = std::fmod(phi, 360) / 180;
  direction.cos_phi = boost::math::cos_pi(turn);
  direction.sin_phi = boost::math::sin_pi(turn);
}

}  // namespace

Direction Direction::from_degrees(double theta, double phi) {
  if (!(theta >= 0 && theta <= 90))
    throw ParameterError(fmt::format("theta is {:g}° and must be within [0, 90]", theta));
  Direction direction;
  direction.cos_theta = boost::math::sin_pi((90 - theta) / 180);
  direction.sin_theta = boost::math::sin_pi(theta / 180);
  set_azimuth(direction, phi);
  return direction;
}

Direction Direction::from_cosine(double cos_theta, double phi) {
  if (!(cos_theta >= 0 && cos_theta <= 1)) {
    throw ParameterError(fmt::format("cos_theta is {:g} and must be within [0, 1]", cos_theta));
  }
  Direction direction;
  direction.cos_theta = cos_theta;
  direction.sin_theta = std::sqrt((1 - cos_theta) * (1 + cos_theta));
  set_azimuth(direction, phi);
  return direction;
}

double Direction::theta_degrees() const {
  return std::atan2(sin_theta, cos_theta) * 180 / boost::math::constants::pi<double>();
}

}  // namespace albedo
