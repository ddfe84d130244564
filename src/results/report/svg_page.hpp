#pragma once
// Pictures as SVG: a page, frames with axes on it, lines and words in them.
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "record/escaped_text.hpp"

namespace railstrata {

/// 1, 2 or 5 times a power of ten: about five of them fill the length.
inline double tick_step(double length) {
  const double raw = length / 5, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (double m : {1.0, 2.0, 5.0})
    if (raw <= m * power) return m * power;
  return 10 * power;
}

/// A rectangle of the page with its axes: x and y in the units of the labels.
struct SvgFrame {
  double left, top, width, height;
  double x0, x1, y0, y1;
  double px(double x) const { return left + width * (x - x0) / (x1 - x0); }
  double py(double y) const { return top + height * (y1 - y) / (y1 - y0); }
};

/// A page of shapes and words, top down, in pixels.
class SvgPage {
 public:
  SvgPage(double width, double height) {
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" "
        "font-family=\"sans-serif\" font-size=\"12\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        width, height);
  }
  template <class... T>
  void add(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<T>(values)...);
  }
  void text(double x, double y, const std::string& words, const char* anchor = "start", const char* fill = "#222") {
    add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n", x, y, anchor, fill,
        markup_text(words));
  }
  void axes(const SvgFrame& f, const std::string& x_label, const std::string& y_label) {
    add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#888\"/>\n", f.left,
        f.top, f.width, f.height);
    const double dx = tick_step(f.x1 - f.x0), dy = tick_step(f.y1 - f.y0);
    for (double k = std::ceil(f.x0 / dx); k * dx <= f.x1; ++k)
      text(f.px(k * dx), f.top + f.height + 15, fmt::format("{:g}", k * dx + 0.0), "middle");
    for (double k = std::ceil(f.y0 / dy); k * dy <= f.y1; ++k)
      text(f.left - 5, f.py(k * dy) + 4, fmt::format("{:g}", k * dy + 0.0), "end");
    text(f.left + f.width / 2, f.top + f.height + 32, x_label, "middle");
    text(f.left, f.top - 8, y_label);
  }
  void line(const SvgFrame& f, const std::vector<double>& x, const std::vector<double>& y, const char* stroke,
            bool dashed) {
    std::string points;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (x[i] >= f.x0 && x[i] <= f.x1)
        fmt::format_to(std::back_inserter(points), "{:.1f},{:.1f} ", f.px(x[i]), f.py(y[i]));
    add("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"{}/>\n", points, stroke,
        dashed ? " stroke-dasharray=\"5 3\"" : "");
  }
  std::string finish() {
    add("</svg>\n");
    return std::move(out_);
  }

 private:
  std::string out_;
};

}  // namespace railstrata
