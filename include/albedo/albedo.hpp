#pragma once

/// @mainpage albedo
/// The directional albedo a(L) = ∫ f(L,V) cosθ_V dω_V of reflectance models, with errors that can be believed.
/// Start at albedo::make_model and albedo::directional_albedo; albedo::AlbedoCurve and albedo::AlbedoTable tabulate.

#include "albedo/audit.hpp"
#include "albedo/balance.hpp"
#include "albedo/bounds.hpp"
#include "albedo/combinators/balanced.hpp"
#include "albedo/combinators/compensated.hpp"
#include "albedo/combinators/coupled.hpp"
#include "albedo/combinators/pumped.hpp"
#include "albedo/combinators/sum.hpp"
#include "albedo/core/errors.hpp"
#include "albedo/core/estimate.hpp"
#include "albedo/core/model.hpp"
#include "albedo/curve.hpp"
#include "albedo/directional_albedo.hpp"
#include "albedo/grazing.hpp"
#include "albedo/pumping.hpp"
#include "albedo/reference.hpp"
#include "albedo/registry.hpp"
#include "albedo/table.hpp"
#include "albedo/version.hpp"
