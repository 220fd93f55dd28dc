/// @file
/// What a shader needs to evaluate a corrected model: functions of one cosine, as tables.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "albedo/corrections.hpp"

namespace albedo {

/// A function of one cosine that a correction takes from each direction; examples/shader shows how they make f*.
struct ShaderFunction {
  std::string name;  ///< 1/a_0, 1/a_1, … of pumping; 1/s of balance; m of multiscatter; 1/a of turquin
  std::function<double(double cos_theta)> value;
};

/// The functions of all corrections asked for, in the order in which they are applied. They keep what they need alive.
/// @throws ParameterError as Corrections::applied_to does
std::vector<ShaderFunction> shader_functions(std::unique_ptr<Model> model, const Corrections& corrections);

/// Values at the nodes cosθ = (i/(size − 1))², which a shader interpolates linearly in √cosθ.
struct ShaderTable {
  std::vector<double> values{};  ///< one function after the other
  std::size_t size = 0;          ///< nodes
  double error = 0;              ///< largest between two nodes, relative to the function's largest value
};

/// The cosine of a node.
double shader_node(std::size_t i, std::size_t size);

/// @param size of the table; 0 for the least power of two, from 64 to 65536, whose error is below the largest allowed
ShaderTable tabulate(const std::vector<ShaderFunction>& functions, std::size_t size, double largest_error);

}  // namespace albedo
