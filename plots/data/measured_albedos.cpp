#include "plots/data/measured_albedos.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "albedo/core/model.hpp"
#include "numerics/parallel.hpp"

namespace albedo::analysis {

namespace fs = std::filesystem;

std::vector<std::string> measured_files(const std::string& directory) {
  std::vector<std::string> files;
  std::error_code failure;
  for (fs::directory_iterator entry(directory, failure), end; !failure && entry != end; entry.increment(failure)) {
    const fs::path ending = entry->path().extension();
    if (ending == ".bsdf" || ending == ".binary") files.push_back(entry->path().string());
  }
  std::ranges::sort(files);
  return files;
}

std::size_t MeasuredAlbedos::unconverged() const {
  std::size_t count = 0;
  for (const auto& material : estimates) {
    for (const auto& channels : material) {
      count += static_cast<std::size_t>(
          std::ranges::count_if(channels, [](const Estimate& e) { return e.status != Status::converged; }));
    }
  }
  return count;
}

double MeasuredAlbedos::worst_relative_error() const {
  double worst = 0;
  for (const auto& material : estimates) {
    for (const auto& channels : material) {
      for (const Estimate& e : channels) {
        if (e.value != 0) worst = std::max(worst, e.error / std::abs(e.value));
      }
    }
  }
  return worst;
}

MeasuredAlbedos measured_albedos(const std::vector<std::string>& files, std::vector<double> thetas,
                                 const AlbedoOptions& options) {
  MeasuredAlbedos result{.thetas = std::move(thetas), .options = options};
  std::vector<std::array<std::unique_ptr<Model>, 3>> models;
  for (const std::string& file : files) {
    result.names.push_back(fs::path(file).stem().string());
    auto& channels = models.emplace_back();
    const std::array<const char*, 3> names{"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c) channels[c] = make_model("measured", {{"file", file}, {"channel", names[c]}});
  }
  const std::size_t count = result.thetas.size();
  result.estimates.assign(files.size(), std::vector<std::array<Estimate, 3>>(count));
  in_parallel(files.size() * count * 3, 0, [&](std::size_t i) {
    const std::size_t material = i / (3 * count), theta = i / 3 % count, channel = i % 3;
    result.estimates[material][theta][channel] =
        directional_albedo(*models[material][channel], Direction::from_degrees(result.thetas[theta]), options);
  });
  return result;
}

}  // namespace albedo::analysis
