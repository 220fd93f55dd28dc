/// @file
/// A list of materials: a JSON array, or JSON lines, of {"name": ..., "model": ..., "parameters": {...}} and, where a
/// fit has them beside its model, "scale": a factor of the model, and "lambertian": the albedo of a Lambertian part.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace albedo::analysis {

/// A number, the name of a choice, or a number for each of R, G and B.
using ParameterValue = std::variant<double, std::string, std::array<double, 3>>;

struct Material {
  std::string name;
  std::string model;
  std::vector<std::pair<std::string, ParameterValue>> parameters;  ///< in the order of the file, no name twice
  ParameterValue scale = 1.0, lambertian = 0.0;                    ///< a number, or one for each of R, G and B
  std::size_t line = 0;                                            ///< where the entry begins, from 1
};

/// Reads a file of at most 64 MiB. Members other than those above are ignored; two materials may share a name.
/// Whether the models and parameters exist is for the caller to say, who has the line for it.
/// @throws FormatError naming the file, and the line at which the offending entry begins
std::vector<Material> read_materials(const std::string& path);

/// The same from text; `file` stands for it in messages.
std::vector<Material> parse_materials(std::string_view text, const std::string& file);

}  // namespace albedo::analysis
