#pragma once

#include <utility>
#include <vector>

#include "core/integrand.hpp"

namespace albedo {

/// w(panel, u, v) as an integrand, point by point.
template <class Function>
class FunctionIntegrand final : public Integrand<double> {
 public:
  FunctionIntegrand(std::vector<Panel> panels, Function function) : function_(std::move(function)) {
    panels_ = std::move(panels);
  }

  void points(int panel, const double* u, const double* v, double* w, int count) const override {
    for (int i = 0; i < count; ++i) w[i] = function_(panel, u[i], v[i]);
  }
  void grid(int panel, const double* u, int count_u, const double* v, int count_v, double* w) const override {
    for (int i = 0; i < count_u; ++i) {
      for (int j = 0; j < count_v; ++j) w[i * count_v + j] = function_(panel, u[i], v[j]);
    }
  }

 private:
  Function function_;
};

}  // namespace albedo
