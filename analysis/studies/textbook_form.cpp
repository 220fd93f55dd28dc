#include "analysis/studies/textbook_form.hpp"

#include "warps/sample.hpp"

namespace albedo::analysis {

float TextbookModel::evaluate(int component, const DirectionPair<float>& pair) const noexcept {
  const UnitVector<float> l{pair.l_x, pair.l_y, pair.cos_theta_l}, v{pair.v_x, pair.v_y, pair.cos_theta_v};
  UnitVector<float> axis{-l.x, -l.y, l.z};
  for (const Lobe& lobe : lobes_) {
    if (lobe.component == component) axis = lobe_axis(lobe, l);
  }
  return model_.evaluate(component, textbook_pair(l, v, axis));
}

}  // namespace albedo::analysis
