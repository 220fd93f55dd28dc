#include "plots/render/scenes.hpp"

#include <array>

#include "plots/render/colour.hpp"

namespace albedo::render {

View metal_tank(const std::shared_ptr<const Model>& model) {
  View view;
  Scene& scene = view.scene;
  scene.environment = Spectrum(1);
  const auto add = [&](const char* element) {
    return scene.add({.lobes = lobes_of(model, conductor(metal(element)))});
  };
  const std::size_t aluminium = add("Al"), silver = add("Ag"), copper = add("Cu"), gold = add("Au");
  const std::size_t lamp = scene.add({.emission = Spectrum(6.5)});
  scene.add_box({-1.7, -1.3, 0}, {1.7, 1.3, 0.6}, gold, false);
  constexpr double edge = 0.95, height = 0.95;
  scene.add_pyramid({-0.85, 0.6, 0}, edge, height, 20, aluminium);
  scene.add_pyramid({0.85, 0.6, 0}, edge, height, 20, silver);
  scene.add_pyramid({-0.85, -0.55, 0}, edge, height, 20, copper);
  scene.add_pyramid({0.85, -0.55, 0}, edge, height, 20, gold);
  scene.spheres = {{{-3, -2, 4.5}, 1, lamp}, {{3.5, 2.5, 4}, 1, lamp}};
  view.camera = Camera::perspective({0.6, -5.2, 3.3}, {0, -0.1, 0.2}, 41.5, 1.75);
  return view;
}

View sphere_on_plane(std::vector<SurfaceLobe> lobes) {
  View view;
  Scene& scene = view.scene;
  scene.environment = rgb(0.55, 0.55, 0.55);
  const std::size_t plane =
      scene.add({.lobes = lobes_of(make_model("lambert", {{"rho", 0.75}}), constant(rgb(1, 1, 1))),
                 .chequer = 0.7,
                 .odd = rgb(0.2, 0.25, 0.35)});
  const std::size_t lamp = scene.add({.emission = rgb(7.5, 7.5, 7.5)});
  const std::size_t sphere = scene.add({.lobes = std::move(lobes)});
  scene.facets = {{{-14, -14, 0}, {28, 0, 0}, {0, 28, 0}, plane}};
  scene.spheres = {{{0, 0, 1}, 1, sphere}, {{-3, -3.5, 5}, 1.6, lamp}};
  view.camera = Camera::perspective({0, -6.5, 2.4}, {0, 0, 0.95}, 21.5);
  return view;
}

std::vector<SurfaceLobe> golden(double n_u, double n_v) {
  const Colour colour = colour_of_bands(conductor(metal("Au"))(1));
  return lobes_of(make_model("ashikhmin_shirley", {{"n_u", n_u}, {"n_v", n_v}, {"r_s", 1.0}}), schlick(colour));
}

std::vector<SurfaceLobe> red_plastic(double n_u, double n_v) {
  std::vector<SurfaceLobe> lobes =
      lobes_of(make_model("ashikhmin_shirley", {{"n_u", n_u}, {"n_v", n_v}, {"r_s", 0.05}, {"r_d", 1.0}}),
               constant(rgb(1, 1, 1)));
  for (SurfaceLobe& lobe : lobes) {
    if (lobe.component == 1) lobe.reflectance = constant(rgb(0.75, 0.06, 0.05));
  }
  return lobes;
}

}  // namespace albedo::render
