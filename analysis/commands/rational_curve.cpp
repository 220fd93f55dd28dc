#include "analysis/commands/rational_curve.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <iostream>

#include "analysis/commands/checks.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/files/provenance.hpp"
#include "analysis/files/rational_writer.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

Json describe(Json object, const RationalOptions& options, const RationalFit& fit) {
  object["tolerance"] = options.tolerance;  // of the form; the integrations have a hundredth of it
  object["theta_deg"] = Json::array({0, options.last_theta});
  object["coefficients"] = fit.form.coefficients();
  object["relative_error"] = fit.error;
  object["relative_error_in_float"] = fit.float_error;
  object["least_error"] = fit.least;
  object["worst_theta_deg"] = fit.worst_theta;
  object["fitted_directions"] = fit.fitted;
  object["verified_directions"] = fit.verified;
  object["evaluations"] = fit.evaluations;
  object["status"] = to_string(fit.status);
  return object;
}

Facts facts_of(const RationalOptions& options, const RationalFit& fit) {
  const double last = Direction::from_degrees(options.last_theta).cos_theta;
  double mean = 0;  // what lies beyond the last angle is cos²θ of the whole: 3e-8 at 89.99°
  constexpr int panels = 16;
  for (int i = 0; i < panels; ++i) {
    mean += boost::math::quadrature::gauss<double, 15>::integrate([&](double c) { return 2 * c * fit.form(c); },
                                                                  std::pow(last, (i + 1.0) / panels),
                                                                  std::pow(last, static_cast<double>(i) / panels));
  }
  return {.at = [&fit](double theta, double) { return fit.form(Direction::from_degrees(theta).cos_theta); },
          .max = fit.largest,
          .min = fit.smallest,
          .mean = mean,
          .error = fit.error,
          .evaluations = static_cast<double>(fit.evaluations)};
}

}  // namespace

int run_rational_curve(const Model& model, const RationalRequest& request, const std::string& command_line) {
  if (!request.output.empty()) check_rational_path(request.output);
  const RationalOptions& options = request.options;
  check_answerable(
      request.assertions,
      [&](double theta, double phi) { return phi == options.phi_degrees && theta <= options.last_theta; },
      "the form is that of another --phi, or ends before that angle");
  const RationalFit fit = rational_form(model, options);
  const Json description = describe(request.description, options, fit);
  if (!request.output.empty()) {
    Json provenance = begin_provenance(command_line);
    provenance.update(description);
    write_rational(fit.form, description["model"].get<std::string>() + "_albedo", provenance, request.output);
  }
  if (request.json) {
    Json object = description;
    object["form"] = rational_json(fit.form);
    std::cout << json_text(object) << '\n';
  }
  if (fit.status != Status::converged) {
    std::cerr << "albedo: the rational form of " << fit.form.coefficients() << " coefficients is off by up to "
              << number_text(fit.error, 3) << ", at " << number_text(fit.worst_theta, 6) << " degrees; asked for were "
              << number_text(options.tolerance, 3) << '\n';
  }
  const int code = concluding_exit_code(request.assertions, facts_of(options, fit), {1, 0});
  if (code != exit_code::done) return code;
  return fit.status == Status::converged ? exit_code::done : exit_code::not_converged;
}

}  // namespace albedo::analysis
