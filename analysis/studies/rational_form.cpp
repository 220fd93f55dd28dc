#include "analysis/studies/rational_form.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <complex>
#include <limits>
#include <set>
#include <string>

#include "albedo/core/errors.hpp"
#include "albedo/curve.hpp"
#include "analysis/studies/parallel.hpp"

namespace albedo::analysis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int fitted_places = 320, verified_places = 400;
constexpr double golden = 0.6180339887498949;

struct Place {
  double cos_theta;
  Estimate albedo{};
};

double theta_degrees(double cos_theta) { return Direction::from_cosine(cos_theta).theta_degrees(); }

/// Half of the places evenly over θ, half over ln cosθ; `shift` within (0, 1) moves them between their neighbours.
std::vector<Place> places(int count, double last_theta, double shift, bool has_ends) {
  const double last = Direction::from_degrees(last_theta).cos_theta;
  std::vector<Place> result;
  const int half = count / 2;
  for (int i = 0; i < half; ++i) {
    const double along = (i + shift) / half;
    result.push_back({Direction::from_degrees(last_theta * along).cos_theta});
    result.push_back({std::pow(last, along)});
  }
  if (has_ends) {  // nothing holds a fit from beyond its ends: places crowd there as Chebyshev's do
    result.push_back({1});
    result.push_back({last});
    for (double distance = 0.5 / half; distance > 1e-5; distance /= 3) {
      result.push_back({std::pow(last, distance)});
      result.push_back({std::pow(last, 1 - distance)});
    }
  }
  std::ranges::sort(result, {}, &Place::cos_theta);
  return result;
}

void integrate(const Model& model, const RationalOptions& options, std::vector<Place>& list, RationalFit& fit) {
  AlbedoOptions albedo = options.albedo;
  const double share = is_monte_carlo(albedo.rule) ? 2 : 100;
  albedo.tolerance = std::max(options.tolerance / share, std::min(1e-13, options.tolerance));
  in_parallel(list.size(), options.threads, [&](std::size_t i) {
    list[i].albedo = directional_albedo(model, Direction::from_cosine(list[i].cos_theta, options.phi_degrees), albedo);
  });
  for (const Place& place : list) {
    fit.evaluations += place.albedo.evaluations;
    if (place.albedo.status != Status::converged && fit.status != Status::non_finite) fit.status = place.albedo.status;
  }
}

/// What errors are relative to, at each place.
double scale_of(double albedo, double largest) {
  const double least = AlbedoCurve::relative_floor * largest;
  return largest == 0 ? 1 : std::max(std::abs(albedo), least);
}

/// The problem of one variable: P/Q ≈ f at t = (x − b)/(x + b), errors relative to s. A Möbius map leaves the rational
/// functions of one degree what they are, but spreads the decades of x towards grazing incidence evenly over t.
struct Problem {
  RationalForm form;  ///< without factors
  Eigen::VectorXd t, f, s;
  double b, reach;            ///< t is within [−reach, reach]
  double least_x, largest_x;  ///< of the interval
};

Problem problem_of(const std::vector<Place>& list, double largest, int root, int power) {
  Problem problem;
  problem.form.root = root, problem.form.power = power;
  const auto x_of = [root](double c) { return root == 1 ? c : root == 2 ? std::sqrt(c) : std::sqrt(std::sqrt(c)); };
  problem.least_x = x_of(list.front().cos_theta), problem.largest_x = x_of(list.back().cos_theta);
  problem.b = std::sqrt(problem.least_x * problem.largest_x);
  const auto count = static_cast<Eigen::Index>(list.size());
  problem.t.resize(count), problem.f.resize(count), problem.s.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Place& place = list[static_cast<std::size_t>(i)];
    const double x = x_of(place.cos_theta), leading = std::pow(x, power);
    problem.t[i] = (x - problem.b) / (x + problem.b);
    problem.f[i] = place.albedo.value / leading;
    problem.s[i] = scale_of(place.albedo.value, largest) / leading;
  }
  problem.reach = problem.t.cwiseAbs().maxCoeff();
  return problem;
}

/// Chebyshev polynomials T_0 … T_degree at u, one row for each.
Eigen::MatrixXd chebyshev(const Eigen::VectorXd& u, int degree) {
  Eigen::MatrixXd basis(u.size(), degree + 1);
  basis.col(0).setOnes();
  if (degree > 0) basis.col(1) = u;
  for (int k = 2; k <= degree; ++k) {
    basis.col(k) = 2 * u.cwiseProduct(basis.col(k - 1)) - basis.col(k - 2);
  }
  return basis;
}

