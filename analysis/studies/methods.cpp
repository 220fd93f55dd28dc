#include "analysis/studies/methods.hpp"

#include <algorithm>
#include <vector>

namespace albedo::analysis {

std::string name_of(Rule rule) {
  switch (rule) {
    case Rule::gauss:
      return "gauss";
    case Rule::cubature:
      return "cubature";
    case Rule::kronrod:
      return "kronrod";
    case Rule::tanh_sinh:
      return "tanh_sinh";
    case Rule::stratified:
      return "stratified";
    case Rule::sobol:
      return "sobol";
    case Rule::monte_carlo:
      return "monte_carlo";
  }
  return {};
}

std::string name_of(Warp warp) {
  switch (warp) {
    case Warp::lobe:
      return "lobe";
    case Warp::hemisphere:
      return "hemisphere";
    case Warp::paper:
      return "paper";
  }
  return {};
}

std::string name_of(Precision precision) {
  switch (precision) {
    case Precision::float64:
      return "double";
    case Precision::float32:
      return "float";
    case Precision::quad:
      return "quad";
  }
  return {};
}

bool has_samplers(const Model& model) {
  const std::vector<Lobe> lobes = model.lobes();
  return std::ranges::all_of(lobes, [&](const Lobe& lobe) { return model.has_sampler(lobe.component); });
}

}  // namespace albedo::analysis
