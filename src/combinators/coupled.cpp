#include "albedo/combinators/coupled.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include "albedo/core/errors.hpp"
#include "albedo/registry.hpp"
#include "core/check.hpp"

namespace albedo {
namespace {

/// 2 ∫ (1 − R)₊ μ dμ by Gauss rules between the nodes of R's table.
template <unsigned order>
double transmitted_mean(const TabulatedMatte& matte) {
  double sum = 0, upper = 1;
  for (std::size_t i = 0; i <= matte.surface->nodes().size(); ++i) {
    const double lower = i < matte.surface->nodes().size() ? matte.surface->nodes()[i].cos_theta : 0;
    if (lower == upper) continue;
    sum += boost::math::quadrature::gauss<double, order>::integrate(
        [&](double c) { return 2 * c * matte.transmitted(c); }, lower, upper);
    upper = lower;
  }
  return sum;
}

}  // namespace

ModelInfo TabulatedMatte::info() {
  return {.name = "matte",
          .title = "Matte body below a surface",
          .source = "Shirley, Smits, Hu, Lafortune 1997; Ashikhmin & Shirley 2000, eq. 12",
          .deviation = "R from a table raised by its error"};
}

std::vector<Parameter<TabulatedMatte>> TabulatedMatte::parameters() {
  using M = TabulatedMatte;
  return {reflectance<M, &M::r_m>("r_m", "reflectance of the matte body")};
}

std::unique_ptr<Model> coupled(std::unique_ptr<Model> surface, double r_m, double tolerance) {
  if (!surface) throw ParameterError("coupled: there is no surface model and there must be one");
  check_number("coupled: r_m", r_m, {0, 1}, "[0, 1]");
  check_isotropic("coupled", *surface);
  const Claims claims = surface->claims();
  const std::string name = surface->info().name;
  if (!claims.conserves_energy) {
    throw ParameterError("coupled: " + name +
                         " doesn't claim to conserve energy for these parameters and must leave 1 - R for the body");
  }
  TabulatedMatte matte{.r_m = r_m};
  matte.surface = std::make_shared<AlbedoCurve>(*surface, CurveOptions{.albedo = {.tolerance = tolerance}});
  const double mean = transmitted_mean<15>(matte), coarse = transmitted_mean<7>(matte);
  matte.transmitted_mean = mean + std::abs(mean - coarse);     // what the integral doesn't know makes it darker
  if (!(mean > 0)) matte.r_m = 0, matte.transmitted_mean = 1;  // a perfect mirror leaves nothing

  std::vector<SumModel::Part> parts(2);
  parts[0].model = std::move(surface);
  parts[1].model = std::make_unique<ErasedModel<TabulatedMatte>>(matte, detail::complete_info<TabulatedMatte>());
  ModelInfo info{.name = "coupled",
                 .title = "Surface over a matte body",
                 .source = TabulatedMatte::info().source,
                 .deviation = "any specular model for the polished surface"};
  return std::make_unique<SumModel>(std::move(parts), std::move(info),
                                    Claims{.reciprocal = claims.reciprocal, .bounded = claims.bounded});
}

}  // namespace albedo
