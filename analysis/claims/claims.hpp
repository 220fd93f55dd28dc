/// @file
/// What four papers claim of reflectance models, and whether it is so. No verdict is written down: each is computed
/// from the models, with the library's public interface.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "albedo/core/model.hpp"
#include "numerics/parallel.hpp"

namespace albedo::analysis {

enum class Paper {
  neumann,    ///< Neumann, Neumann, Szirmay-Kalos 1999, Compact metallic reflectance models (albedo pumping-up)
  ashikhmin,  ///< Ashikhmin, Shirley 2000, An anisotropic Phong BRDF model
  walter,     ///< Walter 2005, Notes on the Ward BRDF
  kurt,       ///< Kurt, Szirmay-Kalos, Krivanek 2010, An anisotropic BRDF model for fitting and Monte Carlo rendering
};

inline constexpr std::array all_papers{Paper::neumann, Paper::ashikhmin, Paper::walter, Paper::kurt};

/// As on the command line.
std::string name_of(Paper paper);
/// Authors and year.
std::string title_of(Paper paper);

enum class ClaimVerdict {
  holds,
  holds_if,   ///< under the condition that the finding names
  fails,      ///< the finding has the worst case, and the smallest change that repairs it
  undecided,  ///< some number missed its tolerance
};

std::string_view to_string(ClaimVerdict verdict);

struct Quantity {
  std::string name;
  double value = 0, error = 0;
};

/// What the computation says of a claim; text is ASCII.
struct Finding {
  ClaimVerdict verdict = ClaimVerdict::undecided;
  std::string found{};      ///< the numbers that decide
  std::string condition{};  ///< of holds_if
  std::string worst{};      ///< case, if one is worse than others
  std::string repair{};     ///< the smallest change that makes it hold, if it fails somewhere
  std::vector<Quantity> quantities{};
};

/// Where a check has its models from: the library, or one that changes them to see the verdict change.
using ModelSource = std::function<std::unique_ptr<Model>(std::string_view name, const Parameters& parameters)>;

/// make_model
std::unique_ptr<Model> library_model(std::string_view name, const Parameters& parameters);

struct Claim {
  std::string id;  ///< N1, A3, ...
  Paper paper;
  std::string where;  ///< in the paper
  std::string statement;
  Finding (*check)(const ModelSource& make);
};

std::vector<Claim> neumann_claims();
std::vector<Claim> ashikhmin_claims();
std::vector<Claim> walter_claims();
std::vector<Claim> kurt_claims();

/// Those of the given papers, in the order of all_papers; of all, if none is given.
std::vector<Claim> claims_of(const std::vector<Paper>& papers);

/// Checks all claims, with the same bits for any number of threads.
std::vector<Finding> check_claims(const std::vector<Claim>& claims, int threads,
                                  const ModelSource& make = library_model, const ProgressCallback& progress = {});

}  // namespace albedo::analysis
