/// @file
/// What is done to a model's energy before it is looked at.
#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "albedo/core/model.hpp"
#include "albedo/pumping.hpp"

namespace albedo {

/// An energy correction beside pumping.
enum class Correction {
  none,
  balance,       ///< f / (s(L) s(V)): the albedo is ρ
  multiscatter,  ///< Kulla & Conty's complement, ρ (1 − a(L))(1 − a(V)) / (π (1 − ā)), added: a + ρ (1 − a)
  turquin,       ///< Turquin's scaling with L: a + ρ (1 − a)
};

inline constexpr std::array all_corrections{Correction::none, Correction::balance, Correction::multiscatter,
                                            Correction::turquin};

std::string_view name_of(Correction correction);

/// Pumping, and what comes after it.
struct Corrections {
  PumpOptions pump{.times = 0};
  Correction correct = Correction::none;
  double rho = 1;

  [[nodiscard]] bool any() const { return pump.times > 0 || correct != Correction::none; }
  /// @throws ParameterError for a model that can't be corrected so
  [[nodiscard]] std::unique_ptr<Model> applied_to(std::unique_ptr<Model> model) const;
};

}  // namespace albedo
