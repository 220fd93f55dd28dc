/// @file
/// The stability atlas: what every method answers from normal to grazing incidence and from needles to wide lobes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "albedo/directional_albedo.hpp"
#include "numerics/parallel.hpp"

namespace albedo::analysis {

/// The arithmetic of a formula, and what it is fed with.
enum class Form {
  float64,         ///< double, invariants
  float32,         ///< float, invariants rounded to float
  textbook_float,  ///< float, from directions rounded to float (textbook_form.hpp)
};
inline constexpr std::array all_forms{Form::float64, Form::float32, Form::textbook_float};

std::string_view name_of(Form form);

/// What an answer is worth.
enum class Verdict {
  right,              ///< within the tolerance, and says so
  right_unconverged,  ///< within the tolerance, but doesn't say so
  unconverged,        ///< outside, and doesn't say otherwise
  wrong,              ///< outside, and claims to have converged
  non_finite,         ///< NaN or infinity
  unknown,            ///< there is no reference to tell
};
inline constexpr std::array all_verdicts{Verdict::right, Verdict::right_unconverged, Verdict::unconverged,
                                         Verdict::wrong, Verdict::non_finite,        Verdict::unknown};

std::string_view name_of(Verdict verdict);

/// One row of maps: a model whose lobe becomes wider along an axis.
struct Surface {
  std::string model{};
  std::string parameter{};       ///< of the axis: a parameter, or a shorthand for two
  bool is_exponent = false;      ///< of a power lobe, from the widest down; otherwise a roughness
  double anisotropy = 1;         ///< the ratio of the shorthand's two parameters, as far as their range goes
  double phi_degrees = 0;        ///< of L
  bool has_samplers = false;     ///< for the paper warp
  std::vector<double> values{};  ///< of the parameter (the larger roughness, the smaller exponent)

  /// The model's parameters at a place on the axis.
  [[nodiscard]] Parameters parameters(double value) const;
};

struct AtlasMethod {
  Rule rule;
  Warp warp;
  Form form;
};

struct AtlasOptions {
  std::vector<std::string> models{"ward", "cook_torrance", "ggx", "phong", "ashikhmin_shirley"};
  std::vector<Rule> rules{};  ///< empty: all
  std::vector<Warp> warps{};  ///< empty: all
  std::vector<Form> forms{};  ///< empty: all
  bool isotropic = true;      ///< with a surface of equal widths of each model that can be anisotropic
  double anisotropy = 1000;   ///< of a second surface of each model that can be anisotropic; 1: none
  std::size_t incidences = 14, widths = 12;
  double tolerance = 1e-4;         ///< of deterministic rules
  double random_tolerance = 1e-2;  ///< of Monte Carlo rules
  std::int64_t budget = 200'000;   ///< for one answer
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as OpenMP would use
};

/// Standard errors that a Monte Carlo answer may be off before it counts as wrong.
inline constexpr double random_slack = 6;

struct Answer {
  Verdict verdict = Verdict::unknown;
  Estimate estimate{};
  double relative_error = 0;  ///< signed: below the reference is negative
};

struct Atlas {
  AtlasOptions options{};  ///< completed
  std::vector<Surface> surfaces{};
  std::vector<double> from_grazing{};  ///< 90° − θ, from 90° down to 1e-10°
  std::vector<AtlasMethod> methods{};
  std::vector<Estimate> references{};  ///< [surface][width][incidence]
  std::vector<Answer> answers{};       ///< [surface][width][incidence][method]

  [[nodiscard]] std::size_t cell(std::size_t surface, std::size_t width, std::size_t incidence) const;
  [[nodiscard]] const Answer& answer(std::size_t cell, std::size_t method) const {
    return answers[cell * methods.size() + method];
  }
  /// Whether a surface's model can be had on a method's warp.
  [[nodiscard]] bool applies(std::size_t surface, std::size_t method) const {
    return methods[method].warp != Warp::paper || surfaces[surface].has_samplers;
  }
};

/// The verdict on an answer.
Verdict judge(const Estimate& answer, const Estimate& reference, double tolerance);

/// Computes the atlas; its references are those of the gauss rule on the lobe warp in double precision at 1e-12. The
/// same for any number of threads.
/// @throws UnknownModel, ParameterError, also for a model without a roughness or an exponent
Atlas compute_atlas(const AtlasOptions& options, const ProgressCallback& progress = {});

}  // namespace albedo::analysis
