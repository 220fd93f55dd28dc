#include "analysis/studies/tradeoff_writer.hpp"

#include <string>

#include "analysis/files/csv_writer.hpp"
#include "analysis/files/study_file.hpp"
#include "analysis/subjects/model_text.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Quad& value) {
  constexpr int digits = 25;
  return value.str(digits, std::ios_base::scientific);
}

}  // namespace

Json describe(const TradeoffRequest& request) {
  Json object{{"errors", "relative to a reference in 113 bits"},
              {"reference_tolerance", request.reference_tolerance},
              {"phi_deg", request.phi},
              {"precision", name_of(request.precision)},
              {"budget", request.budget},
              {"seed", request.seed},
              {"seconds", "median of " + std::to_string(request.repeats) +
                              " turns (longer than a millisecond: every other) in which all runs of a direction "
                              "alternate, on one thread"}};
  for (const TradeoffMaterial& material : request.materials) {
    object["material " + material.model + " " + material.label] = parameters_text(material.parameters);
  }
  return object;
}

void write_csv(const Json& provenance, const Tradeoff& study, std::ostream& out) {
  write_provenance(provenance, out);
  out << "model,material,theta_deg,rule,warp,tolerance,albedo,true_error,reported_error,error_kind,evaluations,seconds,"
         "status,reference,reference_error\n";
  for (const TradeoffCell& cell : study.cells) {
    const TradeoffMaterial& material = study.request.materials[cell.material];
    for (const TradeoffRun& run : cell.runs) {
      out << csv_field(material.model) << ',' << csv_field(material.label) << ',' << number_text(cell.theta) << ','
          << name_of(run.method.rule) << ',' << name_of(run.method.warp) << ',' << number_text(run.tolerance) << ','
          << number_text(run.estimate.value) << ',' << number_text(run.true_error) << ','
          << number_text(run.reported_error) << ',' << to_string(run.estimate.error_kind) << ','
          << run.estimate.evaluations << ',' << number_text(run.seconds) << ',' << to_string(run.estimate.status) << ','
          << text_of(cell.reference.value) << ',' << number_text(cell.slack()) << '\n';
    }
  }
}

Json with_cells(Json object, const Tradeoff& study) {
  object["cells"] = Json::array();
  for (const TradeoffCell& cell : study.cells) {
    const TradeoffMaterial& material = study.request.materials[cell.material];
    Json entry{{"model", material.model},
               {"material", material.label},
               {"parameters", parameters_json(material.parameters)},
               {"theta_deg", cell.theta},
               {"reference", text_of(cell.reference.value)},
               {"reference_error", cell.slack()},
               {"reference_status", to_string(cell.reference.status)},
               {"runs", Json::array()}};
    for (const TradeoffRun& run : cell.runs) {
      entry["runs"].push_back({{"rule", name_of(run.method.rule)},
                               {"warp", name_of(run.method.warp)},
                               {"tolerance", run.tolerance},
                               {"albedo", run.estimate.value},
                               {"true_error", run.true_error},
                               {"reported_error", run.reported_error},
                               {"error_kind", to_string(run.estimate.error_kind)},
                               {"evaluations", run.estimate.evaluations},
                               {"seconds", run.seconds},
                               {"status", to_string(run.estimate.status)}});
    }
    object["cells"].push_back(std::move(entry));
  }
  return object;
}

}  // namespace albedo::analysis
