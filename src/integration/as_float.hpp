#pragma once

#include "albedo/core/model.hpp"

namespace albedo {

/// Lobe `component`'s f(L,V) as a shader would evaluate it, on pairs rounded to float.
inline Block evaluate_as_float(const Model& model, int component, const DirectionPair<Block>& p) {
  return Block::generate([&](int lane) {
    const auto at = [lane](const Block& b) { return static_cast<float>(b[lane]); };
    const DirectionPair<float> pair{at(p.cos_theta_l), at(p.cos_theta_v), at(p.l_x),         at(p.l_y),
                                    at(p.v_x),         at(p.v_y),         at(p.cos_theta_d), at(p.cos_theta_h),
                                    at(p.slope_x),     at(p.slope_y),     at(p.axis_gap)};
    return static_cast<double>(model.evaluate(component, pair));
  });
}

}  // namespace albedo
