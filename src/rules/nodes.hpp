#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "core/integrand.hpp"

namespace albedo {

/// A one-dimensional rule on [0, 1] (gaussian: for r on [0, ∞)), and the matrix that turns values at its nodes into the
/// coefficients of their expansion: c_k = Σ_i transform[i * terms + k] w_i.
template <class S>
struct Nodes {
  std::vector<S> position;     // those of the rule that this one extends come first
  std::vector<S> weight;       // interval and turn: sums to 1
  int terms = 0;               // it integrates half of its degree of exactness
  std::vector<S> transform{};  // nodes × terms
};

/// The largest order of an axis, extensions included.
constexpr int most_nodes(AxisKind kind) {
  switch (kind) {
    case AxisKind::interval:
      return 128;
    case AxisKind::gaussian:
      return 16;  // more would leave gaussian_reach
    default:
      return 512;
  }
}

/// Makes the rule that nodes_of() keeps; rules/make_nodes.hpp has it.
template <class S>
Nodes<S> make_nodes(AxisKind kind, int n, int extensions);
extern template Nodes<double> make_nodes(AxisKind, int, int);

/// The rule of n nodes for an axis of that kind, made when first asked for; n ≤ most_nodes(kind).
///
/// An extension joins new nodes to those it had: a turn's double, as often as most_nodes allows, and Gauss's n get
/// Kronrod's n + 1 (once).
template <class S>
const Nodes<S>& nodes_of(AxisKind kind, int n, int extensions = 0) {
  struct Slot {
    std::once_flag once;
    std::unique_ptr<const Nodes<S>> nodes;
    std::atomic<const Nodes<S>*> made = nullptr;  // looking here is all that most calls do
  };
  constexpr std::size_t orders = most_nodes(AxisKind::periodic) + 1, levels = 8;
  static std::array<std::array<std::array<Slot, levels>, orders>, 4> slots;
  Slot& slot = slots[static_cast<std::size_t>(kind)][static_cast<std::size_t>(n)][static_cast<std::size_t>(extensions)];
  if (const Nodes<S>* made = slot.made.load(std::memory_order_acquire)) return *made;
  std::call_once(slot.once, [&] {
    slot.nodes = std::make_unique<const Nodes<S>>(make_nodes<S>(kind, n, extensions));
    slot.made.store(slot.nodes.get(), std::memory_order_release);
  });
  return *slot.nodes;
}

}  // namespace albedo
