#include "analysis/studies/audit_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/files/csv_writer.hpp"
#include "analysis/files/study_file.hpp"
#include "analysis/subjects/model_text.hpp"
#include "analysis/text/text.hpp"
#include "numerics/larger.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

double critical_degrees(const EnergyAudit& energy) {
  if (!energy.critical) return std::numeric_limits<double>::quiet_NaN();
  return Direction::from_cosine(energy.critical->cos_theta).theta_degrees();
}

std::string short_text(double value) { return number_text(value, 6); }
std::string with_error(double value, double error) { return short_text(value) + " +- " + number_text(error, 2); }
std::string with_error(const Estimate& estimate) {
  return std::isinf(estimate.value) ? "infinite" : with_error(estimate.value, estimate.error);
}
std::string place(double theta, double phi) {
  return short_text(theta) + " degrees" + (phi != 0 ? ", azimuth " + short_text(phi) : "");
}

std::string energy_text(const EnergyAudit& energy) {
  std::string text =
      "largest albedo " + with_error(energy.largest) + " at " + place(energy.theta_degrees, energy.phi_degrees);
  if (energy.critical) {
    const double angle = critical_degrees(energy);
    text += "; passes 1 at ";
    text += 90 - angle < 1e-3 ? "cos theta " + short_text(energy.critical->cos_theta)
                              : place(angle, energy.critical_phi_degrees);
  }
  if (energy.unconverged > 0) text += "; " + std::to_string(energy.unconverged) + " directions missed the tolerance";
  return text;
}

std::string law_text(const PowerLaw& law) {
  if (law.status != Status::converged) return "none";
  const std::string constant = with_error(law.constant, law.constant_error);
  if (law.exponent == 0) return constant;
  const std::string error =
      law.exponent_error > 0 ? "(" + with_error(-law.exponent, law.exponent_error) + ")" : short_text(-law.exponent);
  return constant + " (N.L)^" + error;
}

std::string sampler_text(const std::vector<SamplerAudit>& samplers) {
  if (samplers.empty()) return "none published";
  double least_p = 1, integral = 0, mismatch = 0, weight = 0;
  for (const SamplerAudit& one : samplers) {
    least_p = std::min(least_p, one.p_value);
    keep_larger(integral, std::abs(one.density_integral.value - 1));
    keep_larger(mismatch, one.density_mismatch);
    const double deviation = std::abs(one.mean_weight.value - one.albedo.value);
    weight = std::max(weight, deviation / std::hypot(one.mean_weight.error, one.albedo.error));
  }
  return "smallest p of chi-squared " + number_text(least_p, 2) + " in " + std::to_string(samplers.size()) +
         " tests; density integral within " + number_text(integral, 2) + " of 1, its values within " +
         number_text(mismatch, 2) + "; mean weight within " + number_text(weight, 2) + " errors of the albedo";
}

struct Line {
  std::string check;
  std::string verdict;
  std::string finding;
};

std::vector<Line> lines_of(const AuditCase& one) {
  const Audit& audit = one.audit;
  const auto word = [](Verdict verdict) { return std::string(to_string(verdict)); };
  std::vector<Line> lines{{"energy", word(audit.energy.verdict), energy_text(audit.energy)}};
  std::string grazing = std::isinf(audit.energy.largest.value) ? "infinite at grazing incidence" : "finite everywhere";
  if (audit.grazing) {
    grazing = "~ " + law_text(audit.grazing->limit) + " from the limit integral, " + law_text(audit.grazing->fit) +
              " fitted" + (audit.grazing->agree() ? "" : "; they don't agree");
  }
  lines.push_back({"bounded", word(audit.energy.bounded), grazing});
  const ReciprocityAudit& reciprocity = audit.reciprocity;
  if (reciprocity.verdict != Verdict::not_applicable) {
    std::string text = "largest asymmetry " + number_text(reciprocity.asymmetry, 2) + " of " +
                       std::to_string(reciprocity.pairs) + " pairs";
    if (reciprocity.asymmetry > 1e-9) {
      text += ", at L " + short_text(reciprocity.l.theta_degrees()) + " and V " +
              short_text(reciprocity.v.theta_degrees()) + " degrees";
    }
    lines.push_back({"reciprocity", word(reciprocity.verdict), text});
  }
  if (one.options.facets) {
    const DistributionAudit& distribution = audit.distribution;
    const bool has = distribution.verdict != Verdict::not_applicable;
    lines.push_back({"distribution", word(distribution.verdict),
                     has ? "integral of D cos theta_h " + with_error(distribution.projected) + ", of D " +
                               with_error(distribution.solid_angle)
                         : ""});
    const MaskingAudit& masking = audit.masking;
    lines.push_back({"masking", word(masking.verdict),
                     masking.verdict != Verdict::not_applicable
                         ? "weak white furnace farthest from 1: " + with_error(masking.furthest) + " at " +
                               place(masking.theta_degrees, masking.phi_degrees)
                         : ""});
  }
  if (one.options.samplers) lines.push_back({"samplers", word(audit.sampler_verdict()), sampler_text(audit.samplers)});
  if (one.options.average)
    lines.push_back({"average", "", "albedo under uniform light " + with_error(audit.average.albedo)});
  return lines;
}

