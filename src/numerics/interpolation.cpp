#include "numerics/interpolation.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace albedo {
namespace {

/// The interval [x_j, x_{j+1}] that t is in, or the nearest.
std::size_t interval(const std::vector<double>& x, double t) {
  const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, t);
  return static_cast<std::size_t>(above - x.begin()) - 1;
}

/// The unit vector w with the smallest |A w|, by inverse iteration on RᵀR: the half of the digits that its eigenvalues
/// lose are not needed by its vectors.
Eigen::VectorXd smallest_singular_vector(const Eigen::MatrixXd& a) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(a);
  Eigen::MatrixXd r = qr.matrixQR().topRows(a.cols()).triangularView<Eigen::Upper>();
  const double tiny = 1e-18 * r.diagonal().cwiseAbs().maxCoeff() + 1e-300;
  for (Eigen::Index i = 0; i < r.rows(); ++i) {
    if (std::abs(r(i, i)) < tiny) r(i, i) = tiny;
  }
  Eigen::VectorXd w(a.cols());
  for (Eigen::Index j = 0; j < w.size(); ++j) w[j] = j % 2 == 0 ? 1 : -1;
  for (int step = 0; step < 4; ++step) {
    w = r.transpose().triangularView<Eigen::Lower>().solve(w);
    w.normalize();
    w = r.triangularView<Eigen::Upper>().solve(w);
    w.normalize();
  }
  return w;
}

}  // namespace

double rational(const std::vector<double>& x, const std::vector<double>& f, const std::vector<double>& w, double t) {
  double numerator = 0, denominator = 0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (t == x[j]) return f[j];
    const double term = w[j] / (t - x[j]);
    numerator += term * f[j];
    denominator += term;
  }
  return numerator / denominator;
}

std::vector<double> rational_weights(const std::vector<double>& x, const std::vector<double>& f,
                                     const std::vector<std::size_t>& support) {
  const auto columns = static_cast<Eigen::Index>(support.size());
  Eigen::MatrixXd loewner(static_cast<Eigen::Index>(x.size()) - columns, columns);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::binary_search(support.begin(), support.end(), i)) continue;
    for (Eigen::Index j = 0; j < columns; ++j) {
      const std::size_t s = support[static_cast<std::size_t>(j)];
      loewner(row, j) = (f[i] - f[s]) / (x[i] - x[s]);
    }
    ++row;
  }
  const Eigen::VectorXd w = smallest_singular_vector(loewner);
  return {w.begin(), w.end()};
}

std::size_t pole(const std::vector<double>& x, const std::vector<double>& w) {
  constexpr int steps = 16;
  for (std::size_t j = 0; j + 1 < x.size(); ++j) {
    if (!(w[j] * w[j + 1] < 0)) return j;  // the denominator then changes sign between them [Schneider & Werner 1986]
    for (int step = 1; step < steps; ++step) {
      const double t = x[j] + (x[j + 1] - x[j]) * step / steps;
      double denominator = 0;
      for (std::size_t k = 0; k < x.size(); ++k) denominator += w[k] / (t - x[k]);
      if (!(denominator * w[j] > 0)) return j;
    }
  }
  return x.size();
}

std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& f) {
  const std::size_t last = x.size() - 1;
  std::vector<double> width(last), secant(last), slopes(x.size());
  for (std::size_t j = 0; j < last; ++j) {
    width[j] = x[j + 1] - x[j];
    secant[j] = (f[j + 1] - f[j]) / width[j];
  }
  for (std::size_t j = 1; j < last; ++j) {
    if (!(secant[j - 1] * secant[j] > 0)) continue;  // an extremum, or flat
    const double before = 2 * width[j] + width[j - 1], after = width[j] + 2 * width[j - 1];
    slopes[j] = (before + after) / (before / secant[j - 1] + after / secant[j]);
  }
  // the slope of the parabola through three points, held to what keeps the last interval monotone
  const auto end = [](double h, double h_next, double s, double s_next) {
    const double slope = ((2 * h + h_next) * s - h * s_next) / (h + h_next);
    if (!(slope * s > 0)) return 0.0;
    return std::abs(slope) > 3 * std::abs(s) ? 3 * s : slope;
  };
  slopes[0] = end(width[0], width[1], secant[0], secant[1]);
  slopes[last] = end(width[last - 1], width[last - 2], secant[last - 1], secant[last - 2]);
  return slopes;
}

double monotone(const std::vector<double>& x, const std::vector<double>& f, const std::vector<double>& slopes,
                double t) {
  const std::size_t j = interval(x, t);
  const double width = x[j + 1] - x[j], s = (t - x[j]) / width, r = 1 - s;
  return r * r * ((1 + 2 * s) * f[j] + s * width * slopes[j]) +
         s * s * ((1 + 2 * r) * f[j + 1] - r * width * slopes[j + 1]);
}

}  // namespace albedo
