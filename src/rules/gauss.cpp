#include "rules/gauss.hpp"

#include "rules/product_rule.hpp"

namespace albedo {

template EstimateIn<double> gauss(const Integrand<double>&, const RuleOptions&);

Estimate gauss_estimate(const Integrand<double>& integrand, const RuleOptions& options) {
  const EstimateIn<double> estimate = gauss(integrand, options);
  return {estimate.value, estimate.error, ErrorKind::embedded, estimate.evaluations, estimate.status};
}

}  // namespace albedo
