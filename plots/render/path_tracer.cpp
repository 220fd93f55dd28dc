#include "plots/render/path_tracer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "albedo/core/errors.hpp"
#include "rules/random.hpp"

namespace albedo::render {
namespace {

constexpr std::uint32_t render_stream = 0xFFFFFFFE;  // of Philox's counters; random.hpp has the others
constexpr std::uint32_t first_roulette = 4;          // bounces before it
constexpr double most_survival = 0.95;

double sum(const Spectrum& spectrum) {
  double result = 0;
  for (int i = 0; i < block_width; ++i) result += spectrum[i];
  return result;
}

double largest(const Spectrum& spectrum) {
  double result = spectrum[0];
  for (int i = 1; i < block_width; ++i) result = std::max(result, spectrum[i]);
  return result;
}

/// The random numbers of one sample of one pixel: a pair for each purpose.
class Numbers {
 public:
  Numbers(const RandomStream& stream, std::uint32_t pixel, std::uint32_t sample)
      : stream_(stream), pixel_(pixel), sample_(sample) {}

  [[nodiscard]] std::array<double, 2> in_pixel() const { return pair(0); }
  [[nodiscard]] std::array<double, 2> direction(std::uint32_t bounce) const { return pair(2 * bounce + 1); }
  /// Which lobe, and whether to go on.
  [[nodiscard]] std::array<double, 2> choices(std::uint32_t bounce) const { return pair(2 * bounce + 2); }

 private:
  [[nodiscard]] std::array<double, 2> pair(std::uint32_t purpose) const {
    return stream_.uniform_pair({{pixel_, sample_, purpose, render_stream}});
  }

  const RandomStream& stream_;
  std::uint32_t pixel_, sample_;
};

Spectrum trace(const Scene& scene, Ray ray, const Numbers& numbers) {
  Spectrum throughput(1);
  std::size_t leaving = Scene::none;
  for (std::uint32_t number = 0;; ++number) {
    const auto hit = scene.closest(ray, leaving);
    if (!hit) return throughput * scene.environment;
    const Material& material = scene.materials[hit->material];
    if (material.emission) return throughput * *material.emission;
    if (material.lobes.empty()) return Spectrum(0);

    const auto [choice, survival] = numbers.choices(number);
    const auto count = static_cast<double>(material.lobes.size());
    const SurfaceLobe& lobe = material.lobes[static_cast<std::size_t>(choice * count)];
    const auto [u, v] = numbers.direction(number);
    const auto next = bounce(lobe, hit->frame.local(-ray.direction), u, v);
    if (!next) return Spectrum(0);
    throughput *= next->weight * count;
    if (hit->odd) throughput *= material.odd;
    if (number >= first_roulette) {
      const double probability = std::min(most_survival, largest(throughput));
      if (survival >= probability) return Spectrum(0);
      throughput /= probability;
    }
    ray = {hit->point, hit->frame.world(next->direction)};
    leaving = hit->primitive;
  }
}

/// Mean of spectra, and the variance of their luminances   [Welford 1962].
class Moments {
 public:
  void add(const Spectrum& value, double luminance) {
    ++count_;
    sum_ += value;
    const double before = luminance - mean_;
    mean_ += before / count_;
    squares_ += before * (luminance - mean_);
  }
  [[nodiscard]] Spectrum mean() const { return sum_ / Spectrum(count_); }
  [[nodiscard]] double standard_error() const { return std::sqrt(squares_ / (count_ * (count_ - 1))); }

 private:
  Spectrum sum_{0};
  double count_ = 0, mean_ = 0, squares_ = 0;
};

/// The pair of L and a V that no sampler made.
DirectionPair<double> plain_pair(const UnitVector<double>& l, const UnitVector<double>& v) {
  return direction_pair(l, v, {-l.x, -l.y, l.z});
}

}  // namespace

double Rendering::mean_luminance() const {
  double total = 0;
  for (const double value : luminance) total += value;
  return total / static_cast<double>(luminance.size());
}

double Rendering::mean_error() const {
  double total = 0;
  for (const double value : error) total += value;
  return total / static_cast<double>(error.size());
}

double Rendering::largest_error() const { return *std::ranges::max_element(error); }

std::optional<Bounce> bounce(const SurfaceLobe& lobe, const UnitVector<double>& l, double u, double v) {
  if (lobe.sampling == Sampling::uniform) {
    const double sine = std::sqrt((1 - u) * (1 + u)), phi = 2 * pi<double> * v;
    const UnitVector<double> viewer{sine * std::cos(phi), sine * std::sin(phi), u};
    const DirectionPair<double> pair = plain_pair(l, viewer);
    const double weight = 2 * pi<double> * lobe.model->evaluate(lobe.component, pair) * viewer.z;
    return Bounce{viewer, lobe.reflectance(pair.cos_theta_d) * weight};
  }
  const Sampled<double> drawn = lobe.model->sample(lobe.component, l, u, v);
  const DirectionPair<double>& pair = drawn.pair;
  if (pair.cos_theta_v <= 0) return {};
  const double weight = lobe.sampling == Sampling::equal_weights
                            ? lobe.equal_weight
                            : lobe.model->evaluate(lobe.component, pair) * pair.cos_theta_v / drawn.density;
  return Bounce{drawn.viewer(), lobe.reflectance(pair.cos_theta_d) * weight};
}

Rendering render(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                 const ProgressCallback& progress) {
  if (settings.samples < 2 || settings.width == 0 || settings.height == 0) {
    throw ParameterError("picture: samples is " + std::to_string(settings.samples) + ", width " +
                         std::to_string(settings.width) + ", height " + std::to_string(settings.height) +
                         "; there must be 2 samples and a pixel at least");
  }
  const std::size_t pixels = settings.width * settings.height;
  Rendering result{.width = settings.width,
                   .height = settings.height,
                   .samples = settings.samples,
                   .weights = settings.luminance,
                   .mean = std::vector<Spectrum>(pixels),
                   .luminance = std::vector<double>(pixels),
                   .error = std::vector<double>(pixels)};
  const RandomStream stream(settings.seed);
  const auto row = [&](std::size_t y) {
    for (std::size_t x = 0; x < settings.width; ++x) {
      const std::size_t pixel = y * settings.width + x;
      Moments moments;
      for (std::uint32_t sample = 0; sample < settings.samples; ++sample) {
        const Numbers numbers(stream, static_cast<std::uint32_t>(pixel), sample);
        const auto [dx, dy] = settings.centred ? std::array<double, 2>{0.5, 0.5} : numbers.in_pixel();
        const Ray ray = camera.ray(2 * (static_cast<double>(x) + dx) / static_cast<double>(settings.width) - 1,
                                   1 - 2 * (static_cast<double>(y) + dy) / static_cast<double>(settings.height));
        const Spectrum radiance = trace(scene, ray, numbers);
        moments.add(radiance, sum(radiance * settings.luminance));
      }
      result.mean[pixel] = moments.mean();
      result.luminance[pixel] = sum(result.mean[pixel] * settings.luminance);
      result.error[pixel] = moments.standard_error();
    }
  };
  in_parallel(settings.height, settings.threads, row, progress);
  return result;
}

}  // namespace albedo::render
