#include "analysis/claims/claims.hpp"

#include <algorithm>

namespace albedo::analysis {

std::string name_of(Paper paper) {
  switch (paper) {
    case Paper::neumann:
      return "neumann";
    case Paper::ashikhmin:
      return "ashikhmin";
    case Paper::walter:
      return "walter";
    case Paper::kurt:
      break;
  }
  return "kurt";
}

std::string title_of(Paper paper) {
  switch (paper) {
    case Paper::neumann:
      return "Neumann, Neumann, Szirmay-Kalos 1999";
    case Paper::ashikhmin:
      return "Ashikhmin, Shirley 2000";
    case Paper::walter:
      return "Walter 2005";
    case Paper::kurt:
      break;
  }
  return "Kurt, Szirmay-Kalos, Krivanek 2010";
}

std::string_view to_string(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::holds:
      return "holds";
    case ClaimVerdict::holds_if:
      return "holds if";
    case ClaimVerdict::fails:
      return "fails";
    case ClaimVerdict::undecided:
      break;
  }
  return "undecided";
}

std::unique_ptr<Model> library_model(std::string_view name, const Parameters& parameters) {
  return make_model(name, parameters);
}

std::vector<Claim> claims_of(const std::vector<Paper>& papers) {
  std::vector<Claim> all;
  for (const auto& part : {neumann_claims(), ashikhmin_claims(), walter_claims(), kurt_claims()}) {
    if (papers.empty() || std::ranges::find(papers, part.front().paper) != papers.end()) {
      all.insert(all.end(), part.begin(), part.end());
    }
  }
  return all;
}

std::vector<Finding> check_claims(const std::vector<Claim>& claims, int threads, const ModelSource& make,
                                  const ProgressCallback& progress) {
  std::vector<Finding> findings(claims.size());
  in_parallel(
      claims.size(), threads, [&](std::size_t i) { findings[i] = claims[i].check(make); }, progress);
  return findings;
}

}  // namespace albedo::analysis
