#include "fuzz/scenes.hpp"

ALBEDO_FUZZ_TARGET(radiance) { albedo::fuzz::read_scene_file(input, albedo::analysis::read_radiance); }
