#include "integration/quad_integrand.hpp"

#include <algorithm>

#include "albedo/core/errors.hpp"
#include "albedo/reference.hpp"
#include "core/formula_of_quad.hpp"
#include "integration/warped_integrand.hpp"
#include "rules/gauss_quad.hpp"

namespace albedo {
namespace {

/// An integrand evaluated in 113 bits, for a rule that sums in double.
class RoundedIntegrand final : public Integrand<double> {
 public:
  explicit RoundedIntegrand(std::unique_ptr<Integrand<Quad>> exact) : exact_(std::move(exact)) {
    panels_ = exact_->panels(), truncation_ = exact_->truncation();
  }

  void points(int panel, const double* u, const double* v, double* w, int count) const override {
    for (int i = 0; i < count; ++i) {
      const Quad qu = u[i], qv = v[i];
      Quad qw;
      exact_->points(panel, &qu, &qv, &qw, 1);
      w[i] = static_cast<double>(qw);
    }
  }
  void grid(int panel, const double* u, int count_u, const double* v, int count_v, double* w) const override {
    for (int i = 0; i < count_u; ++i, w += count_v) {
      const std::vector<double> same_u(static_cast<std::size_t>(count_v), u[i]);
      points(panel, same_u.data(), v, w, count_v);
    }
  }

 private:
  std::unique_ptr<Integrand<Quad>> exact_;
};

}  // namespace

std::unique_ptr<Integrand<double>> rounded_quad_integrand(const Model& model, const std::vector<Lobe>& lobes,
                                                          const Direction& l, const AlbedoOptions& options) {
  return std::make_unique<RoundedIntegrand>(warped_integrand<Quad>(model, lobes, l, options));
}

QuadIntegral integrated_in_quad(const Model& model, const Direction& l, const AlbedoOptions& options) {
  const auto integrand = warped_integrand<Quad>(model, model.lobes(), l, options);
  const EstimateIn<Quad> exact = gauss(*integrand, {options.tolerance, options.budget, options.seed});
  return {{static_cast<double>(exact.value), static_cast<double>(exact.error), ErrorKind::embedded, exact.evaluations,
           exact.status},
          std::ranges::all_of(integrand->panels(), &Panel::tracked)};
}

EstimateIn<Quad> reference_albedo(const Model& model, const Direction& l, const ReferenceOptions& reference) {
  const AlbedoOptions options{
      .precision = Precision::quad, .tolerance = reference.tolerance, .budget = reference.budget};
  check(options);
  if (model.lobes().empty() || l.cos_theta > grazing_cosine) {
    EstimateIn<Quad> estimate;
    if (!model.lobes().empty()) {
      estimate = gauss(*warped_integrand<Quad>(model, model.lobes(), l, options),
                       {options.tolerance, options.budget, options.seed});
    }
    const Quad coherent = model.quad().coherent_albedo(l);
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
