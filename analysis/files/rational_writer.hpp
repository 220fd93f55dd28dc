/// @file
/// A rational form of the albedo as text to compile, or as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "albedo/rational_function.hpp"

namespace albedo::analysis {

/// {"variable", "d", "exponent", "power", "gain", "zeros", "zero_pairs", "poles", "pole_pairs"}: the variable x is a
/// formula of c = cosθ, s = sinθ and d, a pair is [u, v²], and the value is c^(power/2) (gain P(x)/Q(x))^(1/exponent).
nlohmann::ordered_json rational_json(const RationalForm& form);

/// A function template `T NAME(T cos_theta)`, with one line of comment for each item of the provenance.
std::string rational_cpp(const RationalForm& form, const std::string& name, const nlohmann::ordered_json& provenance);

/// A function `float NAME(float cos_theta)` for any version of GLSL, without #version: to be included.
std::string rational_glsl(const RationalForm& form, const std::string& name, const nlohmann::ordered_json& provenance);

/// Writes what the ending of `path` says: .hpp, .glsl or .json; "-" is C++ on standard output.
/// @throws WriteError
void write_rational(const RationalForm& form, const std::string& name, const nlohmann::ordered_json& provenance,
                    const std::string& path);

/// Throws what write_rational() would throw for the path, before anything is computed.
/// @throws ParameterError if the ending is none of these
void check_rational_path(const std::string& path);

}  // namespace albedo::analysis
