#include "plots/figures/gnuplot.hpp"

#include <gnuplot-iostream.h>

#include <algorithm>
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
      << std::showpoint  // gnuplot's quotients of whole numbers are whole
      << "width = " << width_cm << "  # cm\nheight = " << height_cm << std::noshowpoint << R"(
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

std::string panel(double left, double bottom, double width, double height) {
  std::ostringstream out;
  out << "set lmargin at screen " << left << "/width\nset rmargin at screen " << left + width
      << "/width\nset bmargin at screen " << bottom << "/height\nset tmargin at screen " << bottom + height
      << "/height\n";
  return out.str();
}

namespace {

/// How many letters a text of gnuplot's enhanced mode shows, near enough.
int letters_of(const std::string& text) {
  int count = 0;
  bool markup = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '{' && text.compare(i, 2, "{/") == 0) markup = true;
    const bool first_byte = (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    if (!markup && first_byte && std::string_view("{}_^\\").find(c) == std::string_view::npos) ++count;
    if (c == ' ') markup = false;
  }
  return count;
}

}  // namespace

std::string legend(double bottom, double height, int rows, const std::vector<LegendEntry>& entries) {
  int longest = 0;
  for (const LegendEntry& entry : entries) longest = std::max(longest, letters_of(entry.title));
  std::ostringstream out;
  out << "# One legend for all panels.\nset lmargin at screen 0\nset rmargin at screen 1\nset bmargin at screen "
      << bottom << "/height\nset tmargin at screen " << bottom + height
      << "/height\nunset border\nunset tics\nset xrange [0:1]\n"
      << "set yrange [0:1]\nset key center center vertical maxrows " << rows
      << " Left reverse samplen 3.5 spacing letter \\\n"
      << "  width format eq 'svg' ? 1 : 2.5 - " << longest
      << "*0.28  # the terminals of cairo think text half as long again\nplot ";
  for (std::size_t i = 0; i < entries.size(); ++i) {
    out << (i == 0 ? "" : ", \\\n     ") << "NaN with " << entries[i].style << " title '" << entries[i].title << "'";
  }
  out << "\nunset key\n" << axes_style;
  return out.str();
}

std::string albedo_axes(double top) {
  std::ostringstream out;
  out << "set yrange [0:" << top << R"(]
set xrange [0:90]
set xtics 15 offset 0, 0.8 * (1 - letter)
set mxtics 3
set ytics 0.2
set mytics 2
set format y '%.1f'
set xlabel 'angle of incidence {/:Italic θ}_{/:Italic L} [degrees]' offset 0, 1.3 - letter
set ylabel 'directional albedo {/:Italic a}({/:Italic L})' offset 2 - letter, 0
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead linecolor rgb '#808080' linewidth 0.5 back
set label 2 '{/:Italic a} = 1' at graph 0.03, first 1 offset 0, 0.5
)";
  return out.str();
}

}  // namespace albedo::plots
