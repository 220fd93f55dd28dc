#include "analysis/scenes/plan/samples.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/scenes/plan/requirement.hpp"
#include "analysis/scenes/plan/white_part.hpp"

namespace albedo::analysis {

AlbedoOptions plan_albedo_options(const Model& model, double tolerance) {
  if (std::ranges::any_of(model.lobes(), &Lobe::is<HalfAnglesLobe>))
    return {.rule = Rule::cubature, .tolerance = tolerance / 10};
  return {.tolerance = tolerance / 1000};
}

std::size_t SampleStore::request(const std::shared_ptr<const Model>& model, double phi, bool needs_peaks) {
  const auto [found, is_new] = numbers_.try_emplace({key_of(*model), phi}, samples_.size());
  if (is_new) samples_.push_back({.model = model, .phi = phi});
  LobeSamples& samples = samples_[found->second];
  samples.needs_peaks = samples.needs_peaks || needs_peaks;
  return found->second;
}

void SampleStore::fill(const CosineGrid& grid, double tolerance, int threads, const ProgressCallback& progress) {
  in_parallel(
      samples_.size(), threads,
      [&](std::size_t number) {
        LobeSamples& samples = samples_[number];
        const AlbedoOptions options = plan_albedo_options(*samples.model, tolerance);
        for (const double cosine : grid.cosines()) {
          const Estimate a = directional_albedo(*samples.model, Direction::from_cosine(cosine, samples.phi), options);
          samples.albedos.push_back(a.value);
          const double allowed = tolerance / 10 * std::max(a.value, 0.01);
          if (!(a.value > 0) || !std::isfinite(a.value) || !(a.error <= allowed)) samples.is_good = false;
          if (samples.needs_peaks) samples.peaks.push_back(peak_radiance(*samples.model, cosine, samples.phi));
        }
      },
      progress);
}

}  // namespace albedo::analysis
