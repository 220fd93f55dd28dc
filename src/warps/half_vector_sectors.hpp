#pragma once

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "warps/half_vector_frame.hpp"

namespace albedo {

/// Where a ray is divided.
enum class HalfVectorEdge {
  origin,         // H = N
  equal_cosines,  // cosθ_V = cosθ_L: t = δ
  cavity_light,   // V-cavity, the light's side: t = π/2 − δ
  cavity_viewer,  // V-cavity, the viewer's side: t = π/6 + δ/3
  rim,            // the horizon, or where the lobe has ended
};

/// The edges along a ray, four at most, from H = N to the rim.
class HalfVectorEdges {
 public:
  HalfVectorEdges(std::initializer_list<HalfVectorEdge> edges) : size_(edges.size()) {
    std::ranges::copy(edges, edges_.begin());
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  HalfVectorEdge operator[](std::size_t i) const { return edges_[i]; }

 private:
  std::array<HalfVectorEdge, 4> edges_{};
  std::size_t size_;
};

/// Plans the panels: divides the turn where edges enter or leave the lobe, and calls add(arc, edges) for every part
/// whose rays have the same edges.
template <class S, class Add>
class HalfVectorSectors {
 public:
  HalfVectorSectors(const HalfVectorFrame<S>& frame, const Lobe& lobe, const Add& add) : frame_(frame), add_(add) {
    split(lobe);
  }

 private:
  static HalfVectorEdges whole_ray() { return {HalfVectorEdge::origin, HalfVectorEdge::rim}; }

  /// Divides the turn where edges enter or leave the lobe, and its rays at the edges.
  void split(const Lobe& lobe) {
    const S tangent = sqrt(square(frame_.l.x) + square(frame_.l.y)) / frame_.l.z;
    if (lobe.kink_v_cavity) {
      split_cavity(tangent);
    } else if (lobe.kink_equal_cosines && tangent > 0) {
      split_equal_cosines();
    } else if (frame_.symmetric && frame_.offset_sin != 0 && tangent > 0) {
      add({S(-1), S(1)}, whole_ray());  // the form's larger axis is across the plane of incidence, a quarter turn off
    } else {
      add_whole({S(0), S(2)}, whole_ray());
    }
  }

  /// The edge t = δ exists for δ > 0, from r = 0 at δ = 0 on; where it is beyond the lobe's end it is left out.
  void split_equal_cosines() {
    const HalfVectorEdges divided{HalfVectorEdge::origin, HalfVectorEdge::equal_cosines, HalfVectorEdge::rim};
    for (const int side : {1, -1}) {
      if (side < 0 && frame_.symmetric) break;
      const std::vector<S> borders = edge_borders(side);
      for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
        const S begin = side * borders[i], end = side * borders[i + 1];
        const bool inside = edge_margin((begin + end) / 2) > 0;
        add(side > 0 ? Arc<S>{begin, end} : Arc<S>{end, begin}, inside ? divided : whole_ray());
      }
    }
    add_whole({S(1), S(2)}, whole_ray());
  }

  /// 0, where |x| ≤ K has the edge t = δ enter or leave the lobe, and 1.
  [[nodiscard]] std::vector<S> edge_borders(int side) const {
    std::vector<S> borders{S(0)};
    if (frame_.alpha_x == frame_.alpha_y) {
      const S cosine = frame_.alpha_x * frame_.tau_of_radius(frame_.alpha_x * frame_.cut) / frame_.tan_alpha;
      if (cosine < 1) borders.push_back(frame_.turn.fraction(cosine));
    } else {
      static constexpr int steps = 24;
      S before = edge_margin(S(0));
      for (int i = 0; i < steps; ++i) {
        // closer together near ±K, where the edge is short
        const auto place = [](int k) { return S(1 - square(square(S(steps - k) / steps))); };
        const S after = edge_margin(side * place(i + 1));
        if ((before > 0) != (after > 0)) {
          std::uintmax_t most = 60;
          const auto border = boost::math::tools::toms748_solve([&](const S& f) { return edge_margin(side * f); },
                                                                place(i), place(i + 1), before, after,
                                                                boost::math::tools::eps_tolerance<S>(52), most);
          borders.push_back((border.first + border.second) / 2);
        }
        before = after;
      }
    }
    borders.push_back(S(1));
    return borders;
  }

  /// How far within the lobe the edge t = δ is at x = f K.
  [[nodiscard]] S edge_margin(const S& f) const {
    S cosine, sine, slope;
    frame_.turn.at(f, cosine, sine, slope);
    const S x = frame_.alpha_x * (cosine * frame_.axis_cos - sine * frame_.axis_sin),
            y = frame_.alpha_y * (cosine * frame_.axis_sin + sine * frame_.axis_cos);
    const S rho = sqrt(square(x) + square(y));
    return rho * frame_.tau_of_radius(rho * frame_.cut) - frame_.tan_alpha * cosine;
  }

  /// An isotropic lobe's sectors, from cosφ = 1 down.
  void split_cavity(const S& tangent) {
    using std::atan;
    using std::tan;
    S begin = 0;
    const auto down_to = [&](const S& cosine, const HalfVectorEdges& edges) {
      const S end = cosine <= -1 ? S(2) : cosine >= 1 ? S(0) : frame_.turn.fraction(cosine);
      if (!(end > begin)) return;
      add_whole({begin, end}, edges);
      begin = end;
    };
    const S reach = frame_.cut_tau;
    if (reach >= 1) {
      if (tangent > 1)
        down_to(1 / tangent, {HalfVectorEdge::origin, HalfVectorEdge::cavity_light, HalfVectorEdge::equal_cosines,
                              HalfVectorEdge::rim});
      down_to(S(-1), {HalfVectorEdge::origin, HalfVectorEdge::cavity_viewer, HalfVectorEdge::rim});
      return;
    }
    if (reach * tangent > 1)
      down_to(1 / (reach * tangent), {HalfVectorEdge::origin, HalfVectorEdge::cavity_light, HalfVectorEdge::rim});
    const S farthest =
        tan(S(3 * atan(reach) - boost::math::constants::half_pi<S>()));  // tanδ of the edge that meets the end
    const S enters = tangent > 0 ? S(farthest / tangent) : S(farthest > 0 ? 2 : -2);
    down_to(max(enters, S(-1)), whole_ray());
    down_to(S(-1), {HalfVectorEdge::origin, HalfVectorEdge::cavity_viewer, HalfVectorEdge::rim});
  }

  /// An arc of the half turn, on both sides of the plane of incidence unless they are the same.
  void add_whole(const Arc<S>& arc, const HalfVectorEdges& edges) {
    for (const Arc<S>& part : frame_.symmetric ? std::vector<Arc<S>>{arc} : whole_turn(arc)) add(part, edges);
  }
  void add(const Arc<S>& arc, const HalfVectorEdges& edges) const { add_(arc, edges); }

  const HalfVectorFrame<S>& frame_;
  const Add& add_;
};

}  // namespace albedo
