#pragma once

#include <cstdint>
#include <vector>

#include "albedo/core/model.hpp"

namespace albedo {

/// ∫ f(L,V) dφ_V for a fixed L, over all azimuths of V.
class AzimuthIntegral {
 public:
  AzimuthIntegral(const Model& model, const Direction& l);

  struct Result {
    double value = 0, error = 0;
  };

  /// @param x −ln cosθ_V
  /// @param absolute error that is good enough
  /// @param relative error that is good enough
  Result operator()(double x, double absolute, double relative);

  [[nodiscard]] const UnitVector<double>& light() const { return l_; }
  [[nodiscard]] const std::vector<Lobe>& lobes() const { return lobes_; }
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

 private:
  /// One lobe at one polar angle of V, as a function of the azimuth from the lobe's centre, at either side of it.
  struct Ring {
    const Lobe& lobe;
    UnitVector<Block> axis;
    double cos_c, sin_c;  ///< azimuth of the centre
    double cos_v, sin_v;
    double width;  ///< in azimuth
  };

  [[nodiscard]] Ring ring(const Lobe& lobe, double x) const;
  /// f at azimuths of so many quarter turns from the centre.
  Block evaluate(const Ring& ring, const Block& quarters, double side, int count);
  bool over_turn(const Ring& ring, double absolute, double relative, Result& result);
  void over_panels(const Ring& ring, double absolute, double relative, Result& result);
  Result kronrod(const Ring& ring, double begin, double end, double side);

  const Model& model_;
  std::vector<Lobe> lobes_;
  bool halved_;  // f is symmetric about the plane of incidence
  UnitVector<double> l_;
  UnitVector<Block> l_block_;
  double cos_phi_, sin_phi_;  // of the azimuth opposite to L's
  std::int64_t evaluations_ = 0;
};

}  // namespace albedo
