#include "integration/integrand_of.hpp"

#include "integration/quad_integrand.hpp"
#include "integration/warped_integrand.hpp"

namespace albedo {

std::unique_ptr<Integrand<double>> integrand_of(const Model& model, const Lobe& lobe, const Direction& l,
                                                const AlbedoOptions& options) {
  if (options.precision == Precision::quad) return rounded_quad_integrand(model, {lobe}, l, options);
  return warped_integrand<Block>(model, lobe, l, options);
}

std::unique_ptr<Integrand<double>> integrand_of(const Model& model, const Direction& l, const AlbedoOptions& options) {
  if (options.precision == Precision::quad) return rounded_quad_integrand(model, model.lobes(), l, options);
  return warped_integrand<Block>(model, model.lobes(), l, options);
}

}  // namespace albedo
