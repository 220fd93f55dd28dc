#include "fuzz/measured.hpp"

ALBEDO_FUZZ_TARGET(merl) { albedo::fuzz::read_measured_file(input); }
