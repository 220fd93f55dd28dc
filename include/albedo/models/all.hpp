#pragma once

#include "albedo/models/ashikhmin_premoze.hpp"
#include "albedo/models/ashikhmin_shirley.hpp"
#include "albedo/models/beckmann.hpp"
#include "albedo/models/blinn.hpp"
#include "albedo/models/blinn_original.hpp"
#include "albedo/models/cook_torrance.hpp"
#include "albedo/models/edwards.hpp"
#include "albedo/models/ggx.hpp"
#include "albedo/models/he_torrance.hpp"
#include "albedo/models/kurt.hpp"
#include "albedo/models/lafortune.hpp"
#include "albedo/models/lambert.hpp"
#include "albedo/models/measured.hpp"
#include "albedo/models/microfacet_generator.hpp"
#include "albedo/models/neumann_phong.hpp"
#include "albedo/models/neumann_stretched.hpp"
#include "albedo/models/oren_nayar.hpp"
#include "albedo/models/phong.hpp"
#include "albedo/models/phong_original.hpp"
#include "albedo/models/schlick.hpp"
#include "albedo/models/shirley_matte.hpp"
#include "albedo/models/ward.hpp"
#include "albedo/models/ward_bounded.hpp"
#include "albedo/models/ward_duer.hpp"

namespace albedo {

template <class... Models>
struct ModelList {};

/// Every model of the toolkit, in the order in which they are listed. Adding one is its header and its name here.
using AllModels =
    ModelList<Lambert, OrenNayar, ShirleyMatte, Phong, PhongOriginal, Blinn, BlinnOriginal, Lafortune, NeumannPhong,
              NeumannStretched, Ward, WardDuer, WardBounded, CookTorrance, AshikhminShirley, AshikhminPremoze, Schlick,
              Edwards, Kurt, Beckmann, Ggx, MicrofacetGenerator, HeTorrance, Measured>;

}  // namespace albedo
