#include "core/text.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace albedo {

std::string number_text(double value, int digits) {
  if (std::isnan(value)) return "nan";  // without the sign that some have
  return fmt::format("{:.{}g}", value, digits);
}

std::string shortest_text(double value) {
  std::array<char, 32> buffer{};  // {fmt} has the same digits, but not the choice between 1e+06 and 1000000
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

std::string joined(const std::vector<std::string>& items, const std::string& separator) {
  return fmt::format("{}", fmt::join(items, separator));
}

}  // namespace albedo