/// Zeros of Σ c_k T_k(t/reach) in x, t = (x − b)/(x + b): eigenvalues of the colleague matrix   [Good 1961].
RealFactors factors_of(const Eigen::VectorXd& c, const Problem& problem) {
  constexpr double negligible = 1e-15;
  RealFactors factors;
  Eigen::Index n = c.size() - 1;
  for (; n > 0 && std::abs(c[n]) <= negligible * c.cwiseAbs().maxCoeff(); --n) {
    factors.roots.push_back(-problem.b);  // where t is infinite
  }
  if (n == 0) return factors;
  using Real = long double;  // a double's rounding would move zeros that the coefficients hold better
  Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> colleague(n, n);
  colleague.setZero();
  for (Eigen::Index k = 0; k + 1 < n; ++k) {
    colleague(k, k + 1) = k == 0 ? 1 : 0.5L;
    colleague(k + 1, k) = 0.5L;
  }
  const Real leading = (n == 1 ? 1 : 2) * static_cast<Real>(c[n]);
  for (Eigen::Index k = 0; k < n; ++k) colleague(n - 1, k) -= static_cast<Real>(c[k]) / leading;
  const auto eigenvalues = colleague.eigenvalues().eval();
  for (const std::complex<Real>& u : eigenvalues) {
    const std::complex<Real> t = u * static_cast<Real>(problem.reach),
                             z = static_cast<Real>(problem.b) * (Real(1) + t) / (Real(1) - t);
    const std::complex<double> x(static_cast<double>(z.real()), static_cast<double>(z.imag()));
    if (u.imag() == 0) {
      factors.roots.push_back(x.real());
    } else if (u.imag() > 0) {
      factors.pairs.push_back({x.real(), x.imag() * x.imag()});
    }
  }
  std::ranges::sort(factors.roots);
  std::ranges::sort(factors.pairs, {}, &RealFactors::Pair::u);
  return factors;
}

/// The form of P/Q, given by their Chebyshev coefficients.
RationalForm form_of(const Eigen::VectorXd& p, const Eigen::VectorXd& q, const Problem& problem) {
  RationalForm form = problem.form;
  form.p = factors_of(p, problem), form.q = factors_of(q, problem);
  const int degree = static_cast<int>(p.size()) - 1;
  const Eigen::MatrixXd basis = chebyshev(problem.t / problem.reach, degree);
  const Eigen::VectorXd values = (basis * p).cwiseQuotient(basis * q);
  Eigen::Index i = 0;
  values.cwiseAbs().maxCoeff(&i);
  const double x = problem.b * (1 + problem.t[i]) / (1 - problem.t[i]);
  form.gain = values[i] * form.q.times(1.0, x) / form.p.times(1.0, x);
  return form;
}

bool has_pole(const RationalForm& form, const Problem& problem) {
  const auto within = [&](double root) { return root >= problem.least_x && root <= problem.largest_x; };
  const auto on_axis = [](const RealFactors::Pair& pair) { return !(pair.v2 > 0); };
  return std::ranges::any_of(form.q.roots, within) || std::ranges::any_of(form.q.pairs, on_axis);
}

double error_of(const RationalForm& form, const Problem& problem) {
  double worst = 0;
  for (Eigen::Index i = 0; i < problem.t.size(); ++i) {
    const double x = problem.b * (1 + problem.t[i]) / (1 - problem.t[i]);
    const double value = form.p.times(form.gain, x) / form.q.times(1.0, x);
    const double error = std::abs(value - problem.f[i]) / problem.s[i];
    if (!(error <= worst)) worst = error;
  }
  return worst;
}

struct Candidate {
  RationalForm form;
  double error = infinity;
};

