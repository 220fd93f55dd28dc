#include <algorithm>
#include <cmath>

#include "albedo/core/quad.hpp"
#include "audit/parts.hpp"
#include "audit/sample_lobe.hpp"
#include "rules/random.hpp"

namespace albedo {
namespace {

Direction direction_of(const UnitVector<double>& v) {
  const double sine = std::hypot(v.x, v.y);
  if (sine == 0) return {};
  return {v.z, sine, v.x / sine, v.y / sine};
}

template <class T>
T asymmetry(const Model& model, const Direction& l, const Direction& v) {
  using std::abs;
  const T there = brdf<T>(model, l, v), back = brdf<T>(model, v, l);
  if (there == back) return 0;
  const T size_there = abs(there), size_back = abs(back);
  return T(abs(T(there - back))) / (size_there > size_back ? size_there : size_back);
}

/// A V for L: anywhere, or where one of the lobes is.
UnitVector<double> viewer(const std::vector<Lobe>& lobes, const UnitVector<double>& l, std::uint32_t i, double u,
                          double v) {
  const Lobe& lobe = lobes[i / 2 % lobes.size()];
  return (i % 2 == 1 ? sample_lobe(lobe, l, u, v) : sample_cosine(l, u, v)).viewer();
}

}  // namespace

ReciprocityAudit audit_reciprocity(const Model& model) {
  constexpr std::uint32_t pairs = 4096;
  constexpr std::size_t looked_at_again = 32;
  constexpr double same = 1e-9;
  const RandomStream stream(1);
  const std::vector<Lobe> lobes = model.lobes();
  struct Found {
    double asymmetry;
    Direction l, v;
  };
  std::vector<Found> found;
  for (std::uint32_t i = 0; i < pairs && !lobes.empty(); ++i) {
    const auto [a, b] = stream.uniform_pair({{i, 0, 0, 0}});
    const auto [u, v] = stream.uniform_pair({{i, 1, 0, 0}});
    const double cosine = i % 4 < 2 ? a : a * a * a;  // towards grazing incidence, too
    const Direction l = Direction::from_cosine(cosine, 360 * b);
    const UnitVector<double> to = viewer(lobes, unit_vector<double>(l), i, u, v);
    if (!(to.z > 0)) continue;
    const Direction back = direction_of(to);
    found.push_back({asymmetry<double>(model, l, back), l, back});
  }
  ReciprocityAudit audit{.pairs = static_cast<int>(found.size())};
  // in double, H of nearly opposite directions has lost digits: those that look worst are looked at again
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    if (std::isnan(a.asymmetry) || std::isnan(b.asymmetry)) return std::isnan(a.asymmetry) > std::isnan(b.asymmetry);
    return a.asymmetry > b.asymmetry;
  });
  if (found.size() > looked_at_again) found.resize(looked_at_again);
  for (const auto& [rough, l, v] : found) {
    const double exact = static_cast<double>(asymmetry<Quad>(model, l, v));
    if (exact <= audit.asymmetry || std::isnan(audit.asymmetry)) continue;
    audit.asymmetry = exact, audit.l = l, audit.v = v;
  }
  audit.verdict = !model.claims().reciprocal ? Verdict::not_claimed
                  : audit.asymmetry <= same  ? Verdict::pass
                                             : Verdict::fails;
  return audit;
}

}  // namespace albedo
