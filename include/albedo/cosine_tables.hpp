#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "albedo/core/block.hpp"

namespace albedo {

/// Positive functions y_0, y_1, … of a polar angle: ln y over x = −ln cosθ, as piecewise Chebyshev expansions in √x of
/// one degree on panels that all of them share. √x is to normal incidence what θ is, whose odd powers pumping makes.
class CosineTables {
 public:
  static constexpr int terms = 11;        ///< of an expansion
  static constexpr double last_x = 138;   ///< cosθ ~ 1e-60; the tables end there, and what is beyond is as there
  using Expansion = std::vector<double>;  ///< count() × terms, of one panel
  /// Where in [−1, 1] the error of an expansion swings out: ±sin(10 t) = ±1, one on either side.
  static constexpr std::array test_places{-0.45399049973954675, 0.7071067811865476};
  static constexpr double unmeasured = 2.1;  ///< what AlbedoCurve allows for swings between such places, too

  /// On panels that suit an albedo; split() makes others.
  CosineTables();

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const std::vector<double>& edges() const { return edges_; }
  [[nodiscard]] std::size_t panels() const { return expansions_.size(); }

  /// ln y_k
  [[nodiscard]] double log(int k, double x) const;
  [[nodiscard]] Block log(int k, const Block& x) const;
  /// The same of all functions, in `values`.
  void logs(double x, double* values) const;
  /// The panel that holds x and the Chebyshev polynomials at x's place in it; returns its expansions.
  const double* expansions_at(double x, double* polynomials) const;

  /// Joins another function: its expansion on each panel, terms numbers one after the other.
  void add(const std::vector<double>& expansions);
  /// Replaces the last function.
  void replace_last(const std::vector<double>& expansions);
  /// Adds to the last function's ln y.
  void raise_last(double by);
  /// Divides a panel at x; the functions stay what they are.
  void split(std::size_t panel, double x);

  /// The i-th of the points between two x through which an expansion goes; the ends are among them, exactly.
  static double node(double begin, double end, int i);
  /// The x at a place t within [−1, 1] of a panel.
  static double place(double begin, double end, double t);
  /// The expansion through values at the nodes.
  static std::array<double, terms> expansion(const std::array<double, terms>& values);
  static double sum(const std::array<double, terms>& expansion, double t);

 private:
  [[nodiscard]] std::size_t panel_of(double x) const;

  std::vector<double> edges_;
  std::vector<Expansion> expansions_;
  int count_ = 0;
};

}  // namespace albedo
