#include <array>

#include "albedo/pumping.hpp"

namespace albedo {

std::string_view to_string(PumpControl control) {
  switch (control) {
    case PumpControl::none:
      return "none";
    case PumpControl::step:
      return "step";
    case PumpControl::total:
      break;
  }
  return "total";
}

double PumpDivisor::log_divisor(int k, double x_l, double x_v) const {
  constexpr auto terms = std::size_t{CosineTables::terms};
  std::array<double, terms> t_l, t_v;
  const double* l = albedos.expansions_at(x_l, t_l.data());
  const double* v = albedos.expansions_at(x_v, t_v.data());
  double sum = 0;
  for (int order = 0; order < k; ++order, l += terms, v += terms) {
    double log_l = 0, log_v = 0;
    for (std::size_t i = 0; i < terms; ++i) log_l += l[i] * t_l[i], log_v += v[i] * t_v[i];
    sum = step(sum, log_l, log_v, x_l, x_v);
  }
  return sum;
}

}  // namespace albedo
