#include "analysis/scenes/plan/pump_orders.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "albedo/core/errors.hpp"
#include "albedo/pumping.hpp"

namespace albedo::analysis {
namespace {

/// What a pumped lobe is short of in a furnace.
double furnace_error(const PumpSequence& sequence, int order, const Look& look, const CosineGrid& grid) {
  constexpr std::size_t stride = 4;
  double largest = 0;
  for (std::size_t i = 0; i < grid.size(); i += stride) {
    const Appearance& at = look.at[i];
    const double part = at.white_albedo <= 1 ? at.facet_reflectance : 1;
    const double missing = std::abs(sequence.albedo(order, grid.cosine(i)) - 1);
    largest = std::max(largest, at.radiance / at.white_albedo * part * missing);
  }
  return largest;
}

}  // namespace

void find_pump_orders(const CaseLooks& looks, const CosineGrid& grid, Plan& plan) {
  if (plan.options.most_pumpings == 0) return;
  std::map<std::string, std::vector<std::size_t>> by_lobe;
  for (std::size_t i = 0; i < plan.cases.size(); ++i) {
    const CaseLook& look = looks[i];
    if (!plan.cases[i].table || look.variation.kind != Variation::Kind::none || !look.looks.front().white) continue;
    if (look.looks.front().white->claims().reciprocal) by_lobe[look.lobe].push_back(i);
  }
  std::vector<std::vector<std::size_t>> lobes;
  for (auto& [name, cases] : by_lobe) lobes.push_back(std::move(cases));
  in_parallel(lobes.size(), plan.options.threads, [&](std::size_t number) {
    const std::vector<std::size_t>& cases = lobes[number];
    try {
      PumpSequence sequence(*looks[cases.front()].looks.front().white, PumpControl::none, false,
                            plan.options.tolerance / 50);
      for (int order = 1; order <= plan.options.most_pumpings; ++order) {
        bool is_done = true;
        sequence.advance();
        for (const std::size_t i : cases) {
          if (plan.cases[i].pumpings) continue;
          const auto is_fine = [&](const Look& look) {
            return furnace_error(sequence, order, look, grid) <= plan.options.tolerance;
          };
          if (std::ranges::all_of(looks[i].looks, is_fine)) plan.cases[i].pumpings = order;
          is_done = is_done && plan.cases[i].pumpings.has_value();
        }
        if (is_done) return;
      }
    } catch (const ParameterError&) {
      // an albedo that vanishes somewhere can't be pumped: it has no order
    }
  });
}

}  // namespace albedo::analysis
