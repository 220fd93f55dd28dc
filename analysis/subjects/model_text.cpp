#include "analysis/subjects/model_text.hpp"

#include "core/text.hpp"

namespace albedo::analysis {

std::string name_of(PumpControl control) { return std::string(to_string(control)); }

nlohmann::ordered_json model_json(const Model& model, bool several_channels) {
  Parameters parameters = model.parameters();
  if (several_channels) {
    std::erase_if(parameters, [&](const auto& parameter) {
      const ParameterInfo* info = model.info().find(parameter.first);
      return info != nullptr && info->is_choice() && info->per_channel;
    });
  }
  return {{"model", model.info().name}, {"parameters", parameters_json(parameters)}};
}

nlohmann::ordered_json corrections_json(const Corrections& corrections) {
  auto object = nlohmann::ordered_json::object();
  if (corrections.pump.times > 0) {
    object = {{"pump", corrections.pump.times},
              {"control", name_of(corrections.pump.control)},
              {"only_up", corrections.pump.only_up}};
  }
  if (corrections.correct != Correction::none) {
    object["correct"] = name_of(corrections.correct);
    object["rho"] = corrections.rho;
  }
  return object;
}

std::string parameters_text(const Parameters& parameters, int digits) {
  std::string text;
  for (const auto& [name, value] : parameters) {
    text.append(text.empty() ? "" : " ").append(name).append("=");
    text += std::holds_alternative<double>(value) ? number_text(std::get<double>(value), digits)
                                                  : std::get<std::string>(value);
  }
  return text;
}

nlohmann::ordered_json parameters_json(const Parameters& parameters) {
  auto object = nlohmann::ordered_json::object();
  for (const auto& [name, value] : parameters) {
    std::visit([&, &key = name](const auto& item) { object[key] = item; }, value);
  }
  return object;
}

}  // namespace albedo::analysis
