#pragma once

/// @mainpage albedo
/// The directional albedo a(L) = ∫ f(L,V) cosθ_V dω_V of reflectance models, with errors that can be believed.
/// Start at albedo::make_model and albedo::directional_albedo; albedo::AlbedoCurve and albedo::AlbedoTable tabulate,
/// albedo::AlbedoProxy and albedo::rational_form approximate. This header is all of it; registry.hpp (models of one's
/// own) and reference.hpp read 113-bit arithmetic, which takes seconds to compile: what needs neither includes the
/// rest.

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
#include "albedo/corrections.hpp"
#include "albedo/curve.hpp"
#include "albedo/directional_albedo.hpp"
#include "albedo/grazing.hpp"
#include "albedo/proxy.hpp"
#include "albedo/pumping.hpp"
#include "albedo/rational_form.hpp"
#include "albedo/reference.hpp"
#include "albedo/registry.hpp"
#include "albedo/shader_tables.hpp"
#include "albedo/table.hpp"
#include "albedo/table_growth.hpp"
#include "albedo/table_source.hpp"
#include "albedo/version.hpp"
