#include "plots/figures/pictures.hpp"
#include "plots/render/scenes.hpp"

namespace albedo::plots {

Drawing ashikhmin_3(std::string_view name) {
  return sphere_grid(name, "Ashikhmin & Shirley 2000, fig. 3: golden spheres on a textured Lambertian plane", 0.8,
                     render::golden);
}

}  // namespace albedo::plots
