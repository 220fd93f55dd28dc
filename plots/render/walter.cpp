#include "plots/render/walter.hpp"

#include <algorithm>
#include <cmath>

#include "albedo/models/ward.hpp"
#include "albedo/registry.hpp"
#include "analysis/claims/variants.hpp"
#include "plots/render/furnace.hpp"

namespace albedo::render {
namespace {

using analysis::EqualWeights;  // what Walter's eq. 9 stands for

std::shared_ptr<const Model> ward(double alpha) {
  return make_model("ward", {{"alpha", alpha}, {"rho_s", walter_rho_s}});
}

std::vector<SurfaceLobe> ward_lobes(Sampling sampling, double alpha) {
  std::vector<SurfaceLobe> lobes = lobes_of(ward(alpha), constant(Spectrum(1)));
  lobes.front().sampling = sampling;
  lobes.front().equal_weight = walter_rho_s;
  return lobes;
}

Scene furnace_scene(Sampling sampling, double alpha) { return furnace(ward_lobes(sampling, alpha)); }

/// Three units deep, two wide and high; the sphere stands on the floor.
Scene box_scene(Sampling sampling, double alpha) {
  Scene scene;
  const std::shared_ptr<const Model> lambert = make_model("lambert", {{"rho", 1.0}});
  const auto wall = [&](double r, double g, double b) {
    return scene.add({.lobes = lobes_of(lambert, constant(rgb(r, g, b)))});
  };
  const std::size_t grey = wall(0.7, 0.7, 0.7), orange = wall(0.7, 0.35, 0.12), blue = wall(0.12, 0.35, 0.7);
  const std::size_t light = scene.add({.emission = Spectrum(3)});
  const std::size_t sphere = scene.add({.lobes = ward_lobes(sampling, alpha)});
  const Vector x(2, 0, 0), y(0, 3, 0), z(0, 0, 2), low(-1, -2, -1);
  scene.facets = {{low, x, y, grey},
                  {low + z, x, y, grey},
                  {low, x, z, grey},
                  {low + y, x, z, grey},
                  {low, y, z, orange},
                  {low + x, y, z, blue},
                  {Vector(-0.6, -0.9, 0.999), Vector(1.2, 0, 0), Vector(0, 1.2, 0), light}};
  scene.spheres = {{Vector(0, 0.05, -0.38), 0.62, sphere}};
  return scene;
}

/// The cosine of the angle of view where a ray hits a sphere; 0 where it doesn't.
double sphere_cosine(const Scene& scene, const Ray& ray) {
  const auto hit = scene.closest(ray);
  return hit && hit->primitive < scene.spheres.size() ? -hit->frame.z.dot(ray.direction) : 0;
}

/// The mean over the sphere of a pixel's number and its error.
template <class Value, class Error>
Mean mean_over(const std::vector<double>& cosine, const Value& value, const Error& error) {
  double sum = 0, squares = 0, count = 0;
  for (std::size_t i = 0; i < cosine.size(); ++i) {
    if (cosine[i] == 0) continue;
    sum += value(i);
    squares += square(error(i));
    ++count;
  }
  return {sum / count, std::sqrt(squares) / count};
}

Mean difference(const std::vector<double>& cosine, const Rendering& a, const Rendering& b) {
  return mean_over(
      cosine, [&](std::size_t i) { return a.luminance[i] - b.luminance[i]; },
      [&](std::size_t i) { return std::hypot(a.error[i], b.error[i]); });
}

}  // namespace

WardView ward_in_box() {
  return {box_scene, Camera::perspective(Vector(0, -1.95, 0.05), Vector(0, 0, -0.12), 54), false};
}

WardView ward_in_furnace() { return {furnace_scene, furnace_camera(), true}; }

Estimate equal_weights_albedo(double alpha, const Direction& l, const AlbedoOptions& options) {
  return directional_albedo(*make_model<EqualWeights>({{"alpha", alpha}}), l, options);
}

Estimate ward_albedo(double alpha, const Direction& l, const AlbedoOptions& options) {
  return directional_albedo(*make_model("ward", {{"alpha", alpha}}), l, options);
}

WalterPictures walter_pictures(const WardView& view, double alpha, std::size_t size, std::uint32_t uniform_samples,
                               std::uint32_t samples, std::uint64_t seed, const ProgressCallback& progress) {
  const std::size_t rows = 3 * size;
  std::size_t begin = 0;
  const auto picture = [&](Sampling sampling, std::uint32_t count, std::uint64_t its_seed) {
    const auto part = [&](std::size_t done, std::size_t) {
      if (progress) progress(begin + done, rows);
    };
    Rendering result =
        render(view.scene(sampling, alpha), view.camera,
               {.width = size, .height = size, .samples = count, .seed = its_seed, .centred = view.centred}, part);
    begin += size;
    return result;
  };
  WalterPictures result{.uniform = picture(Sampling::uniform, uniform_samples, seed),
                        .equal = picture(Sampling::equal_weights, samples, seed + 1),
                        .weighted = picture(Sampling::model, samples, seed + 2),
                        .cosine = std::vector<double>(size * size, 0)};
  const Scene scene = view.scene(Sampling::model, alpha);
  std::vector<double> relative_bias(size * size, 0);
  in_parallel(size, 0, [&](std::size_t y) {
    for (std::size_t x = 0; x < size; ++x) {
      const auto look = [&](double dx, double dy) {
        const auto at = [size](std::size_t pixel, double d) {
          return 2 * (static_cast<double>(pixel) + d) / static_cast<double>(size) - 1;
        };
        return sphere_cosine(scene, view.camera.ray(at(x, dx), -at(y, dy)));
      };
      if (look(0, 0) == 0 || look(0, 1) == 0 || look(1, 0) == 0 || look(1, 1) == 0) continue;
      const std::size_t pixel = y * size + x;
      result.cosine[pixel] = look(0.5, 0.5);
      const Direction l = Direction::from_cosine(std::min(result.cosine[pixel], 1.0));
      const AlbedoOptions options{.tolerance = 1e-5};
      relative_bias[pixel] = equal_weights_albedo(alpha, l, options).value / ward_albedo(alpha, l, options).value - 1;
    }
  });
  const std::vector<double>& cosine = result.cosine;
  result.pixels = static_cast<std::size_t>(std::ranges::count_if(cosine, [](double c) { return c > 0; }));
  result.reference = mean_over(
      cosine, [&](std::size_t i) { return result.uniform.luminance[i]; },
      [&](std::size_t i) { return result.uniform.error[i]; });
  result.weighted_minus_reference = difference(cosine, result.weighted, result.uniform);
  result.equal_minus_reference = difference(cosine, result.equal, result.uniform);
  result.predicted = mean_over(
      cosine, [&](std::size_t i) { return result.weighted.luminance[i] * relative_bias[i]; },
      [&](std::size_t i) { return result.weighted.error[i] * relative_bias[i]; });
  return result;
}

}  // namespace albedo::render
