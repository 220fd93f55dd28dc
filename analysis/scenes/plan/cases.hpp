/// @file
/// Every case of a plan over all its angles and textures.
#pragma once

#include <string>
#include <vector>

#include "analysis/scenes/plan/plan.hpp"
#include "analysis/scenes/plan/samples.hpp"
#include "analysis/scenes/plan/variants.hpp"

namespace albedo::analysis {

/// A case at one place of its second variable and at one end of its colours.
struct Look {
  std::size_t second = 0;                ///< index among the references
  std::vector<Appearance> at{};          ///< at the grid's cosines
  std::shared_ptr<const Model> white{};  ///< null if that isn't known
};

/// A case's looks, or why there are none.
struct CaseLook {
  Variation variation{};
  std::vector<double> references{};
  std::vector<Look> looks{};
  std::string lobe{};         ///< the white lobe as text: equal for cases that can share a table of two variables
  std::string reason{};       ///< not empty: nothing is to be planned
  Need need = Need::unknown;  ///< then: nothing or unknown

  /// What a table may be at one of the references.
  [[nodiscard]] Tube tube(std::size_t second, double tolerance) const;
  /// What a curve may be that serves all of them.
  [[nodiscard]] Tube tube(double tolerance) const;
};

class CaseLooks {
 public:
  /// Samples every lobe of the plan's cases. @throws FormatError for a material that isn't one
  CaseLooks(const Scene& scene, const Plan& plan, const CosineGrid& grid, int refinement);

  [[nodiscard]] const CaseLook& operator[](std::size_t i) const { return looks_[i]; }

  /// Fills in what cases claim and what is so.
  void describe(Plan& plan) const;

 private:
  const CosineGrid& grid_;
  std::vector<CaseLook> looks_;
  std::vector<std::shared_ptr<const Model>> wholes_;
};

}  // namespace albedo::analysis
