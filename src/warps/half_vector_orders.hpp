/// @file
/// How many nodes the panels of a half-vector lobe begin with. They were measured on lobes of every width and
/// incidence; a number that is off costs evaluations, never digits.
#pragma once

#include <algorithm>
#include <cmath>

#include "warps/half_vector_sectors.hpp"

namespace albedo {

/// Beside the turn's own length: an edge that enters the lobe does so like exp(−r²).
template <class S>
int azimuth_order(const HalfVectorFrame<S>& frame, AxisKind kind, double extent, bool edged) {
  if (frame.l.z == 1 && frame.alpha_x == frame.alpha_y)
    return kind == AxisKind::interval ? 4 : 2;  // all rays are the same
  int order = frame.turn.order(kind, extent, frame.digits, 1.2);
  // masking turns with the viewer's azimuth, faster than the lobe's own shape; slopes above 1 bring L near the
  // facets' planes
  if (frame.horizon_layer && frame.turning) order = frame.profile == Profile::ggx ? 3 * order : order + order / 2;
  if (frame.profile == Profile::ggx && frame.widest > 1.5) order += 2 * static_cast<int>(frame.digits);
  if (frame.horizon_exponent < 0) order += order / 2;
  if (kind == AxisKind::interval) order += static_cast<int>(0.4 * frame.digits);
  return std::min(edged ? std::max(order, static_cast<int>(1.65 * frame.digits)) : order, 128);
}

/// What is needed at eight digits on a part from edge `begin` on, measured.
template <class S>
int radial_order(const HalfVectorFrame<S>& frame, const EndMap& ends, const HalfVectorEdges& edges, std::size_t begin,
                 double longest) {
  double nodes = 15.5;
  const double grazing = -std::log(static_cast<double>(frame.l.z));
  if (frame.profile == Profile::ggx) {  // the tail's length, in decades
    const double decades = std::asinh(1 / static_cast<double>(min(frame.alpha_x, frame.alpha_y)));
    nodes = (frame.horizon_layer ? 15 + 3.2 * decades : 8.5 + 3.8 * decades) + 2.6 * grazing +
            (frame.widest > 1.5 ? 28 : 0);
    if (frame.alpha_x != frame.alpha_y) nodes *= frame.turning ? 1.2 : 1.4;
  } else if (ends.left > 1 || ends.right > 1) {
    nodes = ends.right > 1 && ends.right != 2 ? 31 : ends.left > 1 ? 26 : 21;
  } else if (begin > 0) {
    nodes = edges[begin] == HalfVectorEdge::cavity_light    ? 18
            : edges[begin] == HalfVectorEdge::equal_cosines ? 13.5
                                                            : 11.5;
  } else if (edges.size() > 2) {
    nodes = grazing > 1.5 ? 15 : 13.5;
  }
  if (frame.turning && frame.profile != Profile::ggx) nodes *= 1.3;
  if (!frame.stretch) nodes *= (7 + 1.6 * longest) / 15;  // a whole lobe is 5 long
  return static_cast<int>(nodes * (2 + frame.digits) / 10);
}

}  // namespace albedo
