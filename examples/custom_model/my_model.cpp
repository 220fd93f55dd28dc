// The toolkit with a model of one's own: Minnaert's, whose limb darkening has been fitted to the Moon and the planets
// since 1941.
//
//   cmake -B build -DCMAKE_PREFIX_PATH=<where albedo is installed> -DCMAKE_BUILD_TYPE=Release && cmake --build build
//   build/my_model models minnaert
//   build/my_model at minnaert k=2.5 --theta 0,60,89
//   build/my_model table minnaert k=0.5:2:16 -o minnaert.csv

#include <albedo/albedo.hpp>
#include <albedo/command_line.hpp>
#include <cmath>
#include <cstdio>
#include <string_view>

/// f = ρ (k+1)/(2π) (N·L N·V)^(k−1)   [Minnaert 1941, normalised by a(0) = ρ]; its albedo is ρ (N·L)^(k−1).
struct Minnaert {
  double k = 1;  // Lambert
  double rho = 1;

  static albedo::ModelInfo info() {
    return {.name = "minnaert",
            .title = "Minnaert",
            .source = "Minnaert 1941 (Astrophysical Journal 93)",
            .deviation = "normalised by (k+1)/2, which makes a(0) = rho"};
  }
  static std::vector<albedo::Parameter<Minnaert>> parameters() {
    return {albedo::number<Minnaert, &Minnaert::k>("k", {0.01, 100}, "limb darkening: 1 is none, below it brightens"),
            albedo::reflectance<Minnaert, &Minnaert::rho>("rho", "albedo at normal incidence")};
  }

  albedo::Claims claims() const { return {.conserves_energy = k >= 1, .bounded = k >= 1}; }
  std::vector<albedo::Lobe> lobes() const {
    return {{.component = 0, .weight = rho, .horizon_exponent = k}};  // f N·V ~ (N·V)^k
  }

  /// For every T: double, float, 113 bits, and a block of eight pairs.
  template <class T>
  T evaluate(int, const albedo::DirectionPair<T>& d) const noexcept {
    using albedo::pow, albedo::Scalar;
    const T scale = T(rho * (k + 1) / 2) / albedo::pi<T>;
    return scale * pow(T(d.cos_theta_l * d.cos_theta_v), Scalar<T>(k - 1));
  }
};

/// The library without the command line, and without a name to look up.
int direct_use() {
  const auto model = albedo::make_model<Minnaert>({{"k", 2.5}});
  const albedo::Estimate a = albedo::directional_albedo(*model, albedo::Direction::from_degrees(60));
  std::printf("a = %.15g +- %.1e, the formula says %.15g\n", a.value, a.error, std::pow(0.5, 1.5));
  return a.status == albedo::Status::converged ? 0 : 1;
}

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "direct") return direct_use();
  albedo::register_model<Minnaert>();
  return albedo::command_line(argc, argv);
}
