#include "fuzz/measured.hpp"

ALBEDO_FUZZ_TARGET(rgl) { albedo::fuzz::read_measured_file(input); }
