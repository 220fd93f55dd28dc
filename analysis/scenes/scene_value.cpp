#include "analysis/scenes/scene_value.hpp"

#include <algorithm>
#include <sstream>

namespace albedo::analysis {

SceneValue SceneValue::unknown() {
  SceneValue value;
  value.high = {1, 1, 1};
  value.is_known = false;
  return value;
}

double SceneValue::lowest() const { return std::ranges::min(low); }
double SceneValue::highest() const { return std::ranges::max(high); }

SceneValue SceneValue::mapped(const std::function<double(double)>& function) const {
  SceneValue result = *this;
  for (std::size_t i = 0; i < 3; ++i) {
    const double a = function(low[i]), b = function(high[i]);
    result.low[i] = std::min(a, b);
    result.high[i] = std::max(a, b);
  }
  return result;
}

SceneValue SceneValue::mean() const {
  SceneValue result = *this;
  const auto mean_of = [](const Rgb& v) { return v[0] == v[1] && v[1] == v[2] ? v[0] : (v[0] + v[1] + v[2]) / 3; };
  result.low.fill(mean_of(low));
  result.high.fill(mean_of(high));
  return result;
}

SceneValue hull(const SceneValue& a, const SceneValue& b) {
  SceneValue result = a;
  for (std::size_t i = 0; i < 3; ++i) {
    result.low[i] = std::min(a.low[i], b.low[i]);
    result.high[i] = std::max(a.high[i], b.high[i]);
  }
  result.is_known = a.is_known && b.is_known;
  return result;
}

SceneValue product(const SceneValue& a, const SceneValue& b) {
  SceneValue result = a;
  for (std::size_t i = 0; i < 3; ++i) {
    result.low[i] *= b.low[i];
    result.high[i] *= b.high[i];
  }
  result.is_known = a.is_known && b.is_known;
  return result;
}

MaterialParts::MaterialParts(std::string model) { material_.material.model = std::move(model); }

ParameterValue MaterialParts::checked(const std::string& name, const SceneValue& value, const Range& range) {
  const auto complain = [&](double number) {
    if (!problem_.empty()) return;
    std::ostringstream text;
    text << name << " = " << number << " is outside of [" << range.low << ", " << range.high << "]";
    problem_ = text.str();
  };
  if (!(value.lowest() >= range.low)) complain(value.lowest());
  if (!(value.highest() <= range.high)) complain(value.highest());
  if (!value.is_constant()) material_.intervals.push_back({name, value.lowest(), value.highest(), value.is_known});
  if (value.high[0] == value.high[1] && value.high[1] == value.high[2]) return value.high[0];
  return value.high;
}

MaterialParts& MaterialParts::set(const std::string& name, const SceneValue& value, const Range& range) {
  material_.material.parameters.emplace_back(name, checked(name, value, range));
  return *this;
}

MaterialParts& MaterialParts::choose(const std::string& name, const std::string& choice) {
  material_.material.parameters.emplace_back(name, choice);
  return *this;
}

MaterialParts& MaterialParts::set_scale(const SceneValue& value) {
  material_.material.scale = checked("scale", value, scale);
  return *this;
}

MaterialParts& MaterialParts::set_lambertian(const SceneValue& value) {
  material_.material.lambertian = checked("lambertian", value, reflectance);
  return *this;
}

}  // namespace albedo::analysis
