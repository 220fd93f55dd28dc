#pragma once

#include "albedo/core/direction.hpp"
#include "albedo/models/ward.hpp"

/// Upper bounds of f(L,V) cosθ_V over sets of directions V, as hierarchical renderers need them   [Walter 2005, §4;
/// derived in doc/bounds.md]. They hold in floating point: every intermediate result is widened by what its rounding
/// may be, and no bound is below the exact value of the parameters given.
namespace albedo {

/// The directions V = v/|v| of all v of a box, x_min ≤ v_x ≤ x_max and so on, in the surface's frame; it may lie partly
/// or wholly below the surface, and may contain the origin (which stands for no direction). Any unit of length.
struct DirectionBox {
  double x_min, x_max;
  double y_min, y_max;
  double z_min, z_max;
};

/// The largest cosθ_V over a box, negative if it is below the surface   [Walter 2005, eq. 27]; within [−1, 1].
/// @throws ParameterError unless every minimum is at most its maximum, and both are 0 or of magnitude within [1e-150,
/// 1e150].
double cosine_bound(const DirectionBox& box);

/// The largest N·H over the part of a box that is above the surface   [Walter 2005, eqs. 28–31 with v_x* in eq. 29 and
/// θ_n* in eq. 31]; within [0, 1], and 0 if there is no such part.
/// @throws ParameterError as cosine_bound.
double half_vector_cosine_bound(const Direction& l, const DirectionBox& box);

/// An upper bound of f(L,V) cosθ_V over a box [1/sr], f Ward's model with its Lambertian part; 0 if the box is below
/// the surface, and infinite at cosθ_L = 0 if not.
///
///     ρ_d/π max cosθ_V + ρ_s/(4π α_x α_y) √(max cosθ_V/cosθ_L) exp(−E),   E = max(E₁, E₂)
///
/// E₁ = min tan²θ_H/max(α_x, α_y)² is Walter's eq. 33, with the larger roughness where there are two of them (he leaves
/// those open); E₂ = ((min |L_x + V_x|/α_x)² + (min |L_y + V_y|/α_y)²)/(max (N·L + N·V))², from the ranges of V's own
/// components.
/// @throws ParameterError as cosine_bound.
double upper_bound(const Ward& ward, const Direction& l, const DirectionBox& box);

}  // namespace albedo
