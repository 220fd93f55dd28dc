#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "rules/cubature.hpp"
#include "rules/gauss.hpp"
#include "rules/kronrod.hpp"
#include "rules/monte_carlo.hpp"
#include "rules/sobol.hpp"
#include "rules/stratified.hpp"
#include "rules/tanh_sinh.hpp"

/// Integrands with closed forms, and every rule by name.
namespace albedo {

/// Any function of (panel, u, v) as an integrand.
template <class S>
class Formula final : public Integrand<S> {
 public:
  using Function = std::function<S(int, S, S)>;

  Formula(Function f, std::vector<Panel> panels) : f_(std::move(f)) { this->panels_ = std::move(panels); }
  explicit Formula(Function f, int order = 8)
      : Formula(std::move(f), {{{AxisKind::interval, order}, {AxisKind::interval, order}}}) {}

  void set_truncation(double truncation) { this->truncation_ = truncation; }

  void points(int panel, const S* u, const S* v, S* w, int count) const override {
    for (int i = 0; i < count; ++i) w[i] = f_(panel, u[i], v[i]);
    calls += count;
  }
  void grid(int panel, const S* u, int count_u, const S* v, int count_v, S* w) const override {
    for (int i = 0; i < count_u; ++i) {
      for (int j = 0; j < count_v; ++j) w[i * count_v + j] = f_(panel, u[i], v[j]);
    }
    calls += count_u * count_v;
  }

  mutable std::int64_t calls = 0;

 private:
  Function f_;
};

using Function = std::function<double(double, double)>;

struct Known {
  std::string name;
  Function f;
  double integral;
  bool smooth;         ///< analytic inside the square: gauss meets 1e-10 cheaply
  std::int64_t gauss;  ///< most evaluations at 1e-8
};

inline double gauss_1d(double centre, double width) {
  const double root_pi_2 = std::sqrt(std::acos(-1.0)) / 2;
  return width * root_pi_2 * (std::erf((1 - centre) / width) + std::erf(centre / width));
}

inline const std::vector<Known>& integrands() {
  static const double pi_ = std::acos(-1.0);
  static const std::vector<Known> all{
      {"constant", [](double, double) { return 3.0; }, 3, true, 200},
      {"polynomial", [](double x, double y) { return 1 + x * x * x * y + 5 * x * std::pow(y, 6); },
       1 + 1.0 / 8 + 5.0 / 14, true, 400},
      {"exponential", [](double x, double y) { return std::exp(x - 2 * y); },
       (std::exp(1.0) - 1) * (1 - std::exp(-2.0)) / 2, true, 400},
      {"runge", [](double x, double y) { return 1 / ((1 + 25 * x * x) * (1 + y)); }, std::atan(5.0) / 5 * std::log(2.0),
       true, 2000},
      {"wide peak",
       [](double x, double y) { return std::exp(-std::pow((x - 0.4) / 0.3, 2) - std::pow((y - 0.7) / 0.5, 2)); },
       gauss_1d(0.4, 0.3) * gauss_1d(0.7, 0.5), true, 2000},
      {"narrow peak",
       [](double x, double y) { return std::exp(-std::pow((x - 0.37) / 0.03, 2) - std::pow((y - 0.61) / 0.05, 2)); },
       gauss_1d(0.37, 0.03) * gauss_1d(0.61, 0.05), false, 60'000},
      {"oscillating", [](double x, double y) { return 1 + std::cos(20 * x + 9 * y); },
       1 + (std::cos(20.0) + std::cos(9.0) - 1 - std::cos(29.0)) / 180, true, 4000},
      {"kink", [](double x, double y) { return std::abs(x - y); }, 1.0 / 3, false, 2'000'000},
      {"kink off the diagonal", [](double x, double y) { return std::abs(x - 0.3) * (1 + y); }, (0.09 + 0.49) / 2 * 1.5,
       false, 2'000'000},
      {"square root at an end", [](double x, double y) { return std::sqrt(x) * (1 + y); }, 1, false, 2'000'000},
      {"1/sqrt at an end", [](double x, double y) { return (1 + y) / std::sqrt(x); }, 3, false, 2'000'000},
      {"discontinuity", [](double x, double y) { return x + y < 0.8 ? 1.0 : 0.0; }, 0.32, false, 2'000'000},
      {"sign change", [](double x, double y) { return std::sin(2 * pi_ * x) + y; }, 0.5, true, 4000},
  };
  return all;
}

inline Formula<double> formula(const Known& known) {
  return Formula<double>([f = known.f](int, double u, double v) { return f(u, v); });
}

using AnyRule = std::function<Estimate(const Integrand<double>&, const RuleOptions&)>;

struct NamedRule {
  std::string name;
  AnyRule rule;
  bool random = false;    ///< its error is a standard error, and it takes its time to small ones
  bool adaptive = false;  ///< looks closer where it has to
};

inline const std::vector<NamedRule>& rules() {
  static const std::vector<NamedRule> all{
      {"gauss",
       [](const Integrand<double>& f, const RuleOptions& o) {
         const auto e = gauss<double>(f, o);
         return Estimate{e.value, e.error, ErrorKind::embedded, e.evaluations, e.status};
       },
       false, true},
      {"cubature", cubature, false, true},
      {"kronrod", kronrod, false, true},
      {"tanh_sinh", tanh_sinh, false, false},
      {"stratified", stratified, true, false},
      {"sobol", sobol, true, false},
      {"monte_carlo", monte_carlo, true, false},
  };
  return all;
}

}  // namespace albedo