void print(std::ostream& out, const std::vector<std::vector<std::string>>& rows, bool markdown) {
  if (!markdown) {
    print_columns(out, rows);
    return;
  }
  for (const auto& row : rows) {
    out << "| " << joined(row, " | ") << " |\n";
    if (&row != &rows.front()) continue;
    out << '|';
    for (std::size_t i = 0; i < row.size(); ++i) out << "---|";
    out << '\n';
  }
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

Json estimate_json(const Estimate& estimate) {
  return {{"value", estimate.value},
          {"error", estimate.error},
          {"error_kind", to_string(estimate.error_kind)},
          {"evaluations", estimate.evaluations},
          {"status", to_string(estimate.status)}};
}

Json law_json(const PowerLaw& law) {
  return {{"exponent", law.exponent},
          {"exponent_error", law.exponent_error},
          {"constant", law.constant},
          {"constant_error", law.constant_error},
          {"status", to_string(law.status)}};
}

Json direction_json(const Direction& direction) {
  return {{"theta_deg", direction.theta_degrees()},
          {"phi_deg", std::atan2(direction.sin_phi, direction.cos_phi) * 180 / pi<double>}};
}

Json energy_json(const EnergyAudit& energy) {
  Json object{{"verdict", to_string(energy.verdict)}, {"largest", energy.largest.value},
              {"error", energy.largest.error},        {"status", to_string(energy.largest.status)},
              {"theta_deg", energy.theta_degrees},    {"phi_deg", energy.phi_degrees},
              {"unconverged", energy.unconverged}};
  if (energy.critical) {
    object["passes_1"] = {{"theta_deg", critical_degrees(energy)},
                          {"phi_deg", energy.critical_phi_degrees},
                          {"cos_theta", energy.critical->cos_theta},
                          {"error", energy.critical->error}};
  } else {
    object["passes_1"] = nullptr;
  }
  return object;
}

Json sampler_json(const SamplerAudit& sampler) {
  return {{"lobe", sampler.component},
          {"theta_deg", sampler.theta_degrees},
          {"phi_deg", sampler.phi_degrees},
          {"verdict", to_string(sampler.verdict)},
          {"chi_squared", sampler.chi_squared},
          {"degrees_of_freedom", sampler.degrees_of_freedom},
          {"p_value", sampler.p_value},
          {"density_integral", sampler.density_integral.value},
          {"density_integral_error", sampler.density_integral.error},
          {"below_horizon", sampler.below_horizon},
          {"density_mismatch", sampler.density_mismatch},
          {"mean_weight", sampler.mean_weight.value},
          {"mean_weight_error", sampler.mean_weight.error},
          {"albedo", sampler.albedo.value},
          {"albedo_error", sampler.albedo.error}};
}

}  // namespace

void print_checks(std::ostream& out, const AuditCase& one) {
  out << one.model->info().name << ' ' << parameters_text(one.model->parameters(), 6);
  if (!one.channel.empty()) out << " channel " << one.channel;
  out << '\n';
  for (const auto& [check, verdict, finding] : lines_of(one)) {
    std::string line = "  " + padded(check, 12) + "  " + padded(verdict, 14) + "  " + finding;
    line.erase(line.find_last_not_of(' ') + 1);
    out << line << '\n';
  }
}

void print_rows(std::ostream& out, const std::vector<AuditCase>& cases, bool markdown) {
  std::vector<std::vector<std::string>> rows{{"model", "verdict", "largest", "error", "at", "passes 1 at"}};
  const AuditOptions& options = cases.front().options;
  const bool named = std::ranges::any_of(cases, [](const AuditCase& one) { return !one.name.empty(); });
  const bool coloured = std::ranges::any_of(cases, [](const AuditCase& one) { return !one.channel.empty(); });
  std::vector<std::string>& head = rows.front();
  if (named) head.insert(head.begin(), "material");
  if (coloured) head.emplace_back("channel");
  if (options.grazing) head.emplace_back("p");
  if (options.reciprocity) head.emplace_back("reciprocity");
  if (options.facets) head.insert(head.end(), {"distribution", "masking"});
  if (options.samplers) head.emplace_back("samplers");
  if (options.average) head.emplace_back("average");
  const auto word = [](Verdict verdict) {
    return verdict == Verdict::not_applicable ? "-" : std::string(to_string(verdict));
  };
  for (const AuditCase& one : cases) {
    const Audit& audit = one.audit;
    const EnergyAudit& energy = audit.energy;
    std::vector<std::string>& row = rows.emplace_back();
    if (named) row.push_back(one.name);
    row.insert(row.end(), {one.model->info().name, word(audit.verdict()), short_text(energy.largest.value),
                           number_text(energy.largest.error, 1), short_text(energy.theta_degrees),
                           energy.critical ? short_text(critical_degrees(energy)) : "-"});
    if (coloured) row.push_back(one.channel);
    if (options.grazing) {
      const bool found = audit.grazing->limit.status == Status::converged;
      row.push_back(found ? short_text(audit.grazing->limit.exponent) : "-");
    }
    if (options.reciprocity) row.push_back(word(audit.reciprocity.verdict));
    if (options.facets) row.insert(row.end(), {word(audit.distribution.verdict), word(audit.masking.verdict)});
    if (options.samplers) row.push_back(word(audit.sampler_verdict()));
    if (options.average) row.push_back(short_text(audit.average.albedo.value));
  }
  print(out, rows, markdown);
}

