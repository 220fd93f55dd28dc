#include "analysis/scenes/plan/plan_page.hpp"

#include <algorithm>
#include <cmath>

#include "albedo/core/direction.hpp"
#include "analysis/scenes/plan/plan_report.hpp"
#include "analysis/text/svg.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

constexpr std::size_t most_rows = 2000, most_sections = 200;

constexpr const char* style = R"(
:root { color-scheme: light dark; }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2.5rem; } h3 { font-size: 1rem; margin-bottom: .3rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .86rem; font-variant-numeric: tabular-nums; }
th, td { padding: .25rem .6rem; border-bottom: 1px solid #8886; text-align: right; vertical-align: top; }
th:first-child, td:first-child, td.text, th.text { text-align: left; }
code { overflow-wrap: anywhere; } .verdict { font-size: 1.05rem; }
.figures { display: flex; flex-wrap: wrap; gap: 1rem; } svg.chart { max-width: 100%; height: auto; }
svg text { fill: currentColor; font-size: 12px; } svg text.title { font-size: 13px; font-weight: 600; }
svg .grid { stroke: #8884; stroke-width: 1; } svg .band { fill: #3987e533; stroke: none; }
svg polyline { fill: none; stroke-width: 1.8; } svg .exact { stroke: currentColor; stroke-width: 1.2; }
svg .fitted { stroke: #3987e5; } svg .limit { stroke: #d03b3b; stroke-dasharray: 5 4; }
svg .node { fill: #3987e5; stroke: Canvas; stroke-width: 1; }
)";

std::string number(double value, int digits = 3) { return number_text(value, digits); }

std::string cell(const std::string& text, bool is_text = false) {
  return (is_text ? "<td class=\"text\">" : "<td>") + escaped(text) + "</td>";
}

std::string link(const PlanTable& table) { return "<a href=\"#" + table.name + "\">" + table.name + "</a>"; }

void write_summary(std::ostream& out, const Scene& scene, const Plan& plan) {
  out << "<h2>Materials</h2>\n<div class=\"wide\"><table>\n<tr><th>material<th class=\"text\">model<th "
         "class=\"text\">claims<th>largest albedo<th>white lobe<th>furnace error<th>point-light error<th "
         "class=\"text\">needs<th class=\"text\">table<th>pumpings<th class=\"text\">why</tr>\n";
  const std::vector<MaterialSummary> rows = summaries_of(scene, plan);
  for (std::size_t i = 0; i < std::min(rows.size(), most_rows); ++i) {
    const MaterialSummary& row = rows[i];
    out << "<tr>" << cell(row.name) << cell(row.model, true) << cell(row.claims, true) << cell(number(row.largest, 4))
        << cell(row.loss) << cell(number(row.uncorrected.furnace, 2)) << cell(number(row.uncorrected.point, 2))
        << cell(row.need, true) << cell(row.tables, true) << cell(row.pumpings) << cell(row.reason, true) << "</tr>\n";
  }
  out << "</table></div>\n";
  if (rows.size() > most_rows) {
    out << "<p>" << rows.size() - most_rows << " more materials are in plan.json.</p>\n";
  }
  out << "<p>The errors are those without a correction; what is allowed is " << number(plan.options.tolerance)
      << ". The white lobe is the model's own without colour and Fresnel factor: what "
      << "it loses (-) and makes (+) at most. Pumpings: the order of albedo pumping that does as well in a "
         "furnace.</p>\n";
}

void write_tables(std::ostream& out, const Plan& plan) {
  if (plan.tables.empty()) return;
  out << "<h2>Tables</h2>\n<div class=\"wide\"><table>\n<tr><th>table<th class=\"text\">form<th>bits<th>bytes<th>"
         "reflectances<th>lobes<th>furnace error met<th>point-light error met<th>places verified</tr>\n";
  for (const PlanTable& table : plan.tables) {
    out << "<tr><td>" << link(table) << "</td>" << cell(form_text(table), true)
        << cell(std::to_string(table.table.quantisation.bits)) << cell(std::to_string(table.table.bytes()))
        << cell(std::to_string(table.cases.size())) << cell(std::to_string(table.lobes.size()))
        << cell(number(table.met.furnace, 2)) << cell(number(table.met.point, 2))
        << cell(std::to_string(table.verified)) << "</tr>\n";
  }
  out << "</table></div>\n";
}

double theta_of(double cosine) { return Direction::from_cosine(std::min(cosine, 1.0)).theta_degrees(); }

/// The curve (the first row of a table) over angles, as a renderer interpolates it.
Chart values_chart(const PlanTable& planned, const Plan& plan) {
  const PlannedSurface& table = planned.table;
  Chart chart{.title = "White albedo E, as held", .x_label = "angle from the normal [degrees]", .y_label = "E"};
  chart.x_low = plan.options.least_theta,
  chart.x_high = std::max(plan.options.largest_theta, theta_of(planned.cosines[0]));
  const double second = table.second.empty() ? 0 : table.second.front();
  Chart::Line exact{.style = "exact"}, fitted{.style = "fitted"};
  double low = 1, high = 1;
  for (std::size_t i = 0; i < planned.cosines.size(); ++i) {
    const double theta = theta_of(planned.cosines[i]), value = table(second, planned.cosines[i]);
    exact.points.emplace_back(theta, planned.reference[i]);
    fitted.points.emplace_back(theta, value);
    chart.band_low.emplace_back(theta, std::max(planned.low[i], 0.0));
    chart.band_high.emplace_back(theta, std::min(planned.high[i], 1e6));
    low = std::min({low, planned.reference[i], value}), high = std::max({high, planned.reference[i], value});
  }
  const double margin = std::max(0.05 * (high - low), 0.005);
  chart.y_low = std::max(low - margin, 0.0), chart.y_high = high + margin;
  for (std::size_t i = 0; i < table.cosines.size(); ++i) {
    chart.dots.emplace_back(theta_of(table.cosines[i]), table.values[i]);
  }
  chart.lines = {std::move(exact), std::move(fitted)};
  return chart;
}

/// The share of what is allowed that the table uses: 1 is the edge of the band.
Chart share_chart(const PlanTable& planned, const Plan& plan) {
  Chart chart{.title = "Error as a share of what is allowed",
              .x_label = "angle from the normal [degrees]",
              .y_label = "share",
              .x_low = plan.options.least_theta};
  chart.x_high = std::max(plan.options.largest_theta, theta_of(planned.cosines[0]));
  chart.y_low = -1.15, chart.y_high = 1.15;
  const double second = planned.table.second.empty() ? 0 : planned.table.second.front();
  Chart::Line share{.style = "fitted"};
  for (std::size_t i = 0; i < planned.cosines.size(); ++i) {
    const double off = planned.table(second, planned.cosines[i]) - planned.reference[i];
    const double room = off < 0 ? planned.reference[i] - planned.low[i] : planned.high[i] - planned.reference[i];
    share.points.emplace_back(theta_of(planned.cosines[i]), off == 0 ? 0 : off / room);
  }
  chart.lines = {std::move(share)};
  for (const double edge : {-1.0, 1.0}) {
    chart.lines.push_back({.points = {{chart.x_low, edge}, {chart.x_high, edge}}, .style = "limit"});
  }
  return chart;
}

void write_section(std::ostream& out, const PlanTable& table, const Scene& scene, const Plan& plan) {
  constexpr std::size_t most_names = 12;
  out << "<section id=\"" << table.name << "\">\n<h3>" << table.name << ": " << escaped(form_text(table))
      << "</h3>\n<p>" << table.table.quantisation.bits << " bits, " << table.table.bytes() << " bytes; files "
      << table.name << ".exr, " << table.name << ".npy, " << table.name << ".hpp. For ";
  std::vector<std::string> names;
  for (const std::size_t i : table.cases) {
    const std::string& name = scene.materials[plan.cases[i].material].material.name;
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  for (std::size_t i = 0; i < std::min(names.size(), most_names); ++i) out << (i > 0 ? ", " : "") << escaped(names[i]);
  if (names.size() > most_names) out << " and " << names.size() - most_names << " more";
  out << ".</p>\n<div class=\"figures\">\n"
      << svg(values_chart(table, plan)) << svg(share_chart(table, plan)) << "</div>\n";
  out << "<p>Lobe: <code>" << escaped(table.lobes.front()) << "</code>";
  if (table.lobes.size() > 1) out << " and " << table.lobes.size() - 1 << " more";
  out << ". Shaded: what all reflectances that use the table allow; thin: the first one's E";
  if (!table.second.empty()) out << ", at " << table.second << " = " << number(table.table.second.front());
  out << "; blue: the table.</p>\n</section>\n";
}

void write_list(std::ostream& out, const std::string& title, const std::vector<std::string>& items) {
  if (items.empty()) return;
  out << "<h2>" << title << "</h2>\n<ul>\n";
  for (const std::string& item : items) out << "<li>" << escaped(item) << "</li>\n";
  out << "</ul>\n";
}

}  // namespace

void write_plan_page(std::ostream& out, const Scene& scene, const Plan& plan, const nlohmann::ordered_json& object) {
  out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\">\n<title>"
      << escaped(scene.path) << ": energy tables</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>" << style
      << "</style>\n</head>\n<body>\n<h1>What " << escaped(scene.path) << " needs</h1>\n<p class=\"verdict\">"
      << escaped(verdict_of(scene, plan)) << "</p>\n<p>Radiances are right to " << number(plan.options.tolerance)
      << " of white, from " << number(plan.options.least_theta, 4) << " to " << number(plan.options.largest_theta, 4)
      << " degrees from the normal.</p>\n";
  write_summary(out, scene, plan);
  write_tables(out, plan);
  for (std::size_t i = 0; i < std::min(plan.tables.size(), most_sections); ++i) {
    write_section(out, plan.tables[i], scene, plan);
  }
  std::vector<std::string> unmodelled;
  for (const auto& [type, count] : scene.unmodelled) unmodelled.push_back(type + ": " + std::to_string(count));
  write_list(out, "Not modelled", unmodelled);
  write_list(out, "Notes", plan.notes);
  out << "<h2>Made by</h2>\n<p><code>" << escaped(object["command"].get<std::string>()) << "</code>, "
      << escaped(object["generator"].get<std::string>()) << "</p>\n</body>\n</html>\n";
}

}  // namespace albedo::analysis
