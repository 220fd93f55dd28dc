#include "plots/render/furnace.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "albedo/combinators/pumped.hpp"
#include "albedo/corrections.hpp"
#include "albedo/curve.hpp"

namespace albedo::render {

namespace {

constexpr double half_width = 1.04;  // of the picture, in radii

Direction direction_of(const UnitVector<double>& v) {
  const double sine = std::hypot(v.x, v.y);
  return {v.z, sine, sine > 0 ? v.x / sine : 1, sine > 0 ? v.y / sine : 0};
}

/// Coordinate in [−1, 1] of the middle of a pixel's part.
double coordinate(std::size_t pixel, double part, std::size_t size) {
  return 2 * (static_cast<double>(pixel) + part) / static_cast<double>(size) - 1;
}

/// What is seen of the sphere in one pixel: which part of it, and the direction to the eye where that part is in the
/// mean.
struct Cover {
  double part = 0;
  UnitVector<double> viewer{};
};

Cover cover(const Scene& scene, const Camera& camera, std::size_t x, std::size_t y, std::size_t size) {
  constexpr int parts = 8;
  int hits = 0;
  double mean_x = 0, mean_y = 0;
  for (int i = 0; i < parts * parts; ++i) {
    const double at_x = coordinate(x, (i % parts + 0.5) / parts, size);
    const double at_y = -coordinate(y, (i / parts + 0.5) / parts, size);
    if (!scene.closest(camera.ray(at_x, at_y))) continue;
    ++hits;
    mean_x += at_x;
    mean_y += at_y;
  }
  if (hits == 0) return {};
  const Ray ray = camera.ray(mean_x / hits, mean_y / hits);
  const auto hit = scene.closest(ray);  // the disk is convex
  return {static_cast<double>(hits) / (parts * parts), hit->frame.local(-ray.direction)};
}

constexpr double test_tolerance = 1e-5;  // of the albedos in tests

}  // namespace

AlbedoFunction albedo_of(const Model& model, double tolerance) {
  if (!model.claims().isotropic) {
    return [&model, tolerance](const UnitVector<double>& v) {
      return directional_albedo(model, direction_of(v), {.tolerance = tolerance});
    };
  }
  const auto curve = std::make_shared<AlbedoCurve>(model, CurveOptions{.albedo = {.tolerance = tolerance}});
  return [curve](const UnitVector<double>& v) {
    const double value = (*curve)(v.z);
    return Estimate{.value = value, .error = value * curve->relative_bound(), .status = curve->status()};
  };
}

FurnaceCase plain_case(std::unique_ptr<Model> model) {
  const std::shared_ptr<const Model> shared = std::move(model);
  return {shared, [shared, albedo = albedo_of(*shared, test_tolerance)](const auto& v) { return albedo(v); }};
}

FurnaceCase pumped_case(std::string_view model, const Parameters& parameters, const PumpOptions& options) {
  auto pumped = std::make_unique<PumpedModel>(make_model(model, parameters), options);
  if (!pumped->claims().isotropic) return plain_case(std::move(pumped));
  const std::shared_ptr<const PumpedModel> shared = std::move(pumped);
  const auto sequence =
      std::make_shared<PumpSequence>(shared->base(), options.control, options.only_up, options.tolerance);
  for (int k = 0; k < options.times; ++k) sequence->advance();
  return {shared, [shared, sequence, order = options.times](const UnitVector<double>& v) {
            const double value = sequence->albedo(order, v.z);
            return Estimate{
                .value = value, .error = value * sequence->relative_bound(order), .status = sequence->status()};
          }};
}

namespace {

FurnaceCase corrected_case(std::string_view model, const Parameters& parameters, Correction correction) {
  return plain_case(Corrections{.correct = correction}.applied_to(make_model(model, parameters)));
}

}  // namespace

Camera furnace_camera() { return Camera::parallel(Vector::Zero(), Vector::UnitY(), half_width); }

Scene furnace(std::vector<SurfaceLobe> lobes) {
  Scene scene;
  scene.environment = Spectrum(1);
  const std::size_t material = scene.add({.lobes = std::move(lobes)});
  scene.spheres.push_back({Vector::Zero(), 1, material});
  return scene;
}

AlbedoSphere albedo_sphere(const Model& model, std::size_t size, double tolerance) {
  const Scene scene = furnace({});
  const Camera camera = furnace_camera();
  const AlbedoFunction albedo = albedo_of(model, tolerance);
  const std::size_t half = (size + 1) / 2;
  std::vector<Cover> covers(half * half);
  std::vector<Estimate> estimates(half * half);
  in_parallel(half, 0, [&](std::size_t y) {
    for (std::size_t x = 0; x < half; ++x) {
      Cover& seen = covers[y * half + x];
      seen = cover(scene, camera, x, y, size);
      if (seen.part > 0) estimates[y * half + x] = albedo(seen.viewer);
    }
  });

  AlbedoSphere result{.picture = Picture(size, size), .darkest = 1e300};
  for (std::size_t y = 0; y < size; ++y) {
    for (std::size_t x = 0; x < size; ++x) {
      const std::size_t source = std::min(y, size - 1 - y) * half + std::min(x, size - 1 - x);
      const double part = covers[source].part;
      const Estimate& estimate = estimates[source];
      const double value = part > 0 ? part * estimate.value + (1 - part) : 1;
      result.picture.at(x, y) = {value, value, value};
      if (part == 0) continue;
      result.darkest = std::min(result.darkest, estimate.value);
      result.brightest = std::max(result.brightest, estimate.value);
      result.worst_error = std::max(result.worst_error, estimate.error);
      if (estimate.status != Status::converged) ++result.unconverged;
    }
  }
  return result;
}

const std::vector<FurnaceModel>& furnace_models() {
  static const std::vector<FurnaceModel> list{
      {"Phong, {/:Italic n} = 20\\npumped once",
       [] {
         return pumped_case("phong", {{"n", 20.0}}, {});
       }},
      {"Phong, {/:Italic n} = 20\\n3 times, total",
       [] {
         return pumped_case("phong", {{"n", 20.0}}, {.times = 3, .control = PumpControl::total});
       }},
      {"Blinn, {/:Italic n} = 20\\n2 times, step",
       [] {
         return pumped_case("blinn", {{"n", 20.0}}, {.times = 2, .control = PumpControl::step});
       }},
      {"Ward, {/:Italic α} = 0.3\\npumped once",
       [] {
         return pumped_case("ward", {{"alpha", 0.3}}, {});
       }},
      {"GGX, {/:Italic α} = 0.5\\npumped once",
       [] {
         return pumped_case("ggx", {{"alpha", 0.5}}, {});
       }},
      {"A.–Shirley, 10 × 100\\nnot pumped",
       [] {
         return plain_case(make_model("ashikhmin_shirley", {{"n_u", 10.0}, {"n_v", 100.0}}));
       }},
  };
  return list;
}

const std::vector<FurnaceModel>& corrected_furnace_models() {
  static const std::vector<FurnaceModel> list{
      {"GGX, {/:Italic α} = 0.5\\nbalanced",
       [] {
         return corrected_case("ggx", {{"alpha", 0.5}}, Correction::balance);
       }},
      {"GGX, {/:Italic α} = 0.5\\nKulla–Conty",
       [] {
         return corrected_case("ggx", {{"alpha", 0.5}}, Correction::multiscatter);
       }},
      {"GGX, {/:Italic α} = 0.5\\nTurquin",
       [] {
         return corrected_case("ggx", {{"alpha", 0.5}}, Correction::turquin);
       }},
      {"Phong, {/:Italic n} = 20\\nbalanced",
       [] {
         return corrected_case("phong", {{"n", 20.0}}, Correction::balance);
       }},
      {"Blinn, {/:Italic n} = 20\\nKulla–Conty",
       [] {
         return corrected_case("blinn", {{"n", 20.0}}, Correction::multiscatter);
       }},
      {"Ward, {/:Italic α} = 0.3\\nbalanced",
       [] {
         return corrected_case("ward", {{"alpha", 0.3}}, Correction::balance);
       }},
  };
  return list;
}

FurnaceTest test_in_furnace(const FurnaceCase& furnace_case, std::size_t size, std::uint32_t samples,
                            std::uint64_t seed, const ProgressCallback& progress) {
  const Scene scene = furnace(lobes_of(furnace_case.model, constant(Spectrum(1))));
  const Camera camera = furnace_camera();
  FurnaceTest test{
      .traced = render(
          scene, camera,
          {.width = size, .height = size, .samples = samples, .seed = seed, .centred = true, .luminance = rgb(1, 0, 0)},
          progress),
      .albedo = std::vector<double>(size * size, 1),
      .deviation = std::vector<double>(size * size, 0)};
  std::vector<Status> status(size * size, Status::converged);
  std::vector<char> on_sphere(size * size, 0);
  in_parallel(size, 0, [&](std::size_t y) {
    for (std::size_t x = 0; x < size; ++x) {
      const Ray ray = camera.ray(coordinate(x, 0.5, size), -coordinate(y, 0.5, size));
      const auto hit = scene.closest(ray);
      if (!hit) continue;
      const Estimate estimate = furnace_case.albedo(hit->frame.local(-ray.direction));
      const std::size_t pixel = y * size + x;
      test.albedo[pixel] = estimate.value;
      status[pixel] = estimate.status;
      on_sphere[pixel] = 1;
    }
  });

  double squares = 0, errors2 = 0;
  for (std::size_t i = 0; i < on_sphere.size(); ++i) {
    if (on_sphere[i] == 0) continue;
    ++test.pixels;
    if (status[i] != Status::converged) ++test.unconverged;
    const double difference = test.traced.luminance[i] - test.albedo[i];
    test.deviation[i] = difference / test.traced.error[i];
    test.mean_difference += difference;
    errors2 += square(test.traced.error[i]);
    squares += square(test.deviation[i]);
    test.largest_deviation = std::max(test.largest_deviation, std::abs(test.deviation[i]));
  }
  const auto count = static_cast<double>(test.pixels);
  test.mean_difference /= count;
  test.mean_error = std::sqrt(errors2) / count;
  test.rms_deviation = std::sqrt(squares / count);
  return test;
}

}  // namespace albedo::render
