/// @file
/// How an axis becomes the variable of a Chebyshev series.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace albedo {

/// A map of the values of an axis to [−1, 1], between its least and its largest one:
///
///     ln(value − least + shift)   or, with an infinite shift, the value itself
///
/// A small shift resolves the decades next to the least value: grazing cosines, small roughnesses. An angle theta
/// (degrees) goes by its cosine. An azimuth (degrees) is folded to [0, 90], or goes by cos 2φ, if the albedo has the
/// symmetries of an ellipse: cos 2φ makes the series a Fourier series of period 180°.
class ProxyVariable {
 public:
  enum class Coordinate { value, cosine_of, folded, cosine_of_twice };

  ProxyVariable(Coordinate coordinate, double least, double largest, double shift);

  /// Whether a value is within the axis, but for rounding; a folded azimuth always is.
  [[nodiscard]] bool contains(double value) const;
  [[nodiscard]] double of(double value) const;    ///< in [−1, 1]; what contains() denies counts as the nearer end
  [[nodiscard]] double value_at(double u) const;  ///< the inverse; of all azimuths with that u, the one in [0, 90]
  [[nodiscard]] Coordinate coordinate() const { return coordinate_; }

 private:
  [[nodiscard]] double coordinate_of(double value) const;
  [[nodiscard]] double raw(double coordinate) const;

  Coordinate coordinate_;
  double least_, largest_;  ///< of the coordinate
  double shift_;
};

/// The azimuth in [0, 90] that mirrors at both axes of an ellipse take it to; in degrees.
double folded_azimuth(double phi);

/// The variable that an axis of that name is looked at with first, and others that may need fewer terms.
std::vector<ProxyVariable> proxy_variables(const std::string& axis, double least, double largest, bool is_elliptic);

/// cos(πj/(size − 1)), from 1 down and exactly antisymmetric; 0 for one.
std::vector<double> lobatto_points(std::size_t size);

/// size × size: values at those points to the coefficients of T_0 … T_{size−1}.
std::vector<double> chebyshev_transform(std::size_t size);

/// T_0(u) … T_{size−1}(u), `stride` apart.
void chebyshev(double u, std::size_t size, double* out, std::size_t stride = 1);

}  // namespace albedo
