#include "analysis/scenes/plan/plan_report.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/text/percent.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

/// Each text once, in order.
void add_once(std::vector<std::string>& list, const std::string& text) {
  if (std::ranges::find(list, text) == list.end()) list.push_back(text);
}

/// What a white lobe loses and makes.
std::string loss_text(double least, double most) {
  std::vector<std::string> parts;
  if (least < 1) parts.push_back('-' + percent(1 - least));
  if (most > 1.0005) parts.push_back('+' + percent(most - 1));
  return parts.empty() ? "0" : joined(parts, " ");
}

Json error_json(const PictureError& error) { return {{"furnace", error.furnace}, {"point", error.point}}; }
Json angle_json(const AtAngle& at) { return {{"value", at.value}, {"theta_deg", at.theta}}; }

Json case_json(const Plan& plan, const PlanCase& planned) {
  Json object{{"need", name_of(planned.need)},
              {"reason", planned.reason},
              {"claims_energy_conservation", planned.claims_conservation},
              {"isotropic", planned.is_isotropic},
              {"isotropic_suffices", !planned.needs_azimuth},
              {"largest_albedo", angle_json(planned.largest)},
              {"largest_loss", {{"value", 1 - planned.least_white.value}, {"theta_deg", planned.least_white.theta}}},
              {"largest_gain", {{"value", planned.most_white.value - 1}, {"theta_deg", planned.most_white.theta}}},
              {"uncorrected_error", error_json(planned.uncorrected)},
              {"corrected_error", error_json(planned.corrected)}};
  object["table"] = planned.table ? Json(plan.tables[*planned.table].name) : Json();
  object["pumpings"] = planned.pumpings ? Json(*planned.pumpings) : Json();
  return object;
}

Json table_json(const PlanTable& planned) {
  const PlannedSurface& table = planned.table;
  Json object{{"name", planned.name},
              {"form", name_of(planned.form)},
              {"bits", table.quantisation.bits},
              {"scale", table.quantisation.scale},
              {"bytes", table.bytes()},
              {"cos_theta", table.cosines}};
  if (!planned.second.empty()) object[planned.second] = table.second;
  object["values"] = table.values;
  object["lobes"] = planned.lobes;
  object["cases"] = planned.cases.size();
  object["verified_error"] = error_json(planned.met);
  object["verified"] = planned.verified;
  object["unverified"] = planned.unverified;
  return object;
}

}  // namespace

std::vector<MaterialSummary> summaries_of(const Scene& scene, const Plan& plan) {
  std::vector<MaterialSummary> all;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const SceneMaterial& material = scene.materials[i];
    MaterialSummary& row = all.emplace_back();
    row.name = material.material.name.empty() ? "(no name)" : material.material.name;
    row.model = material.material.model;
    row.where = material.file + ':' + std::to_string(material.material.line);
    Need need = Need::nothing;
    std::vector<std::string> tables, pumpings, reasons;
    double least = 1, most = 1;
    bool claims = true;
    for (const std::size_t number : plan.of_material[i]) {
      const PlanCase& planned = plan.cases[number];
      need = std::max(need, planned.need);
      claims = claims && planned.claims_conservation;
      least = std::min(least, planned.least_white.value), most = std::max(most, planned.most_white.value);
      row.largest = std::max(row.largest, planned.largest.value);
      row.uncorrected.furnace = std::max(row.uncorrected.furnace, planned.uncorrected.furnace);
      row.uncorrected.point = std::max(row.uncorrected.point, planned.uncorrected.point);
      if (planned.table) {
        add_once(tables, plan.tables[*planned.table].name);
        add_once(pumpings, planned.pumpings ? std::to_string(*planned.pumpings) : "-");
      }
      add_once(reasons, planned.reason);
    }
    row.claims = claims ? "a <= 1" : "nothing";
    row.loss = loss_text(least, most);
    row.need = name_of(need);
    row.tables = tables.empty() ? "-" : joined(tables, ",");
    row.pumpings = pumpings.empty() ? "-" : joined(pumpings, ",");
    row.reason = joined(reasons, "; ");
  }
  return all;
}

std::string form_text(const PlanTable& planned) {
  const PlannedSurface& table = planned.table;
  if (planned.form == Need::constant) return number_text(table.values.front(), 4) + " at every angle";
  const std::string nodes = std::to_string(table.cosines.size()) + " nodes";
  return planned.second.empty() ? nodes
                                : std::to_string(table.second.size()) + " x " + nodes + " over " + planned.second;
}

