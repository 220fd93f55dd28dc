#include "analysis/studies/atlas_report.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "analysis/files/atomic_file.hpp"
#include "analysis/files/study_file.hpp"
#include "analysis/studies/methods.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array columns{"model",   "anisotropy", "parameter",      "value",       "theta_deg", "from_grazing_deg",
                             "phi_deg", "rule",       "warp",           "precision",   "verdict",   "albedo",
                             "error",   "status",     "relative_error", "evaluations", "reference", "reference_error"};

/// Calls write(fields) for every answer, in the order of the columns; numbers have their digits already.
template <class Write>
void for_each_answer(const Atlas& atlas, const Write& write) {
  std::vector<Json> fields(columns.size());
  for (std::size_t s = 0; s < atlas.surfaces.size(); ++s) {
    const Surface& surface = atlas.surfaces[s];
    for (std::size_t w = 0; w < surface.values.size(); ++w) {
      for (std::size_t i = 0; i < atlas.from_grazing.size(); ++i) {
        const std::size_t cell = atlas.cell(s, w, i);
        for (std::size_t m = 0; m < atlas.methods.size(); ++m) {
          if (!atlas.applies(s, m)) continue;
          const Answer& answer = atlas.answer(cell, m);
          const AtlasMethod& method = atlas.methods[m];
          fields = {surface.model,
                    surface.anisotropy,
                    surface.parameter,
                    surface.values[w],
                    90 - atlas.from_grazing[i],
                    atlas.from_grazing[i],
                    surface.phi_degrees,
                    name_of(method.rule),
                    name_of(method.warp),
                    name_of(method.form),
                    name_of(answer.verdict),
                    answer.estimate.value,
                    answer.estimate.error,
                    to_string(answer.estimate.status),
                    answer.relative_error,
                    answer.estimate.evaluations,
                    atlas.references[cell].value,
                    atlas.references[cell].error};
          write(fields);
        }
      }
    }
  }
}

std::string csv_text(const Json& field) {
  if (field.is_string()) return field.get<std::string>();
  return field.is_number_float() ? number_text(field.get<double>()) : field.dump();
}

void write_csv(const Atlas& atlas, const Json& provenance, std::ostream& out) {
  write_provenance(provenance, out);
  const char* separator = "";
  for (const char* const column : columns) out << separator << column, separator = ",";
  out << '\n';
  for_each_answer(atlas, [&out](const std::vector<Json>& fields) {
    const char* between = "";
    for (const Json& field : fields) out << between << csv_text(field), between = ",";
    out << '\n';
  });
}

void write_json(const Atlas& atlas, const Json& provenance, std::ostream& out) {
  out << "{\"provenance\": " << json_text(provenance) << ",\n\"columns\": " << json_text(Json(columns))
      << ",\n\"answers\": [";
  const char* separator = "\n";
  for_each_answer(atlas, [&](const std::vector<Json>& fields) {
    out << separator << json_text(Json(fields));
    separator = ",\n";
  });
  out << "\n]}\n";
}

}  // namespace

std::vector<MethodCount> count_verdicts(const Atlas& atlas) {
  std::vector<MethodCount> counts;
  for (std::size_t m = 0; m < atlas.methods.size(); ++m) {
    MethodCount& count = counts.emplace_back();
    count.method = atlas.methods[m];
    for (std::size_t s = 0; s < atlas.surfaces.size(); ++s) {
      if (!atlas.applies(s, m)) continue;
      for (std::size_t cell = atlas.cell(s, 0, 0); cell < atlas.cell(s + 1, 0, 0); ++cell) {
        const Answer& answer = atlas.answer(cell, m);
        ++count.verdicts[static_cast<std::size_t>(answer.verdict)];
        if (answer.verdict != Verdict::unconverged && answer.verdict != Verdict::wrong) continue;
        ++(answer.relative_error < 0 ? count.below : count.above);
        if (answer.verdict == Verdict::wrong) count.worst = std::max(count.worst, std::abs(answer.relative_error));
      }
    }
  }
  return counts;
}

void print_atlas(const Atlas& atlas, std::ostream& out) {
  std::vector<std::vector<std::string>> rows{{"rule", "warp", "precision", "right", "right, unconverged",
                                              "off, says so", "WRONG, CONVERGED", "worst", "NaN or inf", "no reference",
                                              "below", "above"}};
  for (const MethodCount& count : count_verdicts(atlas)) {
    const auto number = [&count](Verdict verdict) {
      return std::to_string(count.verdicts[static_cast<std::size_t>(verdict)]);
    };
    rows.push_back({std::string(name_of(count.method.rule)), std::string(name_of(count.method.warp)),
                    std::string(name_of(count.method.form)), number(Verdict::right), number(Verdict::right_unconverged),
                    number(Verdict::unconverged), number(Verdict::wrong),
                    count.worst > 0 ? number_text(count.worst, 2) : "-", number(Verdict::non_finite),
                    number(Verdict::unknown), std::to_string(count.below), std::to_string(count.above)});
  }
  print_columns(out, rows);
}

Json atlas_summary(const Atlas& atlas) {
  const AtlasOptions& options = atlas.options;
  Json object{{"tolerance", options.tolerance}, {"random_tolerance", options.random_tolerance},
              {"random_slack", random_slack},   {"budget", options.budget},
              {"seed", options.seed},           {"incidences", options.incidences},
              {"widths", options.widths},       {"anisotropy", options.anisotropy},
              {"models", options.models}};
  object["methods"] = Json::array();
  for (const MethodCount& count : count_verdicts(atlas)) {
    Json entry{{"rule", name_of(count.method.rule)},
               {"warp", name_of(count.method.warp)},
               {"precision", name_of(count.method.form)}};
    for (const Verdict verdict : all_verdicts) {
      entry[std::string(name_of(verdict))] = count.verdicts[static_cast<std::size_t>(verdict)];
    }
    entry["below"] = count.below;
    entry["above"] = count.above;
    entry["worst_relative_error"] = count.worst;
    object["methods"].push_back(std::move(entry));
  }
  return object;
}

void write_atlas(const Atlas& atlas, Json provenance, const std::string& path) {
  Json summary = atlas_summary(atlas);
  summary.erase("methods");
  provenance.update(summary);
  AtomicFile file(path);
  if (is_json_path(path)) {
    write_json(atlas, provenance, file.stream());
  } else {
    write_csv(atlas, provenance, file.stream());
  }
  file.commit();
}

}  // namespace albedo::analysis
