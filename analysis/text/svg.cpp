#include "analysis/text/svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace albedo::analysis {
namespace {

constexpr double width = 460, height = 290, left = 62, right = 14, top = 30, bottom = 46;

/// Pixels with two decimals.
std::string px(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

std::string label(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", std::abs(value) < 1e-12 ? 0 : value);
  return text.data();
}

/// 1, 2 or 5 times a power of ten: a step that divides a range into about five.
double tick_step(double range) {
  const double rough = range / 5, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) return factor * power;
  }
  return 10 * power;
}

class Drawing {
 public:
  explicit Drawing(const Chart& chart) : chart_(chart) {}

  std::string text() {
    out_ = "<svg class=\"chart\" viewBox=\"0 0 " + px(width) + ' ' + px(height) + "\" role=\"img\" width=\"" +
           px(width) + "\" height=\"" + px(height) + "\"><title>" + escaped(chart_.title) + "</title>\n";
    frame();
    if (!chart_.band_low.empty()) {
      ChartPoints around = chart_.band_low;
      around.insert(around.end(), chart_.band_high.rbegin(), chart_.band_high.rend());
      out_ += "<polygon class=\"band\" points=\"" + points(around) + "\"/>\n";
    }
    for (const Chart::Line& line : chart_.lines) {
      out_ += "<polyline class=\"" + line.style + "\" points=\"" + points(line.points) + "\"/>\n";
    }
    for (const auto& [x, y] : chart_.dots) {
      if (std::isfinite(y)) {
        out_ += "<circle class=\"node\" cx=\"" + px(place_x(x)) + "\" cy=\"" + px(place_y(y)) + "\" r=\"3.5\"/>\n";
      }
    }
    return out_ + "</svg>\n";
  }

 private:
  [[nodiscard]] double place_x(double x) const {
    return left + (width - left - right) * (x - chart_.x_low) / (chart_.x_high - chart_.x_low);
  }
  [[nodiscard]] double place_y(double y) const {
    const double t = (std::clamp(y, chart_.y_low, chart_.y_high) - chart_.y_low) / (chart_.y_high - chart_.y_low);
    return height - bottom - (height - top - bottom) * t;
  }
  [[nodiscard]] std::string points(const ChartPoints& all) const {
    std::string text;
    for (const auto& [x, y] : all) {
      if (!std::isnan(y)) text += px(place_x(x)) + ',' + px(place_y(y)) + ' ';
    }
    return text;
  }

  void write(double x, double y, const std::string& anchor, const std::string& what, const std::string& more = "") {
    out_ += "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" + anchor + "\"" + more + '>' +
            escaped(what) + "</text>\n";
  }

  void frame() {
    const double floor = height - bottom;
    write(left, 18, "start", chart_.title, " class=\"title\"");
    const double step_x = tick_step(chart_.x_high - chart_.x_low), step_y = tick_step(chart_.y_high - chart_.y_low);
    for (double x = std::ceil(chart_.x_low / step_x) * step_x; x <= chart_.x_high * (1 + 1e-9); x += step_x) {
      grid(place_x(x), top, place_x(x), floor);
      write(place_x(x), floor + 16, "middle", label(x));
    }
    for (double y = std::ceil(chart_.y_low / step_y) * step_y; y <= chart_.y_high * (1 + 1e-9); y += step_y) {
      grid(left, place_y(y), width - right, place_y(y));
      write(left - 6, place_y(y) + 4, "end", label(y));
    }
    write((left + width - right) / 2, height - 8, "middle", chart_.x_label);
    const double middle = (top + floor) / 2;
    write(14, middle, "middle", chart_.y_label, " transform=\"rotate(-90 14 " + px(middle) + ")\"");
  }

  void grid(double x1, double y1, double x2, double y2) {
    out_ += "<line class=\"grid\" x1=\"" + px(x1) + "\" y1=\"" + px(y1) + "\" x2=\"" + px(x2) + "\" y2=\"" + px(y2) +
            "\"/>\n";
  }

  const Chart& chart_;
  std::string out_;
};

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? ' ' : c;
    }
  }
  return result;
}

std::string svg(const Chart& chart) { return Drawing(chart).text(); }

}  // namespace albedo::analysis
