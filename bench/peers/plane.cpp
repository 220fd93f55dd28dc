#include "peers/plane.hpp"

#include <algorithm>
#include <type_traits>

#include "albedo/core/errors.hpp"
#include "albedo/models/ashikhmin_shirley.hpp"
#include "albedo/models/cook_torrance.hpp"
#include "albedo/models/ggx.hpp"
#include "albedo/models/phong.hpp"
#include "albedo/models/ward.hpp"
#include "integration/lobe_integrand.hpp"
#include "warps/half_vector.hpp"
#include "warps/mirror_lobe.hpp"

namespace albedo::peers {

/// (θ_V, φ_V), undivided. L must be at azimuth 0.
template <class T>
class Hemisphere {
  using S = Scalar<T>;

 public:
  Hemisphere(const Lobe& lobe, const Direction& l, double /*tolerance*/)
      : l_(unit_vector<S>(l)), axis_(lobe_axis(lobe, l_)) {}

  [[nodiscard]] const std::vector<Panel>& panels() const { return panels_; }
  [[nodiscard]] double truncation() const { return 0; }

  struct Line {
    T cosine, sine;  // of φ_V
  };
  [[nodiscard]] Line line(int /*panel*/, const T& v) const {
    Line ray;
    sincos_quarter(T(2 * v), ray.sine, ray.cosine);
    return ray;
  }
  [[nodiscard]] Sample<T> point(int /*panel*/, const Line& ray, const T& u) const {
    T cosine, sine;  // from the horizon, where the cosine keeps its digits
    sincos_quarter(T(1 - u), cosine, sine);
    const UnitVector<T> v{sine * ray.cosine, sine * ray.sine, cosine};
    return {direction_pair(broadcast<T>(l_), v, broadcast<T>(axis_)), T(pi<T> * pi<T>) * sine * cosine};
  }

 private:
  UnitVector<S> l_, axis_;
  std::vector<Panel> panels_{Panel{}};
};

namespace {

template <class M, template <class> class WarpIn>
class PlaneOf final : public Plane {
  using Warp = WarpIn<double>;

 public:
  PlaneOf(const M& model, const Model& erased, const Lobe& lobe, const Direction& l, double tolerance)
      : model_(model),
        component_(lobe.component),
        warp_(lobe, l, tolerance),
        ray_(warp_.line(0, 0.5)),
        blocks_(erased, lobe, l, tolerance, false) {}

  [[nodiscard]] int panels() const override { return static_cast<int>(warp_.panels().size()); }
  double at(int panel, double u, double v) override { return weight(panel, warp_.line(panel, v), u); }
  void set_ray(int panel, double v) override { panel_ = panel, ray_ = warp_.line(panel, v); }
  double on_ray(double u) override { return weight(panel_, ray_, u); }
  [[nodiscard]] const Integrand<double>& blocks() const override { return blocks_; }

 private:
  double weight(int panel, const typename Warp::Line& ray, double u) {
    ++evaluations;
    if (spent()) return 0;
    const Sample<double> sample = warp_.point(panel, ray, inside(u));
    return model_.evaluate(component_, sample.pair) * sample.weight;
  }

  M model_;
  int component_;
  Warp warp_;
  int panel_ = 0;
  typename Warp::Line ray_;
  LobeIntegrand<WarpIn, Block> blocks_;
};

/// The material's model struct, as make_model has it behind its interface.
template <class M>
M concrete(const Material& material, const ModelInfo& info) {
  M model;
  const std::vector<std::string> names = info.resolve(material.parameter);
  for (const Parameter<M>& parameter : M::parameters()) {
    if (std::find(names.begin(), names.end(), parameter.info.name) != names.end()) parameter.set(model, material.value);
  }
  return model;
}

template <class M, template <class> class LobeWarp>
std::unique_ptr<Plane> plane_of(const Material& material, const Model& model, const Direction& l,
                                Coordinates coordinates, double tolerance) {
  const M exact = concrete<M>(material, model.info());
  const Lobe lobe = model.lobes().front();  // the battery's materials have one
  if (coordinates == Coordinates::lobe) return std::make_unique<PlaneOf<M, LobeWarp>>(exact, model, lobe, l, tolerance);
  return std::make_unique<PlaneOf<M, Hemisphere>>(exact, model, lobe, l, tolerance);
}

}  // namespace

std::string_view to_string(Coordinates coordinates) {
  return coordinates == Coordinates::hemisphere ? "hemisphere" : "lobe";
}

std::unique_ptr<Plane> make_plane(const Material& material, const Model& model, const Direction& l,
                                  Coordinates coordinates, double tolerance) {
  const auto make = material.model == "ward"                ? plane_of<Ward, HalfVectorWarp>
                    : material.model == "cook_torrance"     ? plane_of<CookTorrance, HalfVectorWarp>
                    : material.model == "ashikhmin_shirley" ? plane_of<AshikhminShirley, HalfVectorWarp>
                    : material.model == "ggx"               ? plane_of<Ggx, HalfVectorWarp>
                    : material.model == "phong"             ? plane_of<Phong, MirrorLobeWarp>
                                                            : nullptr;
  if (make == nullptr) throw UnknownModel("the battery has no model '" + material.model + "'");
  return make(material, model, l, coordinates, tolerance);
}

}  // namespace albedo::peers
