/// @file
/// The critical region of Neumann, Neumann, Szirmay-Kalos 1999, §2.1: the directions V that see, for every L of an arc
/// of grazing directions, a half vector within a cap around N.
#pragma once

#include <vector>

#include "albedo/core/direction.hpp"

namespace albedo::analysis {

/// A point of a chart.
struct ChartPoint {
  double x = 0, y = 0;
};

/// The domains: L = (sinθ, 0, cosθ) with θ from first_theta to 90°, and H within cap_angle of N. All angles in degrees.
struct CriticalDomains {
  double first_theta = 75;
  double cap_angle = 8;
};

/// The whole upper hemisphere and some of what is below, with N in the middle: x = θ cosφ, y = θ sinφ [degrees].
ChartPoint hemisphere_point(const UnitVector<double>& direction);

/// The slopes H_x/H_z, H_y/H_z of the half vector of a pair of directions, above the horizon on average.
ChartPoint slope_point(const UnitVector<double>& l, const UnitVector<double>& v);

/// The largest angle [degrees] between N and the half vector of V with an L of the arc.
double furthest_half_vector(const CriticalDomains& domains, const UnitVector<double>& v);

struct CriticalRegion {
  CriticalDomains domains{};
  std::vector<UnitVector<double>> from_first{};  ///< outline of the V that L at first_theta mirrors in the cap
  std::vector<UnitVector<double>> from_last{};   ///< the same of L at 90°
  std::vector<UnitVector<double>> region{};      ///< outline of the critical region; empty if there is none
  double solid_angle = 0;                        ///< of the critical region [sr]
};

/// Outlines of so many points. The arc must not be longer than 8 caps: beyond, domains overlap behind N.
/// @throws ParameterError unless 0 < cap_angle ≤ 20 and 90 − 8 cap_angle ≤ first_theta < 90
CriticalRegion critical_region(const CriticalDomains& domains, int points = 720);

}  // namespace albedo::analysis
