#include "analysis/scenes/plan/sharing.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/text/percent.hpp"

namespace albedo::analysis {
namespace {

/// Cases that one curve serves.
struct Group {
  std::vector<std::size_t> cases{};
  Tube tube{};
  std::optional<PlannedCurve> curve{};
};

/// What is left of the tolerance for what lies between the places of the grid, and for errors of the samples.
constexpr double planned_share = 0.995;

std::string reason_of(const PlanCase& planned) {
  const double loss = 1 - planned.least_white.value, gain = planned.most_white.value - 1;
  std::string text;
  constexpr double little = 5e-4;
  if (loss > little) text = "it loses up to " + percent(loss) + " of the light";
  if (gain > little) text += (text.empty() ? "it makes up to " : " and makes up to ") + percent(gain);
  if (text.empty()) text = loss > 1e-9 ? "it loses less than 0.1 % of the light" : "it loses no light";
  return text;
}

SurfaceReference reference_of(const CaseLook& look) {
  SurfaceReference reference{.second = look.references};
  reference.values.resize(look.references.size());
  reference.tubes.resize(look.references.size());
  for (const Look& one : look.looks) {
    std::vector<double>& values = reference.values[one.second];
    if (!values.empty()) continue;
    for (const Appearance& at : one.at) values.push_back(at.white_albedo);
  }
  return reference;
}

class Tables {
 public:
  Tables(const CaseLooks& looks, const CosineGrid& grid, Plan& plan)
      : looks_(looks), grid_(grid), plan_(plan), tolerance_(planned_share * plan.options.tolerance) {}

  /// One group a lobe; what needs two variables goes to `surfaces`.
  void sort() {
    for (std::size_t i = 0; i < plan_.cases.size(); ++i) {
      PlanCase& planned = plan_.cases[i];
      const CaseLook& look = looks_[i];
      if (!look.reason.empty() || look.looks.empty()) continue;
      planned.reason = reason_of(planned);
      const Tube tube = look.tube(tolerance_);
      if (tube.holds(1)) {
        planned.need = Need::nothing;
        planned.corrected = planned.uncorrected;
        planned.reason += planned.uncorrected.largest() < 1e-6 ? "" : ", too little to be seen";
        continue;
      }
      const bool has_curve = look.variation.kind == Variation::Kind::none || smallest_curve(tube, grid_).has_value();
      auto& groups = has_curve ? curves_ : surfaces_;
      const auto [found, is_new] = numbers_.try_emplace((has_curve ? "1 " : "2 ") + look.lobe, groups.size());
      if (is_new) groups.push_back({.tube = Tube(grid_.size())});
      groups[found->second].cases.push_back(i);
      groups[found->second].tube.intersect(tube);
    }
  }

  /// In the order of their albedos at the largest angle, each joins one before it where that saves bytes.
  void merge() {
    for (Group& group : curves_) group.curve = smallest_curve(group.tube, grid_);
    std::vector<Group> known;
    for (Group& group : curves_) {
      if (group.curve) {
        known.push_back(std::move(group));
      } else {
        give_up(group);
      }
    }
    const auto middle = [](const Group& group) { return std::max(group.tube.low[0], 0.0) + group.tube.high[0]; };
    std::ranges::stable_sort(known, {}, middle);
    for (Group& group : known) {
      const bool has_joined =
          std::any_of(merged_.rbegin(), merged_.rend(), [&](Group& other) { return join(other, group); });
      if (!has_joined) merged_.push_back(std::move(group));
    }
    std::ranges::stable_sort(merged_, {}, [](const Group& group) { return *std::ranges::min_element(group.cases); });
  }

  void write() {
    for (Group& group : merged_) {
      std::ranges::sort(group.cases);
      PlanTable table{.form = group.curve->values.size() == 1 ? Need::constant : Need::curve,
                      .table = PlannedSurface(*group.curve),
                      .cases = group.cases};
      add(std::move(table), group.tube);
    }
    for (Group& group : surfaces_) {
      const CaseLook& first = looks_[group.cases.front()];
      SurfaceReference reference = reference_of(first);
      for (std::size_t second = 0; second < reference.second.size(); ++second) {
        reference.tubes[second] = first.tube(second, tolerance_);
        for (const std::size_t i : group.cases) reference.tubes[second].intersect(looks_[i].tube(second, tolerance_));
      }
      std::optional<PlannedSurface> surface = least_surface(reference, grid_);
      if (!surface) {
        give_up(group);
        continue;
      }
      PlanTable table{
          .form = Need::surface, .second = first.variation.name(), .table = std::move(*surface), .cases = group.cases};
      add(std::move(table), reference.tubes.front());
    }
  }

 private:
  /// Whether `group` has become a part of `other`.
  bool join(Group& other, Group& group) {
    Tube both = other.tube;
    both.intersect(group.tube);
    if (both.is_empty()) return false;
    std::optional<PlannedCurve> curve = smallest_curve(both, grid_);
    if (!curve || curve->bytes() > other.curve->bytes() + group.curve->bytes()) return false;
    other.cases.insert(other.cases.end(), group.cases.begin(), group.cases.end());
    other.tube = std::move(both), other.curve = std::move(curve);
    return true;
  }

  void give_up(const Group& group) {
    for (const std::size_t i : group.cases) {
      plan_.cases[i].need = Need::unknown;
      plan_.cases[i].reason = "no table over the places of the grid is exact enough";
    }
  }

  void add(PlanTable table, const Tube& tube) {
    table.name =
        std::string(table.form == Need::surface ? "table_" : "curve_") + std::to_string(plan_.tables.size() + 1);
    table.cosines = grid_.cosines();
    table.low = tube.low, table.high = tube.high;
    for (const Appearance& at : looks_[table.cases.front()].looks.front().at)
      table.reference.push_back(at.white_albedo);
    for (const std::size_t i : table.cases) {
      const CaseLook& look = looks_[i];
      PlanCase& planned = plan_.cases[i];
      planned.need = table.form;
      planned.table = plan_.tables.size();
      planned.needs_azimuth = table.second == "phi";
      if (look.variation.kind == Variation::Kind::azimuth) {
        planned.reason +=
            planned.needs_azimuth ? "; one curve doesn't serve all azimuths" : "; one curve serves all azimuths";
      }
      const std::string lobe = look.lobe.substr(0, look.lobe.find(';'));
      if (std::ranges::find(table.lobes, lobe) == table.lobes.end()) table.lobes.push_back(lobe);
      for (const Look& one : look.looks) {
        for (std::size_t k = 0; k < grid_.size(); ++k) {
          const PictureError error =
              picture_error(one.at[k], table.table(look.references[one.second], grid_.cosine(k)));
          planned.corrected.furnace = std::max(planned.corrected.furnace, error.furnace);
          planned.corrected.point = std::max(planned.corrected.point, error.point);
        }
      }
    }
    plan_.tables.push_back(std::move(table));
  }

  const CaseLooks& looks_;
  const CosineGrid& grid_;
  Plan& plan_;
  double tolerance_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<Group> curves_, surfaces_, merged_;
};

}  // namespace

void make_tables(const CaseLooks& looks, const CosineGrid& grid, Plan& plan) {
  Tables tables(looks, grid, plan);
  tables.sort();
  tables.merge();
  tables.write();
}

}  // namespace albedo::analysis
