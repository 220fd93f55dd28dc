#include "albedo/core/direction.hpp"

#include <boost/math/special_functions/cos_pi.hpp>
#include <boost/math/special_functions/sin_pi.hpp>
#include <cmath>
#include <limits>
#include <sstream>

#include "albedo/core/errors.hpp"
#include "albedo/core/model.hpp"
#include "albedo/warps/sample.hpp"

namespace albedo {
namespace {

void set_azimuth(Direction& direction, double phi) {
  if (!std::isfinite(phi)) throw ParameterError("phi is not a finite number of degrees");
  const double turn = std::fmod(phi, 360) / 180;
  direction.cos_phi = boost::math::cos_pi(turn);
  direction.sin_phi = boost::math::sin_pi(turn);
}

std::string text(double value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

}  // namespace

Direction Direction::from_degrees(double theta, double phi) {
  if (!(theta >= 0 && theta <= 90)) throw ParameterError("theta is " + text(theta) + "° and must be within [0, 90]");
  Direction direction;
  direction.cos_theta = boost::math::sin_pi((90 - theta) / 180);
  direction.sin_theta = boost::math::sin_pi(theta / 180);
  set_azimuth(direction, phi);
  return direction;
}

Direction Direction::from_cosine(double cos_theta, double phi) {
  if (!(cos_theta >= 0 && cos_theta <= 1)) {
    throw ParameterError("cos_theta is " + text(cos_theta) + " and must be within [0, 1]");
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

template <class T>
T brdf(const Model& model, const Direction& l, const Direction& v) {
  T sum = 0;
  for (const Lobe& lobe : model.lobes()) {
    const UnitVector<T> light = unit_vector<T>(l);
    sum += model.evaluate(lobe.component, direction_pair(light, unit_vector<T>(v), lobe_axis(lobe, light)));
  }
  return sum;
}

Sampled<Block> Model::sample(int, const UnitVector<Block>&, const Block&, const Block&) const noexcept {
  return Sampled<Block>::none();
}
Sampled<double> Model::sample(int, const UnitVector<double>&, double, double) const noexcept {
  return Sampled<double>::none();
}
Sampled<Quad> Model::sample(int, const UnitVector<Quad>&, const Quad&, const Quad&) const {
  return Sampled<Quad>::none();
}
double Model::density(int, const UnitVector<double>&, const UnitVector<double>&) const noexcept {
  return std::numeric_limits<double>::quiet_NaN();
}
double Model::facet_distribution(const DirectionPair<double>&) const noexcept {
  return std::numeric_limits<double>::quiet_NaN();
}
double Model::facet_masking(const DirectionPair<double>&) const noexcept {
  return std::numeric_limits<double>::quiet_NaN();
}

template double brdf<double>(const Model&, const Direction&, const Direction&);
template float brdf<float>(const Model&, const Direction&, const Direction&);
template Quad brdf<Quad>(const Model&, const Direction&, const Direction&);

}  // namespace albedo