void print_summaries(std::ostream& out, const std::vector<AuditSummary>& summaries, bool markdown) {
  std::vector<std::vector<std::string>> rows{{"list", "model", "materials", "create energy", "unbounded",
                                              "largest finite", "of", "first passes 1 at", "of", "failed",
                                              "undecided"}};
  for (const AuditSummary& one : summaries) {
    const bool any = !one.earliest_name.empty(), has_finite = one.largest >= 0;
    rows.push_back({one.list, one.model, std::to_string(one.materials), std::to_string(one.creating_energy),
                    std::to_string(one.unbounded), has_finite ? short_text(one.largest) : "-",
                    has_finite ? one.largest_name : "-", any ? short_text(one.earliest_degrees) : "-",
                    any ? one.earliest_name : "-", std::to_string(one.failed), std::to_string(one.undecided)});
  }
  print(out, rows, markdown);
}

Json audit_json(const AuditCase& one) {
  const Audit& audit = one.audit;
  Json object = Json::object();
  if (!one.list.empty()) object["list"] = one.list;
  if (!one.name.empty()) object["name"] = one.name;
  if (!one.channel.empty()) object["channel"] = one.channel;
  object.update(model_json(*one.model, false));
  object["verdict"] = to_string(audit.verdict());
  object["energy"] = energy_json(audit.energy);
  object["bounded"] = {{"verdict", to_string(audit.energy.bounded)}};
  if (audit.grazing) {
    object["bounded"]["limit"] = law_json(audit.grazing->limit);
    object["bounded"]["fit"] = law_json(audit.grazing->fit);
    object["bounded"]["agree"] = audit.grazing->agree();
  }
  if (one.options.reciprocity) {
    object["reciprocity"] = {{"verdict", to_string(audit.reciprocity.verdict)},
                             {"asymmetry", audit.reciprocity.asymmetry},
                             {"l", direction_json(audit.reciprocity.l)},
                             {"v", direction_json(audit.reciprocity.v)},
                             {"pairs", audit.reciprocity.pairs}};
  }
  if (one.options.facets) {
    object["distribution"] = {{"verdict", to_string(audit.distribution.verdict)}};
    if (audit.distribution.verdict != Verdict::not_applicable) {
      object["distribution"]["integral_d_cos"] = estimate_json(audit.distribution.projected);
      object["distribution"]["integral_d"] = estimate_json(audit.distribution.solid_angle);
    }
    object["masking"] = {{"verdict", to_string(audit.masking.verdict)}};
    if (audit.masking.verdict != Verdict::not_applicable) {
      object["masking"]["farthest_from_1"] = estimate_json(audit.masking.furthest);
      object["masking"]["theta_deg"] = audit.masking.theta_degrees;
      object["masking"]["phi_deg"] = audit.masking.phi_degrees;
    }
  }
  if (one.options.samplers) {
    object["samplers"] = {{"verdict", to_string(audit.sampler_verdict())}, {"tests", Json::array()}};
    for (const SamplerAudit& sampler : audit.samplers) object["samplers"]["tests"].push_back(sampler_json(sampler));
  }
  if (one.options.average) object["average_albedo"] = estimate_json(audit.average.albedo);
  return object;
}

void write_csv(const Json& provenance, const std::vector<AuditCase>& cases, std::ostream& out) {
  write_provenance(provenance, out);
  out << "list,material,channel,model,parameters,verdict,largest,error,status,theta_deg,phi_deg,passes_1_theta_deg,"
         "passes_1_cos_theta,exponent,constant,asymmetry,average\n";
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const AuditCase& one : cases) {
    const Audit& audit = one.audit;
    const EnergyAudit& energy = audit.energy;
    out << csv_field(one.list) << ',' << csv_field(one.name) << ',' << one.channel << ',' << one.model->info().name
        << ',' << csv_field(parameters_text(one.model->parameters())) << ',' << to_string(audit.verdict()) << ','
        << number_text(energy.largest.value) << ',' << number_text(energy.largest.error) << ','
        << to_string(energy.largest.status) << ',' << number_text(energy.theta_degrees) << ','
        << number_text(energy.phi_degrees) << ',' << number_text(critical_degrees(energy)) << ','
        << number_text(energy.critical ? energy.critical->cos_theta : nan) << ','
        << number_text(audit.grazing ? audit.grazing->limit.exponent : nan) << ','
        << number_text(audit.grazing ? audit.grazing->limit.constant : nan) << ','
        << number_text(one.options.reciprocity ? audit.reciprocity.asymmetry : nan) << ','
        << number_text(one.options.average ? audit.average.albedo.value : nan) << '\n';
  }
}

}  // namespace albedo::analysis
