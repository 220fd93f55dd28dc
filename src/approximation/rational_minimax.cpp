#include "approximation/rational_minimax.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace albedo {
namespace {

using Real = MinimaxProblem::Real;
using Vector = MinimaxProblem::Vector;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

struct Levelled {
  Vector p, q;
  Real level;  ///< errors on the reference are ±level
};

Real sign_of(Eigen::Index i) { return i % 2 == 0 ? 1 : -1; }

/// p/q whose relative errors on the reference are level, −level, level …; nothing if each has a pole between its ends.
///
/// For polynomials g of degree m + n and less, Σ w_k g(u_k) = 0 with w_k = 1/Π(u_k − u_j), whose signs alternate. With
/// g = T_i p = T_i (f_k ∓ level s_k) q it is a symmetric eigenvalue problem in q, definite on the right.
std::optional<Levelled> levelled(const MinimaxProblem& problem, const std::vector<int>& reference, int m, int n) {
  const auto count = static_cast<Eigen::Index>(reference.size());
  const Vector u = problem.u(reference), f = problem.f(reference), s = problem.s(reference);
  Vector logs(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    logs[k] = 0;
    for (Eigen::Index j = 0; j < count; ++j) {
      if (j != k) logs[k] -= std::log(std::abs(u[k] - u[j]));
    }
  }
  const Vector d = ((logs.array() - logs.maxCoeff()).exp() * s.array()).sqrt();
  const Eigen::HouseholderQR<Matrix> qr(d.asDiagonal() * chebyshev_basis(u, n));
  const Matrix orthogonal = qr.householderQ() * Matrix::Identity(count, n + 1);
  Vector signed_values = f.cwiseQuotient(s);
  for (Eigen::Index k = 1; k < count; k += 2) signed_values[k] = -signed_values[k];
  const Matrix symmetric = orthogonal.transpose() * signed_values.asDiagonal() * orthogonal;
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(symmetric);
  if (solver.info() != Eigen::Success) return std::nullopt;
  for (Eigen::Index i = 0; i <= n; ++i) {
    const Vector vector = solver.eigenvectors().col(i);
    Vector denominator = (orthogonal * vector).cwiseQuotient(d);
    if (!(denominator.minCoeff() * denominator.maxCoeff() > 0)) continue;
    const Vector q = qr.matrixQR().topRows(n + 1).triangularView<Eigen::Upper>().solve(vector);
    const Real level = solver.eigenvalues()[i];
    Vector numerator(count);
    for (Eigen::Index k = 0; k < count; ++k) numerator[k] = (f[k] - sign_of(k) * level * s[k]) * denominator[k];
    const Vector row = (s.cwiseProduct(denominator)).cwiseInverse();
    const Matrix basis = row.asDiagonal() * chebyshev_basis(u, m);
    return Levelled{basis.householderQr().solve(row.cwiseProduct(numerator)), q, level};
  }
  return std::nullopt;
}

/// The indices of the largest errors of alternating sign, `size` of them; empty if there are fewer.
std::vector<int> alternation(const Vector& errors, std::size_t size) {
  std::vector<int> peaks;
  const auto magnitude = [&](int i) { return std::abs(errors[i]); };
  for (int i = 0; i < errors.size();) {
    int peak = i, end = i;
    for (; end < errors.size() && (errors[end] > 0) == (errors[i] > 0); ++end) {
      if (magnitude(end) > magnitude(peak)) peak = end;
    }
    peaks.push_back(peak);
    i = end;
  }
  if (peaks.size() < size) return {};
  while (peaks.size() > size) {
    if (peaks.size() == size + 1) {
      if (magnitude(peaks.front()) < magnitude(peaks.back())) {
        peaks.erase(peaks.begin());
      } else {
        peaks.pop_back();
      }
      continue;
    }
    const auto smallest = std::ranges::min_element(peaks, {}, magnitude);
    if (smallest == peaks.begin() || smallest == peaks.end() - 1) {
      peaks.erase(smallest);
    } else {  // with a neighbour, or signs would no longer alternate
      const auto first = magnitude(*(smallest - 1)) < magnitude(*(smallest + 1)) ? smallest - 1 : smallest;
      peaks.erase(first, first + 2);
    }
  }
  return peaks;
}

}  // namespace

Matrix chebyshev_basis(const Vector& u, int degree) {
  Matrix basis(u.size(), degree + 1);
  basis.col(0).setOnes();
  if (degree > 0) basis.col(1) = u;
  for (int k = 2; k <= degree; ++k) basis.col(k) = 2 * u.cwiseProduct(basis.col(k - 1)) - basis.col(k - 2);
  return basis;
}

std::vector<int> chebyshev_reference(const MinimaxProblem& problem, int size) {
  const auto count = static_cast<int>(problem.u.size());
  std::vector<int> reference;
  for (int k = 0; k < size; ++k) {
    const Real u = -std::cos(std::numbers::pi_v<Real> * k / (size - 1));
    const auto at = std::lower_bound(problem.u.data(), problem.u.data() + count, u) - problem.u.data();
    reference.push_back(static_cast<int>(at));
  }
  return resized_reference(reference, size, count);
}

std::vector<int> resized_reference(const std::vector<int>& reference, int size, int count) {
  const auto last = static_cast<double>(reference.size() - 1);
  std::vector<int> result;
  for (int k = 0; k < size; ++k) {
    const double place = last * k / (size - 1);
    const auto i = std::min(static_cast<std::size_t>(place), reference.size() - 2);
    const double after = place - static_cast<double>(i);
    result.push_back(static_cast<int>(std::lround(reference[i] * (1 - after) + reference[i + 1] * after)));
  }
  for (int k = 0; k < size; ++k) {  // distinct, and among the abscissas
    const auto i = static_cast<std::size_t>(k);
    result[i] = std::clamp(result[i], k == 0 ? 0 : result[i - 1] + 1, count - size + k);
  }
  return result;
}

Minimax rational_minimax(const MinimaxProblem& problem, int m, int n, std::vector<int> reference) {
  constexpr int most_steps = 60;
  constexpr double near = 1.01, rounding = 1e-15;
  Minimax best;
  const Matrix basis = chebyshev_basis(problem.u, std::max(m, n));
  for (int step = 0; step < most_steps; ++step) {
    const std::optional<Levelled> here = levelled(problem, reference, m, n);
    if (!here) break;
    const Vector denominator = basis.leftCols(n + 1) * here->q;
    const Vector errors =
        ((basis.leftCols(m + 1) * here->p).cwiseQuotient(denominator) - problem.f).cwiseQuotient(problem.s);
    const auto worst = static_cast<double>(errors.cwiseAbs().maxCoeff());
    const bool has_pole = !(denominator.minCoeff() * denominator.maxCoeff() > 0);
    if (!has_pole && std::isfinite(worst)) {
      const auto level = static_cast<double>(std::abs(here->level));
      best.least = std::max(best.least, level);
      if (worst < best.error) {
        best.p = here->p, best.q = here->q, best.error = worst, best.reference = reference;
      }
      best.converged = worst <= std::max(near * level, rounding);
      if (best.converged) break;
    }
    std::vector<int> next = alternation(errors, reference.size());
    if (next.empty() || next == reference) break;
    reference = std::move(next);
  }
  return best;
}

}  // namespace albedo
