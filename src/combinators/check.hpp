#pragma once

#include <cmath>
#include <sstream>
#include <string>

#include "albedo/core/errors.hpp"
#include "albedo/core/model.hpp"

namespace albedo {

/// @throws ParameterError unless the value is within the range, which is written as `text`
inline void check_number(const std::string& name, double value, const Range& range, const char* text) {
  if (range.contains(value)) return;
  std::ostringstream message;
  message << name << " is " << value << " and must be within " << text;
  throw ParameterError(message.str());
}

/// @throws ParameterError for a model that can't be divided by a symmetric function and stay what it is
inline void check_reciprocal(const std::string& who, const Model& model) {
  if (model.claims().reciprocal) return;
  throw ParameterError(who + ": " + model.info().name +
                       " isn't reciprocal for these parameters and must be: L and V are exchanged");
}

/// @throws ParameterError for a model that a function of one angle doesn't correct
inline void check_isotropic(const std::string& who, const Model& model) {
  if (model.claims().isotropic) return;
  throw ParameterError(who + ": " + model.info().name + " is anisotropic for these parameters and must be isotropic");
}

/// @throws ParameterError for an albedo that nothing can be divided by
inline void check_positive_albedo(const std::string& who, const Model& model, double albedo, double cos_theta) {
  if (albedo > 0 && std::isfinite(albedo)) return;
  std::ostringstream message;
  message << who << ": the albedo of " << model.info().name << " is " << albedo << " at cos_theta " << cos_theta
          << " and must be finite and positive";
  throw ParameterError(message.str());
}

}  // namespace albedo
