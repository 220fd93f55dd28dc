#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "core/integrand.hpp"
#include "rules/resolution.hpp"

namespace albedo {

/// A ray of a cell's grid that stands for its neighbours when the rule along them is checked.
template <class S>
struct Probe {
  S position;  // v, in the cell
  S sum;       // by the rule
  S known;     // what the rule's own nodes have in the sum of the one that checks it
  S factor;    // what an error of this ray amounts to in the cell
};

/// A rectangle of a panel, integrated by a product rule. What is known of the two rules' errors is infinite until it
/// has been measured.
template <class S>
struct Cell {
  int panel;
  Axis u, v;
  S begin_u{0}, begin_v{0}, width_u{1}, width_v{1};
  int extensions = 0;     // of the rule along v
  std::vector<S> rows{};  // the rule along u at each node of v
  S value{}, magnitude{};
  S doubt{};  // mean of the rays'
  Resolution<S> along_u{}, along_v{};
  std::array<Probe<S>, 5> probes{};
  std::size_t probe_count = 0;
  S error_u = std::numeric_limits<S>::infinity(), error_v = std::numeric_limits<S>::infinity();
  bool hides_feature = false;
  bool divide_u = false;
  bool turning = false;
  bool rough = false;  // bisected since raising the order didn't help, or layered

  [[nodiscard]] S error() const { return error_u + error_v; }
};

/// An integration's memory: asking for it anew would take as long as a small integration.
template <class S>
struct Workspace {
  std::vector<S> positions_u, positions_v, places, values, columns, doubt, scratch;
  std::vector<Cell<S>> cells;
};

/// The thread's workspace; an integration within another's integrand gets one of its own.
template <class S>
class Lease {
 public:
  Lease() : work_(std::move(spare())) { work_.cells.clear(); }
  ~Lease() { spare() = std::move(work_); }
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;

  Workspace<S>* operator->() { return &work_; }
  const Workspace<S>* operator->() const { return &work_; }

 private:
  static Workspace<S>& spare() {
    thread_local Workspace<S> workspace;
    return workspace;
  }

  Workspace<S> work_;
};

}  // namespace albedo