/// The least maximum of |P/Q − f|/s, nearly: least squares of the linearised problem (P − f Q)/(s Q₀) with the
/// denominator of the step before [Sanathanan & Koerner 1963], weighted by the errors of the step before [Lawson 1961].
Candidate minimax(const Problem& problem, int degree) {
  constexpr int steps = 80;
  const Eigen::Index count = problem.t.size(), n = degree + 1;
  const Eigen::MatrixXd basis = chebyshev(problem.t / problem.reach, degree);
  const Eigen::VectorXd f_over_s = problem.f.cwiseQuotient(problem.s);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(count), denominator = weights;
  Candidate best;
  for (int step = 0; step < steps; ++step) {
    const Eigen::VectorXd row = weights.cwiseSqrt().cwiseQuotient(denominator.cwiseAbs());
    Eigen::MatrixXd matrix(count, 2 * n - 1);
    matrix.leftCols(n) = row.cwiseQuotient(problem.s).asDiagonal() * basis;
    matrix.rightCols(n - 1) = -(row.cwiseProduct(f_over_s).asDiagonal() * basis.rightCols(n - 1));
    const Eigen::VectorXd solution = matrix.colPivHouseholderQr().solve(row.cwiseProduct(f_over_s));
    Eigen::VectorXd q(n);
    q << 1, solution.tail(n - 1);
    denominator = basis * q;
    const Eigen::VectorXd errors =
        ((basis * solution.head(n)).cwiseQuotient(denominator) - problem.f).cwiseQuotient(problem.s).cwiseAbs();
    const double worst = errors.maxCoeff();
    if (!std::isfinite(worst)) break;
    if (worst < best.error) {
      const RationalForm form = form_of(solution.head(n), q, problem);
      if (std::isfinite(form.gain) && !has_pole(form, problem)) {
        const double error = error_of(form, problem);
        if (error < best.error) best = {form, error};
      }
    }
    if (worst == 0) break;
    if (step < 5) continue;  // the denominator settles first
    weights = weights.cwiseProduct(errors / worst);
    weights /= weights.maxCoeff();
    weights = weights.cwiseMax(1e-12);
  }
  return best;
}

/// Takes the error of the form at these places into the fit's.
void measure(const std::vector<Place>& list, RationalFit& fit) {
  for (const auto& [cos_theta, albedo] : list) {
    const double scale = scale_of(albedo.value, fit.largest);
    const double error = std::abs(fit.form(cos_theta) - albedo.value) / scale + albedo.error / scale;
    const double in_float =
        std::abs(static_cast<double>(fit.form(static_cast<float>(cos_theta))) - albedo.value) / scale;
    if (!(error <= fit.error)) fit.error = error, fit.worst_theta = theta_degrees(cos_theta);
    if (!(in_float <= fit.float_error)) fit.float_error = in_float;
  }
}

}  // namespace

RationalFit rational_form(const Model& model, const RationalOptions& options) {
  if (options.most_coefficients < 3) {
    throw ParameterError("most_coefficients is " + std::to_string(options.most_coefficients) +
                         " and must be at least 3");
  }
  if (!(options.tolerance > 0 && options.tolerance < 1)) {
    throw ParameterError("tolerance is " + std::to_string(options.tolerance) + " and must be within (0, 1)");
  }
  if (!(options.last_theta >= 1 && options.last_theta < 90)) {
    throw ParameterError("last_theta is " + std::to_string(options.last_theta) + " and must be within [1, 90)");
  }
  RationalFit fit;
  std::vector<Place> nodes = places(fitted_places, options.last_theta, 0.5, true);
  std::vector<Place> others = places(verified_places, options.last_theta, golden, false);
  integrate(model, options, nodes, fit);
  integrate(model, options, others, fit);
  fit.fitted = static_cast<int>(nodes.size()), fit.verified = static_cast<int>(others.size());
  fit.smallest = infinity, fit.largest = 0;
  for (const auto& list : {nodes, others}) {
    for (const Place& place : list) {
      fit.smallest = std::min(fit.smallest, place.albedo.value);
      fit.largest = std::max(fit.largest, std::abs(place.albedo.value));
    }
  }
  if (fit.status == Status::non_finite || fit.status == Status::divergent || !std::isfinite(fit.largest)) {
    fit.form.gain = std::numeric_limits<double>::quiet_NaN();
    fit.error = fit.float_error = infinity;
    if (fit.status == Status::converged) fit.status = Status::non_finite;
    return fit;
  }

  const double slope = std::log(nodes[0].albedo.value / nodes[8].albedo.value) /
                       std::log(nodes[0].cos_theta / nodes[8].cos_theta);  // of ln a over ln cosθ at grazing incidence
  const int most_degree = static_cast<int>((options.most_coefficients - 1) / 2);
  constexpr double spare = 0.8;  // of the tolerance: the places between take some
  Candidate best;
  for (int degree = 0; degree <= most_degree && best.error > spare * options.tolerance; ++degree) {
    Candidate here;
    for (const int root : {2, 1, 4}) {
      const int whole = std::isfinite(slope) ? static_cast<int>(std::lround(std::clamp(slope * root, -8.0, 8.0))) : 0;
      for (const int power : std::set<int>{0, whole}) {
        Candidate candidate = minimax(problem_of(nodes, fit.largest, root, power), degree);
        if (candidate.error < here.error) here = std::move(candidate);
      }
    }
    if (here.error < best.error) best = std::move(here);
  }
  fit.form = best.form;
  measure(nodes, fit);
  measure(others, fit);
  if (fit.status == Status::converged && !(fit.error <= options.tolerance)) fit.status = Status::budget_exhausted;
  return fit;
}

}  // namespace albedo::analysis
