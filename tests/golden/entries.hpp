#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "albedo/core/parameter.hpp"

/// The files of expected values. README.md says how they were made.
namespace albedo {

inline nlohmann::json read(const std::string& file) {
  std::ifstream stream(std::string(ALBEDO_GOLDEN_DIR) + "/" + file);
  EXPECT_TRUE(stream) << file;
  return nlohmann::json::parse(stream);
}

inline Parameters parameters_of(const nlohmann::json& entry) {
  Parameters parameters;
  for (const auto& [name, value] : entry.at("parameters").items()) {
    if (value.is_string()) {
      parameters.emplace_back(name, value.get<std::string>());
    } else {
      parameters.emplace_back(name, value.get<double>());
    }
  }
  return parameters;
}

}  // namespace albedo
