#include "albedo/reference.hpp"

#include <cmath>
#include <limits>

#include "core/integrand_of.hpp"

namespace albedo {

EstimateIn<Quad> reference_albedo(const Model& model, const Direction& l, const ReferenceOptions& reference) {
  const AlbedoOptions options{
      .precision = Precision::quad, .tolerance = reference.tolerance, .budget = reference.budget};
  check(options);
  if (model.lobes().empty() || l.cos_theta > grazing_cosine) {
    EstimateIn<Quad> estimate;
    if (!model.lobes().empty()) {
      estimate = gauss(*integrand_of<Quad>(model, l, options), {options.tolerance, options.budget, options.seed});
    }
    const Quad coherent = model.coherent_albedo(l);
    constexpr int units = 64;
    estimate.value += coherent;
    estimate.error += units * std::numeric_limits<Quad>::epsilon() * coherent;
    return estimate;
  }
  const Estimate limit = directional_albedo(model, l, options);
  // the limit went through a double
  const double rounding = std::abs(limit.value) * std::numeric_limits<double>::epsilon();
  const double error = limit.error + rounding;
  const bool converged = limit.status == Status::converged && error <= options.tolerance * std::abs(limit.value);
  return {Quad(limit.value), Quad(error), limit.evaluations,
          converged                           ? Status::converged
          : limit.status == Status::converged ? Status::rounding_limited
                                              : limit.status};
}

}  // namespace albedo
