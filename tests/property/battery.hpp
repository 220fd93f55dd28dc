#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "albedo/core/model.hpp"
#include "albedo/directional_albedo.hpp"

/// The battery: every model, gentle and extreme, that every property is tested on. Adding a model is a line or more
/// here; Battery.HasEveryModel fails until there is one.
namespace albedo::battery {

/// A needle is a lobe of roughness 1e-4 or of exponent 1e6. Costly is what has edges or points that no warp
/// knows of: the rim of Edwards's lump, the cone of Beckmann's Λ at V = N where the lobe is wide, that of a diffuse
/// lobe's Fresnel term at V = −L, a fractional power at the horizon of a mirror lobe. A series is costly too, and takes
/// a millisecond in 113 bits.
enum class Shape { ordinary, needle, costly, series };

struct Case {
  std::string model;
  Parameters parameters;
  double phi = 0;  ///< azimuth of L in degrees
  Shape shape = Shape::ordinary;
};

/// Polar angles of L in degrees.
inline const std::vector<double> thetas{0, 30, 60, 80, 89, 89.9};

inline const std::vector<Case>& cases() {
  constexpr Shape needle = Shape::needle, costly = Shape::costly, series = Shape::series;
  static const std::vector<Case> all{
      {"lambert", {}},
      {"lambert", {{"rho", 0.18}}},

      {"oren_nayar", {}},
      {"oren_nayar", {{"sigma", 0.2}, {"rho", 0.9}}, 35},
      {"oren_nayar", {{"sigma", 1.0}}},
      {"oren_nayar", {{"sigma", 0.0}}},  // Lambert

      {"shirley_matte", {}},
      {"shirley_matte", {{"r0", 0.0}, {"r_m", 0.5}}},
      {"shirley_matte", {{"r0", 0.9}}},

      {"phong", {{"n", 0.0}}},
      {"phong", {{"n", 1.0}}},
      {"phong", {{"n", 2.5}}},
      {"phong", {}},
      {"phong", {{"n", 1000.0}}},
      {"phong", {{"n", 1e6}}, 0, needle},

      {"phong_original", {{"n", 1.0}}},
      {"phong_original", {}},
      {"phong_original", {{"n", 1e6}}, 0, needle},

      {"blinn", {{"n", 0.0}}},
      {"blinn", {{"n", 1.0}}},
      {"blinn", {}},
      {"blinn", {{"n", 1000.0}}},
      {"blinn", {{"n", 1e6}}, 0, needle},

      {"blinn_original", {{"n", 1.0}}},
      {"blinn_original", {}},
      {"blinn_original", {{"n", 1e6}}, 0, needle},

      {"lafortune", {}},
      {"lafortune", {{"c_x", -1.0}, {"c_y", -0.8}, {"c_z", 0.5}, {"n", 5.0}}, 20},
      {"lafortune", {{"c_x", -1.0}, {"c_y", -1.0}, {"c_z", -0.3}, {"n", 3.0}}},  // an axis below the horizon
      {"lafortune", {{"c_x", -1.0}, {"c_y", -1.0}, {"c_z", 1.1}, {"n", 20.0}}},  // off-specular
      {"lafortune", {{"c_x", -0.577}, {"c_y", -0.577}, {"c_z", 0.577}, {"n", 1e6}}, 0, needle},

      {"neumann_phong", {{"n", 0.0}}},
      {"neumann_phong", {{"n", 1.0}}},
      {"neumann_phong", {}},
      {"neumann_phong", {{"n", 1000.0}}},
      {"neumann_phong", {{"n", 1e6}}, 0, needle},

      {"neumann_stretched", {{"n", 0.0}, {"q", 0.9}}, 0, costly},
      {"neumann_stretched", {{"n", 1.0}, {"q", 0.95}}, 0, costly},
      {"neumann_stretched", {}},
      {"neumann_stretched", {{"q", 0.0}}},
      {"neumann_stretched", {{"q", 1.0}}},
      {"neumann_stretched", {{"n", 1e6}, {"q", 0.3}}, 0, needle},

      {"ward", {}},
      {"ward", {{"alpha", 0.01}}},
      {"ward", {{"alpha", 0.3}}},
      {"ward", {{"alpha", 1.0}}},
      {"ward", {{"alpha", 3.0}}},
      {"ward", {{"alpha", 0.15}, {"rho_s", 0.6}, {"rho_d", 0.3}}},
      {"ward", {{"alpha", 1e-4}}, 0, needle},
      {"ward", {{"alpha_x", 0.3}, {"alpha_y", 0.05}}, 30},
      {"ward", {{"alpha_x", 0.3}, {"alpha_y", 0.05}}, 90},  // the plane of incidence along the narrow axis
      {"ward", {{"alpha_x", 0.5}, {"alpha_y", 0.005}}, 0},
      {"ward", {{"alpha_x", 0.5}, {"alpha_y", 0.005}}, 70},

      {"ward_duer", {}},
      {"ward_duer", {{"alpha", 1.0}}},
      {"ward_duer", {{"alpha", 0.15}, {"rho_s", 0.6}, {"rho_d", 0.3}}},
      {"ward_duer", {{"alpha", 1e-4}}, 0, needle},
      {"ward_duer", {{"alpha_x", 0.3}, {"alpha_y", 0.05}}, 30},

      {"ward_bounded", {}},
      {"ward_bounded", {{"alpha", 0.01}}},
      {"ward_bounded", {{"alpha", 1.0}}},
      {"ward_bounded", {{"alpha", 10.0}}},
      {"ward_bounded", {{"alpha", 0.2}, {"rho_s", 0.8}, {"rho_d", 0.4}}},  // above 1
      {"ward_bounded", {{"alpha", 1e-4}}, 0, needle},
      {"ward_bounded", {{"alpha_x", 0.3}, {"alpha_y", 0.05}}, 30},

      {"cook_torrance", {}},
      {"cook_torrance", {{"m", 0.3}}},
      {"cook_torrance", {{"m", 1.0}}},
      {"cook_torrance", {{"m", 1e-4}}, 0, needle},
      {"cook_torrance", {{"m", 0.1}, {"masking", "none"}}},
      {"cook_torrance", {{"m", 0.3}, {"masking", "none"}}},
      {"cook_torrance", {{"m", 0.2}, {"f0", 0.05}, {"k_s", 0.7}, {"k_d", 0.3}}},
      {"cook_torrance", {{"m", 0.2}, {"fresnel", "conductor"}, {"eta", 0.2}, {"k", 3.0}}},

      {"ashikhmin_shirley", {{"n", 0.0}}},
      {"ashikhmin_shirley", {{"n", 1.0}}},
      {"ashikhmin_shirley", {}},
      {"ashikhmin_shirley", {{"n", 1000.0}}},
      {"ashikhmin_shirley", {{"n", 1e6}}, 0, needle},
      {"ashikhmin_shirley", {{"n_u", 10.0}, {"n_v", 1000.0}}, 25},
      {"ashikhmin_shirley", {{"n", 50.0}, {"r_s", 0.05}, {"r_d", 1.0}}},  // both lobes
      {"ashikhmin_shirley", {{"r_s", 0.05}, {"r_d", 1.0}, {"k_s", 0.0}}},

      {"ashikhmin_shirley", {{"n", 0.0}, {"normalization", "projected"}}},
      {"ashikhmin_shirley", {{"n", 10.0}, {"normalization", "projected"}}},
      {"ashikhmin_shirley", {{"n_u", 1.0}, {"n_v", 100.0}, {"normalization", "projected"}}, 65},

      {"ashikhmin_premoze", {{"m", 0.1}}},
      {"ashikhmin_premoze", {{"fresnel", "conductor"}, {"eta", 1.5}, {"k", 7.0}}},
      {"ashikhmin_premoze", {{"m", 1.0}, {"f0", 0.04}}},
      {"ashikhmin_premoze", {{"m", 3.5}}},
      {"ashikhmin_premoze", {{"m", 4.0}}},  // above 1 at grazing incidence
      {"ashikhmin_premoze", {{"m", 1e-4}}, 0, needle},

      {"schlick", {{"r", 1.0}}},
      {"schlick", {{"r", 0.25}, {"f0", 0.2}}},
      {"schlick", {}},
      {"schlick", {{"r", 0.01}}},
      {"schlick", {{"r", 1e-5}}},  // the limit at 90 degrees sets in where N·L is below r
      {"schlick", {{"r", 0.25}, {"p", 0.3}}, 90},
      {"schlick", {{"r", 0.05}, {"p", 0.1}}, 30},

      {"edwards", {}},
      {"edwards", {{"n", 100.0}, {"radius", 0.5}}, 0, costly},
      {"edwards", {{"n", 12.0}, {"radius", 0.3}}, 0, costly},
      {"edwards", {{"n", 1e6}}, 0, costly},

      {"kurt", {}},
      {"kurt", {{"m", 0.2}, {"equation", "9"}}},
      {"kurt", {{"m", 1.0}, {"equation", "9"}}},
      {"kurt", {{"m", 2.0}, {"equation", "9"}}},  // above 1 at grazing incidence
      {"kurt", {{"m", 1e-4}, {"equation", "9"}}, 0, needle},
      {"kurt", {{"m_x", 0.3}, {"m_y", 0.03}, {"equation", "9"}}, 50},
      {"kurt", {{"m", 0.2}, {"exponent", 0.5}}},
      {"kurt", {{"m", 0.2}, {"fresnel", "conductor"}, {"eta", 0.2}, {"k", 3.0}}},
      {"kurt", {{"m", 0.5}, {"exponent", 1.0}}},
      {"kurt", {{"m", 0.2}, {"exponent", 1.5}}},
      {"kurt", {{"m", 0.3}, {"equation", "11"}, {"exponent", 0.3}, {"k_s", 0.6}, {"k_d", 0.3}}},
      {"kurt", {{"m", 0.3}, {"equation", "13"}, {"f0", 0.2}, {"k_d", 0.5}, {"exponent", 0.2}}, 0, costly},

      {"beckmann", {}},
      {"beckmann", {{"alpha", 0.05}}},
      {"beckmann", {{"alpha", 1.0}}, 0, costly},
      {"beckmann", {{"alpha", 5.0}}, 0, costly},
      {"beckmann", {{"alpha", 1e-4}}, 0, needle},
      {"beckmann", {{"alpha", 0.01}, {"masking", "separable"}}},
      {"beckmann", {{"alpha", 0.5}, {"masking", "separable"}}, 0, costly},
      {"beckmann", {{"alpha", 0.2}, {"fresnel", "conductor"}, {"eta", 1.5}, {"k", 7.0}}},
      {"beckmann", {{"alpha_x", 0.5}, {"alpha_y", 0.1}}, 40},
      {"beckmann", {{"alpha_x", 0.05}, {"alpha_y", 0.3}, {"f0", 0.04}}, 70},

      {"microfacet_generator", {}},
      {"microfacet_generator", {{"distribution", "beckmann"}}},
      {"microfacet_generator", {{"alpha", 0.05}, {"f0", 0.04}}},
      {"microfacet_generator", {{"alpha", 1.0}}},
      {"microfacet_generator", {{"distribution", "power"}}},
      {"microfacet_generator", {{"alpha", 0.01}, {"distribution", "power"}}},
      {"microfacet_generator", {{"alpha", 1.0}, {"distribution", "power"}}},
      {"microfacet_generator", {{"alpha", 0.2}, {"fresnel", "conductor"}, {"eta", 1.5}, {"k", 7.0}}},

      {"he_torrance", {}, 0, series},  // above 1 at 80 degrees
      {"he_torrance", {{"part", "directional_diffuse"}, {"sigma0", 0.02}, {"tau", 0.5}}, 0, series},
      {"he_torrance", {{"part", "specular"}, {"sigma0", 0.01}}, 0, series},
      {"he_torrance", {{"sigma0", 0.05}, {"tau", 28.0}, {"f0", 0.04}, {"k_d", 0.3}, {"k_s", 0.7}}, 0, series},
      {"he_torrance", {{"sigma0", 4.0}, {"tau", 28.0}, {"fresnel", "conductor"}, {"eta", 1.5}, {"k", 7.0}}, 0, series},

      {"ggx", {}},
      {"ggx", {{"alpha", 0.1}}},
      {"ggx", {{"alpha", 1.0}}},
      {"ggx", {{"alpha", 5.0}}},
      {"ggx", {{"alpha", 1e-4}}, 0, needle},
      {"ggx", {{"alpha", 0.01}, {"masking", "separable"}}},
      {"ggx", {{"alpha", 0.5}, {"masking", "separable"}}},
      {"ggx", {{"alpha", 0.3}, {"f0", 0.04}}},
      {"ggx", {{"alpha", 0.2}, {"fresnel", "conductor"}, {"eta", 1.5}, {"k", 7.0}}},
      {"ggx", {{"alpha_x", 0.5}, {"alpha_y", 0.1}}, 40},
      {"ggx", {{"alpha_x", 0.1}, {"alpha_y", 0.5}}, 0},
      {"ggx", {{"alpha_x", 1.0}, {"alpha_y", 0.01}}, 40},
  };
  return all;
}

inline std::vector<Case> cases_of(const std::string& model) {
  std::vector<Case> found;
  for (const Case& c : cases()) {
    if (c.model == model) found.push_back(c);
  }
  return found;
}

inline std::string name(const Case& c) {
  std::ostringstream text;
  text << c.model;
  for (const auto& [parameter, value] : c.parameters) {
    text << ' ' << parameter << '=';
    std::visit([&](const auto& v) { text << v; }, value);
  }
  if (c.phi != 0) text << " phi " << c.phi;
  return text.str();
}

inline std::string name(const Case& c, double theta) {
  std::ostringstream text;
  text << name(c) << " at " << theta << " degrees";
  return text.str();
}

inline std::string text(const Estimate& e) {
  std::ostringstream stream;
  stream.precision(17);
  stream << e.value << " +- ";
  stream.precision(3);
  stream << e.error << ", " << to_string(e.status) << ", " << e.evaluations << " evaluations";
  return stream.str();
}

/// Those that are formulas; measured_test.cpp is for the others.
inline std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const ModelInfo& info : model_infos()) {
    if (!info.needs_input()) names.push_back(info.name);
  }
  return names;
}

/// Those whose lobes can all be sampled.
inline std::vector<std::string> sampled_model_names() {
  std::vector<std::string> names = model_names();
  std::erase_if(names, [](const std::string& name) {
    const auto model = make_model(name);
    const auto lobes = model->lobes();
    return !std::all_of(lobes.begin(), lobes.end(), [&](const Lobe& l) { return model->has_sampler(l.component); });
  });
  return names;
}

/// A suite with one instance a model, named by it.
class PerModel : public ::testing::TestWithParam<std::string> {};

inline std::string instance_name(const ::testing::TestParamInfo<std::string>& info) { return info.param; }

}  // namespace albedo::battery
