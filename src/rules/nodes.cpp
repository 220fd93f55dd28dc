#include "rules/nodes.hpp"

#include <Eigen/Eigenvalues>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "rules/make_nodes.hpp"

namespace albedo {
namespace detail {

/// Recurrence coefficients from the moments Γ(k/2 + 1)/2 (Chebyshev's algorithm), which takes more digits than are
/// kept; then the eigenvalues of the Jacobi matrix (Golub and Welsch).
Nodes<double> gaussian_nodes(int n) {
  using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;
  const auto size = static_cast<std::size_t>(n);
  std::vector<Wide> previous(2 * size, Wide(0)), current(2 * size), next(2 * size);
  for (std::size_t k = 0; k < 2 * size; ++k) current[k] = boost::math::tgamma(Wide(k) / 2 + 1) / 2;
  Eigen::VectorXd diagonal(n), below(n - 1);
  Wide alpha = current[1] / current[0], beta = 0;
  diagonal[0] = static_cast<double>(alpha);
  for (std::size_t k = 1; k < size; ++k) {
    for (std::size_t l = k; l < 2 * size - k; ++l) next[l] = current[l + 1] - alpha * current[l] - beta * previous[l];
    beta = next[k] / current[k - 1];
    alpha = next[k + 1] / next[k] - current[k] / current[k - 1];
    diagonal[static_cast<Eigen::Index>(k)] = static_cast<double>(alpha);
    below[static_cast<Eigen::Index>(k) - 1] = static_cast<double>(sqrt(beta));
    std::swap(previous, current);
    std::swap(current, next);
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, below);
  Nodes<double> nodes;
  nodes.terms = n;
  nodes.transform.resize(size * size);
  for (int i = 0; i < n; ++i) {
    const double r = solver.eigenvalues()[i], first = solver.eigenvectors()(0, i);
    const double weight = first * first / 2 / (r * std::exp(-r * r));
    nodes.position.push_back(r);
    nodes.weight.push_back(weight);
    for (int k = 0; k < n; ++k) {
      nodes.transform[static_cast<std::size_t>(i) * size + static_cast<std::size_t>(k)] =
          weight * solver.eigenvectors()(k, i) / first;
    }
  }
  return nodes;
}

}  // namespace detail

template Nodes<double> make_nodes(AxisKind, int, int);

}  // namespace albedo
