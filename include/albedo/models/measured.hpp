#pragma once

#include <memory>
#include <string>

#include "albedo/core/parameter.hpp"

namespace albedo {

/// One colour channel of a measured isotropic material.
class MeasuredTable {
 public:
  virtual ~MeasuredTable() = default;

  /// f(L,V) [1/sr], 0 for V not above the horizon.
  [[nodiscard]] virtual double evaluate(const DirectionPair<double>& pair) const noexcept = 0;
  [[nodiscard]] virtual bool reciprocal() const noexcept = 0;

 protected:
  MeasuredTable() = default;
  MeasuredTable(const MeasuredTable&) = default;
  MeasuredTable& operator=(const MeasuredTable&) = default;
};

/// Reads a channel (0, 1, 2) of a file in one of the formats of Measured, told by its content.
/// @param negative_as_zero table entries below 0 are read as 0 (in a MERL file they always are)
/// @throws FormatError naming the file. Nothing is allocated that is larger than the file.
std::shared_ptr<const MeasuredTable> read_measured(const std::string& path, int channel, bool negative_as_zero);

/// A measured isotropic material, interpolated between the entries of its table.
///
///  - RGL `.bsdf`, RGB [Dupuy & Jakob 2018]: f cosθ_V = rgb(s) ndf(u_m)/(4 sigma(u_i)), u(θ) = √(2θ/π),
///    u(φ) = (φ + π)/2π, s the point that the sampling of vndf(· | θ_i) maps to u_m; bilinear, and linear in θ_i.
///  - MERL `.binary` [Matusik et al. 2003]: entries over (√θ_h, θ_d, φ_d), here those of the centres of the cells and
///    linear in all three between.
///
/// The table is a table of doubles whatever the number type asks. It isn't smooth: the formula has kinks along
/// the table's lines, which rules are told of.
struct Measured {
  enum class Channel { r, g, b };
  enum class Negative { kept, zero };

  std::string file{};
  Channel channel = Channel::r;
  Negative negative = Negative::kept;
  std::shared_ptr<const MeasuredTable> table{};  ///< set by load()

  static ModelInfo info() {
    return {
        .name = "measured",
        .title = "Measured isotropic material (RGL .bsdf, MERL .binary)",
        .source = "Dupuy & Jakob 2018 (RGL); Matusik et al. 2003 (MERL)",
        .deviation =
            "RGL's own reader takes negative entries as 0 (negative=zero); MERL's takes the nearest entry, here it is "
            "interpolated"};
  }
  static std::vector<Parameter<Measured>> parameters() {
    using M = Measured;
    Parameter<M> colour = choice<M, &M::channel>("channel", {"R", "G", "B"}, "colour channel");
    colour.info.per_channel = true;
    return {text<M, &M::file>("file", "path of the file"), std::move(colour),
            choice<M, &M::negative>("negative", {"kept", "zero"}, "what entries below 0 are read as")};
  }

  /// @throws FormatError, ParameterError if there is no file's name
  void load();

  [[nodiscard]] Claims claims() const {
    return {.reciprocal = table && table->reciprocal(), .conserves_energy = false};
  }
  [[nodiscard]] std::vector<Lobe> lobes() const { return {{.shape = HalfAnglesLobe{}}}; }

  template <class T>
  T evaluate(int /*component*/, const DirectionPair<T>& d) const noexcept {
    if constexpr (std::is_same_v<T, Block>) {
      return Block::generate(
          [&](int lane) { return table->evaluate(in_double(d, [lane](const Block& b) { return b[lane]; })); });
    } else {
      return static_cast<T>(table->evaluate(in_double(d, [](const T& x) { return static_cast<double>(x); })));
    }
  }

 private:
  template <class T, class Rounding>
  static DirectionPair<double> in_double(const DirectionPair<T>& d, const Rounding& r) {
    return {r(d.cos_theta_l), r(d.cos_theta_v), r(d.l_x),     r(d.l_y),     r(d.v_x),     r(d.v_y),
            r(d.cos_theta_d), r(d.cos_theta_h), r(d.slope_x), r(d.slope_y), r(d.axis_gap)};
  }
};

}  // namespace albedo
