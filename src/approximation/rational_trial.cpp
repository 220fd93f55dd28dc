#include "approximation/rational_trial.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>

namespace albedo {
namespace {

using Real = MinimaxProblem::Real;
using Vector = MinimaxProblem::Vector;

/// Zeros u of Σ c_k T_k(u): eigenvalues of the colleague matrix   [Good 1961]. Fewer where leading coefficients vanish.
std::vector<std::complex<Real>> chebyshev_zeros(const Vector& c) {
  constexpr Real negligible = 1e-17L;
  Eigen::Index n = c.size() - 1;
  while (n > 0 && std::abs(c[n]) <= negligible * c.cwiseAbs().maxCoeff()) --n;
  if (n == 0) return {};
  Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> colleague(n, n);
  colleague.setZero();
  for (Eigen::Index k = 0; k + 1 < n; ++k) {
    colleague(k, k + 1) = k == 0 ? 1 : 0.5L;
    colleague(k + 1, k) = 0.5L;
  }
  const Real leading = (n == 1 ? 1 : 2) * c[n];
  for (Eigen::Index k = 0; k < n; ++k) colleague(n - 1, k) -= c[k] / leading;
  const auto eigenvalues = colleague.eigenvalues().eval();
  return {eigenvalues.begin(), eigenvalues.end()};
}

/// Whether a zero lies within [first, last], or a pair on the axis.
bool vanishes(const RealFactors& factors, double first, double last) {
  return std::ranges::any_of(factors.roots, [&](double root) { return root >= first && root <= last; }) ||
         std::ranges::any_of(factors.pairs, [](const RealFactors::Pair& pair) { return !(pair.v2 > 0); });
}

}  // namespace

RationalTrial::RationalTrial(RationalForm form, const std::vector<RationalSample>& samples)
    : form_(std::move(form)), samples_(&samples) {
  const auto count = static_cast<Eigen::Index>(samples.size());
  x_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    x_[i] = form_.x(static_cast<Real>(samples[static_cast<std::size_t>(i)].cos_theta));
  }
  first_ = x_[0];
  const Real length = x_[count - 1] - first_;
  // A Möbius map leaves rational functions what they are; this one puts as much of the albedo's change on either side.
  std::vector<double> change{0};
  for (std::size_t i = 1; i < samples.size(); ++i) {
    change.push_back(change.back() + std::abs(samples[i].value - samples[i - 1].value) / samples[i].scale);
  }
  const auto half = std::ranges::lower_bound(change, change.back() / 2) - change.begin();
  middle_ = change.back() > 0 ? std::max(x_[half] - first_, 1e-3L * length) : length;
  reach_ = length / (length + middle_);
}

/// For a numerator that has `excess` more degrees in x than the denominator, both of them divided by a power of x −
/// first + middle, which makes them polynomials in u.
MinimaxProblem RationalTrial::problem_of(int excess) const {
  const auto count = static_cast<Eigen::Index>(samples_->size());
  MinimaxProblem problem{.u = Vector(count), .f = Vector(count), .s = Vector(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [cos_theta, value, scale] = (*samples_)[static_cast<std::size_t>(i)];
    const Real from = x_[i] - first_ + middle_, e = form_.exponent;
    problem.u[i] = 2 / reach_ * (x_[i] - first_) / from - 1;
    const Real rest = static_cast<Real>(value) / form_.leading(static_cast<Real>(cos_theta));
    problem.f[i] = std::pow(rest, e) * std::pow(from, -excess);
    problem.s[i] = rest == 0 ? static_cast<Real>(scale) : problem.f[i] / value * (e * scale);
    problem.s[i] = std::abs(problem.s[i]);
  }
  return problem;
}

void RationalTrial::attempt(RationalType type, const std::vector<int>& reference) {
  Minimax& known = found_[type];
  if (known.converged) return;
  const auto [m, n] = type;
  Minimax found = rational_minimax(problem_of(m - n), m, n, reference);
  if (found.error < known.error) known = std::move(found);
}

void RationalTrial::attempt(RationalType type) {
  const auto [m, n] = type;
  const int size = m + n + 2;
  for (const RationalType& lower : {RationalType{m - 1, n - 1}, {std::min(m, n), std::min(m, n)}}) {
    const auto known = found_.find(lower);
    if (lower == type || known == found_.end() || known->second.reference.empty()) continue;
    attempt(type, resized_reference(known->second.reference, size, static_cast<int>(samples_->size())));
  }
  attempt(type, chebyshev_reference(problem_of(0), size));
}

RealFactors RationalTrial::factors_of(const Vector& coefficients) const {
  RealFactors factors;
  for (const std::complex<Real>& u : chebyshev_zeros(coefficients)) {
    const std::complex<Real> t = (u + Real(1)) * (reach_ / 2), x = first_ + middle_ * t / (Real(1) - t);
    if (u.imag() == 0) {
      factors.roots.push_back(static_cast<double>(x.real()));
    } else if (u.imag() > 0) {
      factors.pairs.push_back({static_cast<double>(x.real()), static_cast<double>(x.imag() * x.imag())});
    }
  }
  const auto degree = static_cast<std::size_t>(coefficients.size()) - 1;
  while (factors.coefficients() < degree) factors.roots.push_back(static_cast<double>(first_ - middle_));
  std::ranges::sort(factors.roots);
  std::ranges::sort(factors.pairs, {}, &RealFactors::Pair::u);
  return factors;
}

std::optional<RationalForm> RationalTrial::form(RationalType type) {
  const Minimax& found = best(type);
  if (found.p.size() == 0) return std::nullopt;
  RationalForm form = form_;
  form.p = factors_of(found.p), form.q = factors_of(found.q);
  const auto first = static_cast<double>(first_), last = static_cast<double>(x_[x_.size() - 1]);
  if (vanishes(form.q, first, last) || (form.exponent > 1 && vanishes(form.p, first, last))) return std::nullopt;
  const MinimaxProblem problem = problem_of(type.first - type.second);
  const Eigen::Index at = x_.size() / 2;
  const Vector u = problem.u.segment(at, 1);
  const Real value = (chebyshev_basis(u, type.first) * found.p)[0] / (chebyshev_basis(u, type.second) * found.q)[0] *
                     std::pow(x_[at] - first_ + middle_, type.first - type.second);
  form.gain = static_cast<double>(value * form.q.times(Real(1), x_[at]) / form.p.times(Real(1), x_[at]));
  if (!std::isfinite(form.gain)) return std::nullopt;
  return form;
}

}  // namespace albedo
