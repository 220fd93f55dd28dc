#include "plots/figures/sheet.hpp"

#include <cmath>
#include <sstream>
#include <variant>

#include "albedo/version.hpp"
#include "analysis/files/table_document.hpp"

namespace albedo::plots {

std::string number_text(double value) {
  std::string text;
  analysis::append_number(text, value);
  return text;
}

std::string short_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

Sheet::Sheet(std::string_view figure, std::string_view source) {
  note("version", "albedo " + std::string(version));
  note("command", "albedo-figures " + std::string(figure));
  note("source", source);
}

void Sheet::note(std::string_view key, std::string_view value) {
  text_.append("# ").append(key).append(": ").append(value).append("\n");
}

void Sheet::note(std::string_view key, double value) { note(key, std::string_view(number_text(value))); }

void Sheet::note(std::string_view key, std::size_t value) { note(key, std::string_view(std::to_string(value))); }

void Sheet::columns(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) text_.append(i == 0 ? "" : ",").append(names[i]);
  text_ += '\n';
}

void Sheet::row(const std::vector<double>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) analysis::append_number(i == 0 ? text_ : text_ += ',', numbers[i]);
  text_ += '\n';
}

void note_curves(Sheet& sheet, const analysis::AlbedoCurves& curves) {
  for (const auto& curve : curves.curves) {
    std::string material = curve.model;
    for (const auto& [parameter, value] : curve.parameters) {
      const auto* const name = std::get_if<std::string>(&value);
      material.append(" ").append(parameter).append("=").append(name != nullptr ? *name
                                                                                : number_text(std::get<double>(value)));
    }
    sheet.note("curve " + curve.label, material);
  }
  sheet.note("rule", "gauss");
  sheet.note("warp", "lobe");
  sheet.note("precision", "double");
  sheet.note("tolerance", curves.options.tolerance);
  sheet.note("largest relative error", curves.worst_relative_error());
  sheet.note("not converged", curves.unconverged());
  sheet.note("unit of theta_l", "degrees");
}

void add_curves(Sheet& sheet, const analysis::AlbedoCurves& curves) {
  std::vector<std::string> names{"theta_l", "cos_theta_l"};
  for (const auto& curve : curves.curves) {
    names.push_back(curve.label);
    names.push_back(curve.label + "_error");
  }
  sheet.columns(names);
  for (std::size_t row = 0; row < curves.directions.size(); ++row) {
    std::vector<double> numbers{curves.directions[row].theta_degrees(), curves.directions[row].cos_theta};
    for (const auto& estimates : curves.estimates) {
      numbers.push_back(estimates[row].value);
      numbers.push_back(estimates[row].error);
    }
    sheet.row(numbers);
  }
}

std::vector<Direction> directions_by_degrees(double step) {
  const int count = static_cast<int>(std::lround(90 / step));
  std::vector<Direction> directions;
  for (int i = 0; i <= count; ++i) directions.push_back(Direction::from_degrees(90.0 * i / count));
  return directions;
}

}  // namespace albedo::plots
