#include "analysis/scenes/plan/plan_files.hpp"

#include <filesystem>
#include <system_error>

#include "analysis/files/atomic_file.hpp"
#include "analysis/files/table_document.hpp"
#include "analysis/scenes/plan/plan_page.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

std::string inside(const std::string& directory, const std::string& name) {
  return (std::filesystem::path(directory) / name).string();
}

TableDocument document_of(const PlanTable& planned, const Plan& plan, const nlohmann::ordered_json& object) {
  TableDocument document{.name = "plan_" + planned.name};
  const PlannedSurface& table = planned.table;
  if (!table.second.empty()) {
    const std::string unit = planned.second == "phi" ? "degrees" : "";
    document.axes.push_back({.name = planned.second, .values = table.second, .unit = unit});
  }
  document.axes.push_back({.name = "cos_theta", .values = table.cosines});
  document.values = table.values.data();
  document.provenance = {
      {"generator", object["generator"]},
      {"command", object["command"]},
      {"entries", "albedo of the white lobe; f is to be multiplied by 1 + F0 (1 - E)/E, or 1/E if E > 1"},
      {"interpolated", "linearly; constant beyond the ends"},
      {"lobes", planned.lobes},
      {"theta_deg", {plan.options.least_theta, plan.options.largest_theta}},
      {"error", plan.options.tolerance},
      {"bits", table.quantisation.bits},
      {"scale", table.quantisation.scale},
      {"bytes", table.bytes()},
      {"furnace_error", planned.met.furnace},
      {"point_error", planned.met.point}};
  return document;
}

}  // namespace

void check_plan_directory(const std::string& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw cannot_write(directory, error.message());
  AtomicFile::check(inside(directory, "plan.json"));
}

void write_plan(const Scene& scene, const Plan& plan, const nlohmann::ordered_json& object,
                const std::string& directory) {
  for (const PlanTable& table : plan.tables) {
    const TableDocument document = document_of(table, plan, object);
    for (const char* ending : {".exr", ".npy", ".hpp"}) write_table(document, inside(directory, table.name + ending));
  }
  AtomicFile json(inside(directory, "plan.json"));
  json.stream() << json_text(object) << '\n';
  AtomicFile page(inside(directory, "plan.html"));
  write_plan_page(page.stream(), scene, plan, object);
  json.commit();
  page.commit();
}

}  // namespace albedo::analysis
