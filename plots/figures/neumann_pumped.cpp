#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "plots/data/pumped_curves.hpp"
#include "plots/figures/figure.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/sheet.hpp"

namespace albedo::plots {
namespace {

using analysis::PumpedCurves;

constexpr int times = 5;
constexpr double exponent = 20, tolerance = 1e-8;

/// A way to pump, with its curves.
struct Reading {
  PumpControl control;
  PumpedCurves curves;

  [[nodiscard]] std::string name() const { return std::string(to_string(control)); }
};

/// What a figure shows: two readings of control have one row of panels each.
struct Subject {
  const char *model, *title;
  bool controlled;
};

Subject subject_of(std::string_view name) {
  const bool controlled = name == "neumann-5" || name == "neumann-6";
  if (name == "neumann-3" || name == "neumann-5") return {"phong", "Phong", controlled};
  return {"blinn", "Blinn", controlled};
}

/// The looks of the curve after k pumpings.
constexpr std::array styles{"lines linetype 7", "lines linetype 1", "lines linetype 2",
                            "lines linetype 3", "lines linetype 4", "lines linetype 5"};

std::string column(const Reading& reading, const std::string& quantity, int order) {
  return reading.name() + "_" + quantity + "_" + std::to_string(order);
}

std::string radiance_at(double incidence) { return "radiance_" + short_text(incidence); }

std::string data(const std::vector<Reading>& readings, const Subject& subject, std::string_view name) {
  Sheet sheet(name, "Neumann, Neumann, Szirmay-Kalos 1999, fig. " + std::string(name.substr(name.find('-') + 1)));
  sheet.note("model", std::string(subject.model) + " n=" + short_text(exponent));
  sheet.note("quantity",
             "CONTROL_albedo_K: albedo of light from theta after K pumpings; CONTROL_peak_K: largest output radiance "
             "f cos(theta_L) over V in the plane of incidence, of light from theta; CONTROL_radiance_A_K: output "
             "radiance towards theta of light from A degrees");
  sheet.note("theta",
             "degrees; negative on the side of the light, where albedo and peak are those of its absolute value");
  for (const Reading& reading : readings) {
    if (reading.control == PumpControl::none) sheet.note("control none", "eq. 20");
    if (reading.control == PumpControl::step) sheet.note("control step", "eq. 21 at every step");
    if (reading.control == PumpControl::total) {
      sheet.note("control total", "the product of all divisors is at least max(N.L, N.V)");
    }
  }
  sheet.note("tolerance", tolerance);
  for (const Reading& reading : readings) {
    for (std::size_t k = 0; k <= times; ++k) {
      sheet.note("relative bound of " + column(reading, "albedo", static_cast<int>(k)),
                 reading.curves.relative_bound[k]);
    }
  }
  std::vector<std::string> names{"theta"};
  for (const Reading& reading : readings) {
    for (int k = 0; k <= times; ++k) {
      names.push_back(column(reading, "albedo", k));
      names.push_back(column(reading, "peak", k));
      for (const double incidence : reading.curves.incidences) {
        names.push_back(column(reading, radiance_at(incidence), k));
      }
    }
  }
  sheet.columns(names);
  const PumpedCurves& first = readings.front().curves;
  const std::size_t horizon = first.thetas.size() - 1;
  for (std::size_t i = 0; i < first.views.size(); ++i) {
    const std::size_t t = i < horizon ? horizon - i : i - horizon;
    std::vector<double> row{first.views[i]};
    for (const Reading& reading : readings) {
      for (std::size_t k = 0; k <= times; ++k) {
        row.push_back(reading.curves.albedo[k][t]);
        row.push_back(reading.curves.peak[k][t]);
        for (const auto& radiance : reading.curves.radiance) row.push_back(radiance[k][i]);
      }
    }
    sheet.row(row);
  }
  return sheet.text();
}

/// The command that draws one quantity after 0 … 5 pumpings; the least pumped is in front.
std::string plot(const Reading& reading, const std::string& quantity) {
  std::string command = "plot ";
  for (int k = times; k >= 0; --k) {
    command += "data using 'theta':'" + column(reading, quantity, k) + "' with " + styles[static_cast<std::size_t>(k)];
    command += k > 0 ? ", \\\n     " : "\n";
  }
  return command;
}

std::string letter_label(int& panels) {
  return std::string("set label 1 '(") + static_cast<char>('a' + panels++) + ")' at graph 0, graph 1.07\n";
}

using Orders = std::vector<std::vector<double>>;

double largest(const Orders& orders) {
  double top = 0;
  for (const auto& order : orders) top = std::max(top, *std::ranges::max_element(order));
  return top;
}

std::string albedo_panel(const Reading& reading, int& panels) {
  return "\n# Albedo\n" + albedo_axes(1.12) + letter_label(panels) + plot(reading, "albedo") +
         "unset arrow 1\nunset label 2\n";
}

/// Axes of a radiance; the line is the largest one before pumping, with light at normal incidence.
std::string radiance_axes(const Reading& reading, const Orders& orders) {
  const double before = reading.curves.peak[0][0], most = std::max(largest(orders), before);
  const double step = most < 3 ? 0.5 : most < 9 ? 2 : 5;
  std::ostringstream out;
  out << "set yrange [0:" << step / 5 * std::ceil(1.06 * most / (step / 5)) << "]\nset ytics " << step
      << "\nset mytics 2\nset format y '%g'\n"
      << "set arrow 2 from graph 0, first " << before << " to graph 1, first " << before
      << " nohead linecolor rgb '#808080' linewidth 0.5 back\n";
  return out.str();
}

/// On a logarithmic scale where pumping raises it many times over.
std::string peak_panel(const Reading& reading, int& panels) {
  std::string gp = "\n# Largest output radiance\n" + radiance_axes(reading, reading.curves.peak) +
                   letter_label(panels) + "set ylabel 'largest output radiance [sr^{−1}]' offset 1 - letter, 0\n";
  if (largest(reading.curves.peak) > 10) {
    gp += "set logscale y\nset yrange [0.1:100]\nset ytics (0.1, 1, 10, 100)\nset mytics 10\n";
  }
  return gp + plot(reading, "peak") + "unset arrow 2\nunset logscale y\n";
}

std::string lobe_panel(const Reading& reading, std::size_t which, int& panels, bool titled) {
  std::string gp = "\n# Output radiance of light from one direction\n" +
                   radiance_axes(reading, reading.curves.radiance[which]) + letter_label(panels);
  gp += "set xrange [-45:90]\nset xtics 45\nset mxtics 3\n";
  gp += "set xlabel 'viewing angle {/:Italic θ}_{/:Italic V} [degrees]' offset 0, 1.3 - letter\n";
  const bool wide_numbers = largest(reading.curves.radiance[which]) < 3;
  gp += titled ? std::string("set ylabel 'output radiance [sr^{−1}]' offset ") + (wide_numbers ? "2" : "1") +
                     " - letter, 0\n"
               : "unset ylabel\n";
  const double incidence = reading.curves.incidences[which];
  const std::string angle = short_text(incidence);
  gp += "set label 3 '{/:Italic θ}_{/:Italic L} = " + angle + "°' at graph 0.06, graph 0.93\n";
  gp += "set arrow 3 from first " + angle + ", graph 0 to first " + angle +
        ", graph 0.04 nohead linecolor rgb '#808080' linewidth 1.5\n";
  return gp + plot(reading, radiance_at(incidence)) + "unset label 3\nunset arrow 3\nunset arrow 2\n";
}

std::string legend_of(double bottom, double height) {
  return legend(bottom, height, 2,
                {{styles[0], "original"},
                 {styles[1], "pumped once"},
                 {styles[2], "2 times"},
                 {styles[3], "3 times"},
                 {styles[4], "4 times"},
                 {styles[5], "5 times"}});
}

/// Albedo, largest radiance, and the radiance of three directions of light.
std::string script(const Reading& reading, std::string_view name) {
  int panels = 0;
  std::string gp = script_head(name, 17, 12.6) + "\nset multiplot\n" + legend_of(11.6, 0.9);
  gp += panel(1.3, 7, 6.7, 4) + albedo_panel(reading, panels);
  gp += panel(9.7, 7, 6.7, 4) + peak_panel(reading, panels);
  for (std::size_t i = 0; i < reading.curves.incidences.size(); ++i) {
    gp += panel(1.3 + 5.4 * static_cast<double>(i), 1.2, 4.3, 4);
    gp += lobe_panel(reading, i, panels, i == 0);
  }
  return gp + "unset multiplot\nunset output\n";
}

/// A row for each reading: albedo, largest radiance, and the radiance of one direction of light.
std::string script(const std::vector<Reading>& readings, std::string_view name) {
  int panels = 0;
  std::string gp = script_head(name, 17, 13.6) + "\nset multiplot\n" + legend_of(12.6, 0.9);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double bottom = 7.6 - 6.4 * static_cast<double>(i);
    const Reading& reading = readings[i];
    gp += std::string("\nset label 4 '") +
          (reading.control == PumpControl::step ? "Eq. 21 at every step"
                                                : "The product of all divisors at least max({/:Italic N}·{/:Italic L}, "
                                                  "{/:Italic N}·{/:Italic V})") +
          "' at graph 0, graph 1.2\n";
    gp += panel(1.3, bottom, 3.9, 4) + albedo_panel(reading, panels) + "unset label 4\n";
    gp += panel(7, bottom, 3.9, 4) + peak_panel(reading, panels);
    gp += panel(12.7, bottom, 3.9, 4) + lobe_panel(reading, reading.curves.incidences.size() - 1, panels, true);
  }
  return gp + "unset multiplot\nunset output\n";
}

}  // namespace

Drawing neumann_pumped(std::string_view name) {
  const Subject subject = subject_of(name);
  const auto model = make_model(subject.model, {{"n", exponent}});
  const std::vector<PumpControl> controls =
      subject.controlled ? std::vector{PumpControl::step, PumpControl::total} : std::vector{PumpControl::none};
  std::vector<Reading> readings;
  std::size_t unconverged = 0;
  for (const PumpControl control : controls) {
    const PumpOptions options{.times = times, .control = control, .tolerance = tolerance};
    readings.push_back({control, analysis::pumped_curves(*model, options, {30, 60, 80})});
    if (readings.back().curves.status != Status::converged) ++unconverged;
  }
  return {.data = data(readings, subject, name),
          .script = subject.controlled ? script(readings, name) : script(readings.front(), name),
          .unconverged = unconverged};
}

}  // namespace albedo::plots
