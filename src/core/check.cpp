#include "core/check.hpp"

#include <cmath>

#include "albedo/core/errors.hpp"
#include "core/text.hpp"

namespace albedo {

void check_number(const std::string& name, double value, const Range& range, const char* text) {
  if (range.contains(value)) return;
  throw ParameterError(fmt::format("{} is {:g} and must be within {}", name, value, text));
}

void check_reciprocal(const std::string& who, const Model& model) {
  if (model.claims().reciprocal) return;
  throw ParameterError(fmt::format("{}: {} isn't reciprocal for these parameters and must be: L and V are exchanged",
                                   who, model.info().name));
}

void check_isotropic(const std::string& who, const Model& model) {
  if (model.claims().isotropic) return;
  throw ParameterError(
      fmt::format("{}: {} is anisotropic for these parameters and must be isotropic", who, model.info().name));
}

void check_positive_albedo(const std::string& who, const Model& model, double albedo, double cos_theta) {
  if (albedo > 0 && std::isfinite(albedo)) return;
  throw ParameterError(fmt::format("{}: the albedo of {} is {:g} at cos_theta {:g} and must be finite and positive",
                                   who, model.info().name, albedo, cos_theta));
}

}  // namespace albedo
