#pragma once

#include <string>

#include "albedo/core/model.hpp"

namespace albedo {

/// @throws ParameterError unless the value is within the range, which is written as `text`
void check_number(const std::string& name, double value, const Range& range, const char* text);

/// @throws ParameterError for a model that can't be divided by a symmetric function and stay what it is
void check_reciprocal(const std::string& who, const Model& model);

/// @throws ParameterError for a model that a function of one angle doesn't correct
void check_isotropic(const std::string& who, const Model& model);

/// @throws ParameterError for an albedo that nothing can be divided by
void check_positive_albedo(const std::string& who, const Model& model, double albedo, double cos_theta);

}  // namespace albedo