std::string verdict_of(const Scene& scene, const Plan& plan) {
  std::size_t without = 0;
  for (const std::vector<std::size_t>& cases : plan.of_material) {
    if (std::ranges::all_of(cases, [&](std::size_t i) { return plan.cases[i].need == Need::nothing; })) ++without;
  }
  const std::size_t count = scene.materials.size();
  if (count == 0) return "There is no material that is modelled, and nothing is planned.";
  if (without == count) {
    return count == 1 ? "The material needs no table."
                      : "None of the " + std::to_string(count) + " materials needs a table.";
  }
  const PictureError met = plan.largest_error();
  std::string text = std::to_string(without) + " of " + counted(count, "material needs", "materials need") + " nothing";
  if (plan.tables.empty()) return text + '.';
  text += "; the others share " + counted(plan.tables.size(), "table", "tables") + " of " +
          counted(plan.bytes(), "byte", "bytes") + " together, where 32 x 32 x 32 floats for each material take " +
          std::to_string(plan.usual_bytes()) + ". The largest error met between nodes is " +
          number_text(met.furnace, 2) + " in a white furnace and " + number_text(met.point, 2) +
          " under a point light; " + number_text(plan.options.tolerance, 3) + " is allowed.";
  if (plan.unknown() > 0)
    text += " No table was found for " + counted(plan.unknown(), "reflectance", "reflectances") + '.';
  return text;
}

void print_plan(std::ostream& out, const Scene& scene, const Plan& plan) {
  const std::vector<MaterialSummary> summaries = summaries_of(scene, plan);
  if (!summaries.empty()) {
    std::vector<std::vector<std::string>> rows{
        {"material", "model", "claims", "largest", "white lobe", "furnace", "point", "needs", "table", "pumpings"}};
    for (const MaterialSummary& one : summaries) {
      rows.push_back({one.name, one.model, one.claims, number_text(one.largest, 4), one.loss,
                      number_text(one.uncorrected.furnace, 2), number_text(one.uncorrected.point, 2), one.need,
                      one.tables, one.pumpings});
    }
    print_columns(out, rows);
    out << '\n';
  }
  if (!plan.tables.empty()) {
    std::vector<std::vector<std::string>> rows{{"table", "form", "bits", "bytes", "reflectances", "furnace", "point"}};
    for (const PlanTable& table : plan.tables) {
      rows.push_back({table.name, form_text(table), std::to_string(table.table.quantisation.bits),
                      std::to_string(table.table.bytes()), std::to_string(table.cases.size()),
                      number_text(table.met.furnace, 2), number_text(table.met.point, 2)});
    }
    print_columns(out, rows);
    out << '\n';
  }
  std::vector<std::string> reasons;
  for (const PlanCase& planned : plan.cases) {
    if (planned.need == Need::nothing || planned.need == Need::unknown) {
      add_once(reasons, std::string(planned.need == Need::nothing ? "nothing: " : "unknown: ") + planned.reason);
    }
  }
  constexpr std::size_t most_reasons = 8;
  if (reasons.size() <= most_reasons) {
    for (const std::string& reason : reasons) out << reason << '\n';
  }
  for (const auto& [type, count] : scene.unmodelled) out << "not modelled: " << type << " (" << count << ")\n";
  for (const std::string& note : plan.notes) out << "note: " << note << '\n';
  out << verdict_of(scene, plan) << '\n';
}

nlohmann::ordered_json plan_json(const Scene& scene, const Plan& plan) {
  Json object{{"scene", scene.path},
              {"format", scene.format},
              {"error", plan.options.tolerance},
              {"theta_deg", {plan.options.least_theta, plan.options.largest_theta}},
              {"declared", scene.declared},
              {"unmodelled", scene.unmodelled},
              {"notes", plan.notes},
              {"bytes", plan.bytes()},
              {"usual_bytes", plan.usual_bytes()},
              {"verified_error", error_json(plan.largest_error())},
              {"verdict", verdict_of(scene, plan)}};
  object["materials"] = Json::array();
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const SceneMaterial& material = scene.materials[i];
    Json entry{{"name", material.material.name}, {"model", material.material.model}, {"type", material.type},
               {"file", material.file},          {"line", material.material.line},   {"uses", material.uses}};
    for (std::size_t c = 0; c < plan.of_material[i].size(); ++c) {
      const std::string channel = plan.of_material[i].size() == 1 ? "all" : plan.channels[c];
      entry["channels"][channel] = case_json(plan, plan.cases[plan.of_material[i][c]]);
    }
    object["materials"].push_back(std::move(entry));
  }
  object["tables"] = Json::array();
  for (const PlanTable& table : plan.tables) object["tables"].push_back(table_json(table));
  return object;
}

}  // namespace albedo::analysis
