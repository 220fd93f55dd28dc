/// @file
/// Nanoseconds an evaluation of every model: w of its first lobe's integrand, warp included, on a grid like those of
/// gauss. "block" is the fast path, "scalar" the same integrand one double at a time. A new model appears by itself.
#include <benchmark/benchmark.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "integration/warped_integrand.hpp"

namespace albedo {
namespace {

constexpr double theta = 60;

template <class T>
void evaluate(benchmark::State& state, const Model& model) {
  constexpr int count_u = 16, count_v = 16;
  const std::unique_ptr<Integrand<double>> integrand =
      warped_integrand<T>(model, model.lobes().front(), Direction::from_degrees(theta), {});
  std::array<double, count_u> u{};
  std::array<double, count_v> v{};
  std::array<double, std::size_t{count_u} * count_v> w{};
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = (static_cast<double>(i) + 0.5) / count_u;
  for (std::size_t j = 0; j < v.size(); ++j) v[j] = (static_cast<double>(j) + 0.5) / count_v;
  for (auto _ : state) {
    integrand->grid(0, u.data(), count_u, v.data(), count_v, w.data());
    benchmark::DoNotOptimize(w);
  }
  state.counters["time/evaluation"] = benchmark::Counter(
      static_cast<double>(w.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// The parameters that say how rough a model is, and values at which it is rough and smooth.
struct Roughness {
  std::string parameter;
  double rough, smooth;
};
const std::array roughnesses{Roughness{"alpha", 0.8, 0.01}, Roughness{"m", 0.8, 0.01}, Roughness{"n", 5, 5000},
                             Roughness{"sigma", 1, 0.1}};

void add(const ModelInfo& info, const std::string& variant, const Parameters& parameters) {
  const std::shared_ptr<const Model> model = make_model(info.name, parameters);
  const std::string name = info.name + "/" + variant;
  benchmark::RegisterBenchmark((name + "/block").c_str(),
                               [model](benchmark::State& state) { evaluate<Block>(state, *model); });
  benchmark::RegisterBenchmark((name + "/scalar").c_str(),
                               [model](benchmark::State& state) { evaluate<double>(state, *model); });
}

const bool registered = [] {
  for (const ModelInfo& info : model_infos()) {
    if (info.needs_input()) continue;
    add(info, "default", {});
    for (const Roughness& roughness : roughnesses) {
      if (info.resolve(roughness.parameter).empty()) continue;
      add(info, "rough", {{roughness.parameter, roughness.rough}});
      add(info, "smooth", {{roughness.parameter, roughness.smooth}});
      break;
    }
  }
  return true;
}();

}  // namespace
}  // namespace albedo
