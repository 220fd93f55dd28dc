#include "plots/render/colour.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <sstream>
#include <string>

#include "albedo/core/errors.hpp"
#include "albedo/microfacet/fresnel.hpp"
#include "plots/render/spectra.hpp"

namespace albedo::render {
namespace {

constexpr double first_wavelength = 400, band_width = 40;

/// The fields of every line of figures.
std::vector<std::vector<std::string>> rows(std::string_view csv) {
  std::vector<std::vector<std::string>> result;
  std::istringstream lines{std::string(csv)};
  bool heading = true;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    if (std::exchange(heading, false)) continue;
    std::istringstream fields(line);
    std::vector<std::string>& row = result.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
  }
  return result;
}

using Matrix3 = Eigen::Matrix3d;
using Bands = Eigen::Matrix<double, 3, block_width>;

/// XYZ of a unit in each band, with Y = 1 for a unit in all of them. A figure on the border of two bands counts half.
Bands xyz_of_bands() {
  Bands result = Bands::Zero();
  for (const auto& row : rows(cie1931_csv)) {
    const Vector xyz(std::stod(row[1]), std::stod(row[2]), std::stod(row[3]));
    const double place = (std::stod(row[0]) - first_wavelength) / band_width;
    for (int band = 0; band < block_width; ++band) {
      if (place < band || place > band + 1) continue;
      result.col(band) += (place == band || place == band + 1 ? 0.5 : 1) * xyz;
    }
  }
  return result / result.row(1).sum();
}

Matrix3 matrix(const std::array<double, 9>& rows_first) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows_first.data());
}

/// XYZ of the primaries and the white of sRGB [IEC 61966-2-1], from their chromaticities.
Matrix3 xyz_of_rgb() {
  const Matrix3 primaries = matrix({0.64, 0.30, 0.15, 0.33, 0.60, 0.06, 0.03, 0.10, 0.79});
  const Vector white(0.3127 / 0.3290, 1, 0.3583 / 0.3290);
  const Vector strength = primaries.inverse() * white;
  return primaries * strength.asDiagonal();
}

/// Red, green and blue of the bands; light that is the same in all of them is (1, 1, 1).
Bands rgb_of_bands() {
  // Bradford's cone responses [Lam 1985], scaled from this light's white to D65
  const Matrix3 bradford = matrix({0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296});
  const Bands xyz = xyz_of_bands();
  const Matrix3 to_xyz = xyz_of_rgb();
  const Vector here = bradford * xyz.rowwise().sum(), there = bradford * to_xyz.rowwise().sum();
  const Vector scale = there.cwiseQuotient(here);
  return to_xyz.inverse() * bradford.inverse() * scale.asDiagonal() * bradford * xyz;
}

}  // namespace

const std::array<double, block_width> wavelengths{420, 460, 500, 540, 580, 620, 660, 700};

Metal metal(std::string_view element) {
  Metal result{Spectrum(0), Spectrum(0)};
  int found = 0;
  for (const auto& row : rows(metals_csv)) {
    if (row[0] != element) continue;
    for (int band = 0; band < block_width; ++band) {
      if (std::stod(row[1]) != wavelengths[static_cast<std::size_t>(band)]) continue;
      result.n.set(band, std::stod(row[2]));
      result.k.set(band, std::stod(row[3]));
      ++found;
    }
  }
  if (found != block_width) {
    throw ParameterError("metal: '" + std::string(element) + "' is not known; there are Al, Ag, Cu and Au");
  }
  return result;
}

Reflectance conductor(const Metal& metal) {
  return [metal](double cos_theta_d) {
    return Spectrum::generate([&](int band) {
      const Fresnel fresnel{.kind = FresnelKind::conductor, .eta = metal.n[band], .k = metal.k[band]};
      return fresnel(cos_theta_d);
    });
  };
}

Reflectance schlick(const Colour& normal) {
  return [normal](double cos_theta_d) {
    const auto factor = [&](std::size_t i) { return Fresnel{.f0 = normal[i]}(cos_theta_d); };
    return rgb(factor(0), factor(1), factor(2));
  };
}

Colour colour_of_bands(const Spectrum& spectrum) {
  static const Bands matrix = rgb_of_bands();
  Eigen::Matrix<double, block_width, 1> bands;
  spectrum.store(bands.data());
  const Vector colour = matrix * bands;
  return {colour.x(), colour.y(), colour.z()};
}

Spectrum luminance_of_bands() {
  const Bands xyz = xyz_of_bands();
  return Spectrum::generate([&](int band) { return xyz(1, band); });
}

}  // namespace albedo::render
