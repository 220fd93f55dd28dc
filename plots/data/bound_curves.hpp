/// @file
/// Walter's bounds over a cube of directions that moves through the plane of incidence, against the largest values
/// there.
#pragma once

#include <vector>

#include "albedo/bounds.hpp"

namespace albedo::analysis {

/// One place of the cube.
struct BoundedBox {
  double theta = 0;  ///< of its middle, at distance 1 from the surface's point [degrees]; positive on the mirror's side
  DirectionBox box{};
  double cosine_bound = 0, cosine = 0;    ///< of cosθ_V: by eq. 27, and the largest found by a search
  double product_bound = 0, product = 0;  ///< of f cosθ_V [1/sr], likewise
  double at_middle = 0;                   ///< f cosθ_V in the middle's direction
};

struct BoundCurve {
  double side = 0;
  std::vector<BoundedBox> boxes{};
};

/// The search is over the box's points: a grid, then steps from its best that are halved; cosθ_V and f cosθ_V are 0 or
/// negative below the surface, as they are.
BoundCurve bound_curve(const Ward& ward, const Direction& l, double side, const std::vector<double>& thetas);

}  // namespace albedo::analysis
