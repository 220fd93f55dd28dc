#include "albedo/microfacet/wave_series.hpp"

#include "albedo/core/quad.hpp"

namespace albedo::detail {

template <class S>
const std::array<S, most_wave_terms + 1>& wave_term_logarithms() {
  static const auto table = [] {
    std::array<S, most_wave_terms + 1> logarithms{};
    Quad factorial = 0;
    for (int m = 1; m <= most_wave_terms; ++m) {
      const Quad log_m = log(Quad(m));
      factorial += log_m;
      logarithms[static_cast<std::size_t>(m)] = static_cast<S>(factorial + log_m);
    }
    return logarithms;
  }();
  return table;
}

template const std::array<float, most_wave_terms + 1>& wave_term_logarithms<float>();
template const std::array<double, most_wave_terms + 1>& wave_term_logarithms<double>();
template const std::array<Quad, most_wave_terms + 1>& wave_term_logarithms<Quad>();

}  // namespace albedo::detail
