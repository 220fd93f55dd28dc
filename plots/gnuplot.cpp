#include "plots/gnuplot.hpp"

#include <gnuplot-iostream.h>

#include <array>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <system_error>

#include "albedo/core/errors.hpp"

namespace albedo::plots {
namespace {

namespace fs = std::filesystem;

WriteError cannot_draw(const std::string& name, const std::string& reason) {
  return WriteError("cannot draw '" + name + "': " + reason);
}

/// A directory of its own for one figure, removed in the end.
class Workshop {
 public:
  explicit Workshop(std::string name) : name_(std::move(name)) {
    std::error_code failure;
    std::string pattern = (fs::temp_directory_path(failure) / "albedo-figures-XXXXXX").string();
    if (failure || ::mkdtemp(pattern.data()) == nullptr) {
      throw cannot_draw(name_, "no temporary directory can be made (TMPDIR chooses where)");
    }
    directory_ = pattern;
  }
  ~Workshop() {
    std::error_code ignored;
    fs::remove_all(directory_, ignored);
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  [[nodiscard]] std::string path(const std::string& file) const { return (directory_ / file).string(); }

  void write(const std::string& file, const std::string& content) const {
    std::ofstream stream(path(file), std::ios::binary);
    stream << content;
    stream.close();
    if (!stream) throw cannot_draw(name_, "the temporary file '" + path(file) + "' can't be written");
  }

  /// The file's bytes; empty if there is none.
  [[nodiscard]] std::string read(const std::string& file) const {
    std::ifstream stream(path(file), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  std::string name_;
  fs::path directory_;
};

/// While it lives, a gnuplot that ends early is an error to report instead of a signal that ends this program.
class IgnoreBrokenPipe {
 public:
  IgnoreBrokenPipe() : before_(std::signal(SIGPIPE, SIG_IGN)) {}
  ~IgnoreBrokenPipe() { static_cast<void>(std::signal(SIGPIPE, before_)); }
  IgnoreBrokenPipe(const IgnoreBrokenPipe&) = delete;
  IgnoreBrokenPipe& operator=(const IgnoreBrokenPipe&) = delete;

 private:
  void (*before_)(int);
};

/// The text between quotes for the shell, or for gnuplot.
std::string quoted(const std::string& text, const std::string& inner_quote) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? inner_quote : std::string(1, c);
  return result += "'";
}

std::string for_shell(const std::string& text) { return quoted(text, "'\\''"); }
std::string for_gnuplot(const std::string& text) { return quoted(text, "''"); }

/// The shell command behind the pipe. It keeps what gnuplot says and its exit code, which gnuplot-iostream throws away.
std::string command(const Workshop& workshop) {
  return "TZ=UTC gnuplot --default-settings 2>" + for_shell(workshop.path("messages")) + "; echo $? >" +
         for_shell(workshop.path("exit_code"));
}

/// The last line that says something: gnuplot's own errors come after the line they are about.
std::string last_line(const std::string& messages) {
  std::istringstream stream(messages);
  std::string last;
  for (std::string line; std::getline(stream, line);) {
    if (line.find_first_not_of(" \t^") != std::string::npos) last = line;
  }
  return last.empty() ? "no message" : last;
}

/// The date that a picture is said to be from, as 14 digits: SOURCE_DATE_EPOCH (seconds), or the beginning of 1970.
std::string source_date() {
  const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
  std::time_t seconds = 0;
  if (epoch != nullptr) {
    const auto read = std::from_chars(epoch, epoch + std::strlen(epoch), seconds);
    if (read.ec != std::errc() || *read.ptr != '\0') seconds = 0;
  }
  std::array<char, 15> digits{};
  std::tm utc{};
  const bool fits = ::gmtime_r(&seconds, &utc) != nullptr &&
                    std::strftime(digits.data(), digits.size(), "%Y%m%d%H%M%S", &utc) == digits.size() - 1;
  return fits ? digits.data() : "19700101000000";
}

/// Cairo 1.16 writes the time of day into a PDF; this date is as long, so that no offset in the file changes.
void set_date(std::string& pdf) {
  constexpr std::string_view key = "/CreationDate (D:";
  const std::size_t place = pdf.rfind(key);
  if (place != std::string::npos) pdf.replace(place + key.size(), 14, source_date());
}

/// Some readers of SVG drop the blanks at the ends of a text's parts unless they are told to keep them.
void keep_blanks(std::string& svg) {
  constexpr std::string_view plain = "<text>", keeping = "<text xml:space=\"preserve\">";
  for (std::size_t place = 0; (place = svg.find(plain, place)) != std::string::npos; place += keeping.size()) {
    svg.replace(place, plain.size(), keeping);
  }
}

/// Runs gnuplot over the workshop's script; throws unless the picture is there.
std::string draw(const Workshop& workshop, const std::string& name, const std::string& format) {
  {
    const IgnoreBrokenPipe ignore_broken_pipe;
    Gnuplot gnuplot(command(workshop));
    gnuplot << "cd " << for_gnuplot(workshop.path("")) << "\nformat = '" << format << "'\nload "
            << for_gnuplot(name + ".gp") << '\n';
  }  // closes the pipe and waits for gnuplot

  const std::string exit_code = workshop.read("exit_code");
  const std::string messages = workshop.read("messages");
  if (exit_code == "127\n")
    throw cannot_draw(name, "gnuplot was not found; install it, or draw nothing with --data-only");
  if (exit_code != "0\n") throw cannot_draw(name, "gnuplot failed: " + last_line(messages));
  std::string picture = workshop.read(name + "." + format);
  if (picture.empty()) throw cannot_draw(name, "gnuplot made no " + format + ": " + last_line(messages));
  std::cerr << messages;
  if (format == "pdf") set_date(picture);
  if (format == "svg") keep_blanks(picture);
  return picture;
}

}  // namespace

std::vector<std::string> draw_with_gnuplot(const std::string& name, const Drawing& drawing,
                                           const std::vector<Format>& formats) {
  const Workshop workshop(name);
  workshop.write(name + ".csv", drawing.data);
  workshop.write(name + ".gp", drawing.script);
  for (const Attachment& attachment : drawing.attachments) {
    workshop.write(name + "-" + attachment.suffix, attachment.bytes);
  }
  std::vector<std::string> pictures;
  pictures.reserve(formats.size());
  for (const Format format : formats) pictures.push_back(draw(workshop, name, std::string(to_string(format))));
  return pictures;
}

std::string script_head(std::string_view name, double width_cm, double height_cm) {
  std::ostringstream out;
  out << "# Draws " << name << ".csv. In its directory: gnuplot " << name << ".gp\n"
      << "# or, for another format:      gnuplot -e \"format='png'\" " << name << ".gp     (pdf, png or svg)\n"
      << "width = " << width_cm << "  # cm\nheight = " << height_cm << R"(
if (!exists("format")) format = 'pdf'
if (format eq 'pdf') {
  set terminal pdfcairo size width*1cm, height*1cm font 'DejaVu Sans,9' fontscale 0.75 linewidth 1.25 dashlength 0.9
} else { if (format eq 'png') {
  # 300 dots an inch
  set terminal pngcairo size width/2.54*300, height/2.54*300 font 'DejaVu Sans,9' fontscale 3.125 linewidth 2.6 dashlength 0.9
} else {
  # 96 units an inch, as in CSS
  set terminal svg size width/2.54*96, height/2.54*96 font 'DejaVu Sans,12' linewidth 0.83 dashlength 0.9 background 'white'
} }
# gnuplot's svg terminal thinks its letters taller than they are
letter = format eq 'svg' ? 0.65 : 1
set encoding utf8
set output ')"
      << name << R"('.'.'.format

set datafile separator comma
set datafile columnheaders
set linetype 1 linecolor rgb '#0072B2' linewidth 1.6 dashtype solid
set linetype 2 linecolor rgb '#D55E00' linewidth 1.6 dashtype (12, 4)
set linetype 3 linecolor rgb '#009E73' linewidth 1.6 dashtype (12, 3, 2, 3)
set linetype 4 linecolor rgb '#CC79A7' linewidth 2.0 dashtype (2, 2.5)
set linetype 5 linecolor rgb '#E69F00' linewidth 2.4 dashtype solid
set linetype 6 linecolor rgb '#56B4E9' linewidth 2.4 dashtype (6, 3)
set linetype 7 linecolor rgb '#000000' linewidth 1.0 dashtype solid
data = ')"
      << name << R"(.csv'
)";
  return out.str();
}

const std::string_view axes_style = R"(
set border 3 linewidth 0.6 linecolor rgb '#000000'
set xtics nomirror out scale 0.6, 0.3
set ytics nomirror out scale 0.6, 0.3
set format x '%g'
)";

}  // namespace albedo::plots
