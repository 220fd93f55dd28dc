/// @file
/// The program `albedo-figures`.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <exception>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "albedo/core/errors.hpp"
#include "albedo/version.hpp"
#include "plots/figures/figure.hpp"

namespace {

using albedo::ParameterError;
using albedo::plots::Figure;
using albedo::plots::Format;

enum ExitCode : int { done = 0, wrong_usage = 2, tolerance_missed = 3, not_written = 4 };

struct Arguments {
  std::vector<std::string> names;
  std::vector<std::string> formats;
  std::string directory = ".";
  bool all = false, list = false, data_only = false;
};

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("name", arguments.names, "Figures to draw; --list shows which there are")->type_name("NAME");
  app.add_flag("--all", arguments.all, "Draw every figure");
  app.add_flag("--list", arguments.list, "List the figures and draw none");
  app.add_option("-o,--output", arguments.directory,
                 "Directory for the files, made if need be (default: the current one)")
      ->type_name("DIR");
  app.add_option("--format", arguments.formats, "pdf (the default), png or svg; may be given several times")
      ->type_name("FORMAT")
      ->allow_extra_args(false);
  app.add_flag("--data-only", arguments.data_only, "Write the data and the gnuplot script, but draw nothing");
  app.set_version_flag("--version", "albedo-figures " + std::string(albedo::version));
  app.footer(
      "Every figure is written as NAME.csv, NAME.gp and the pictures NAME.pdf, NAME.png, NAME.svg.\n"
      "kurt-1 shows the measured materials (.bsdf, .binary) of the directory that ALBEDO_MEASURED_DIR names; --all\n"
      "leaves it out without them.\n"
      "Example: albedo-figures neumann-1 --output out --format pdf --format png");
}

std::vector<Figure> chosen_figures(const Arguments& arguments) {
  std::vector<Figure> chosen;
  for (const std::string& name : arguments.names) {
    const Figure& figure = albedo::plots::find_figure(name);
    if (std::ranges::find(chosen, figure.name, &Figure::name) == chosen.end()) chosen.push_back(figure);
  }
  if (arguments.all) return albedo::plots::figures();
  if (chosen.empty()) throw ParameterError("no figure is named; give a NAME, --all, or --list to see them");
  return chosen;
}

std::vector<Format> chosen_formats(const Arguments& arguments) {
  std::vector<Format> chosen;
  for (const std::string& text : arguments.formats) {
    const Format format = albedo::plots::parse_format(text);
    if (std::ranges::find(chosen, format) == chosen.end()) chosen.push_back(format);
  }
  if (arguments.data_only) return {};
  if (chosen.empty()) chosen.push_back(Format::pdf);
  return chosen;
}

void list_figures() {
  std::size_t width = 0;
  for (const Figure& figure : albedo::plots::figures()) width = std::max(width, figure.name.size());
  for (const Figure& figure : albedo::plots::figures()) {
    std::cout << std::left << std::setw(static_cast<int>(width) + 2) << figure.name << figure.title << '\n';
  }
}

/// Says on standard error which of several figures is done, and on a terminal which one is being made.
class Progress {
 public:
  explicit Progress(std::size_t total) : total_(total), is_terminal_(::isatty(STDERR_FILENO) == 1) {}

  void begin(std::string_view name) {
    ++number_;
    begin_ = Clock::now();
    if (is_wanted() && is_terminal_) std::cerr << place() << name << " ..." << std::flush;
  }
  void end(std::string_view name) const {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    std::ostringstream text;
    text << std::fixed << std::setprecision(1) << seconds << " s";
    say(std::string(name) + ": " + text.str());
  }
  void skip(std::string_view name, const std::string& why) const {
    say(std::string(name) + ": skipped, it needs " + why);
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool is_wanted() const { return total_ > 1; }
  [[nodiscard]] std::string place() const {
    return "[" + std::to_string(number_) + "/" + std::to_string(total_) + "] ";
  }
  void say(const std::string& text) const {
    if (is_wanted()) std::cerr << (is_terminal_ ? "\r\x1b[K" : "") << place() << text << '\n' << std::flush;
  }

  std::size_t total_, number_ = 0;
  bool is_terminal_;
  Clock::time_point begin_{};
};

ExitCode run(const Arguments& arguments) {
  if (arguments.list) {
    list_figures();
    return done;
  }
  const std::vector<Figure> figures = chosen_figures(arguments);
  const std::vector<Format> formats = chosen_formats(arguments);
  ExitCode code = done;
  Progress progress(figures.size());
  for (const Figure& figure : figures) {
    progress.begin(figure.name);
    // who asks for all of them asks for those that can be made here
    const std::string lacking = arguments.all && figure.lacks != nullptr ? figure.lacks() : "";
    if (!lacking.empty()) {
      progress.skip(figure.name, lacking);
      continue;
    }
    const std::size_t unconverged = albedo::plots::write_figure(figure, arguments.directory, formats);
    progress.end(figure.name);
    if (unconverged == 0) continue;
    std::cerr << "albedo-figures: " << figure.name << ": " << unconverged << " numbers did not reach their tolerance\n";
    code = tolerance_missed;
  }
  return code;
}

int fail(ExitCode code, const std::exception& error) {
  std::cerr << "albedo-figures: " << error.what() << '\n';
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    CLI::App app("Draws the figures of albedo, each with its data and its gnuplot script.", "albedo-figures");
    Arguments arguments;
    declare(app, arguments);
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& asked_for_help) {
      return app.exit(asked_for_help);
    } catch (const CLI::ParseError& error) {
      return fail(wrong_usage, error);
    }
    return run(arguments);
  } catch (const albedo::WriteError& error) {
    return fail(not_written, error);
  } catch (const albedo::Error& error) {
    return fail(wrong_usage, error);
  } catch (const std::exception& error) {
    return fail(not_written, error);
  }
}
