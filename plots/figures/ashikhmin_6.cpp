#include "plots/figures/pictures.hpp"
#include "plots/render/scenes.hpp"

namespace albedo::plots {

Drawing ashikhmin_6(std::string_view name) {
  return sphere_grid(name, "Ashikhmin & Shirley 2000, fig. 6: polished red spheres, R_s = 0.05", 0.8,
                     render::red_plastic);
}

}  // namespace albedo::plots
