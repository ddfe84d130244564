#include "report/plots.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "report/svg_page.hpp"

namespace railstrata {
namespace {

constexpr std::array kColours{"#0b5fa5", "#c2410c", "#3f7d20", "#7b3fa0", "#b58900", "#555555"};
constexpr double kWidth = 420, kHeight = 320, kLeft = 70, kTop = 70, kGap = 90, kLine = 17;

struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void take(const std::vector<double>& values) {
    for (const double v : values) {
      low = std::min(low, v);
      high = std::max(high, v);
    }
  }
  /// With a margin; never empty.
  Span wider() const {
    if (!(low <= high)) return {0, 1};
    const double margin = high > low ? 0.05 * (high - low) : std::max(0.5 * std::abs(low), 1e-12);
    return {low - margin, high + margin};
  }
};

void draw(SvgPage& page, double left, const Plot& plot) {
  Span x, y;
  for (const PlotCurve& c : plot.curves) {
    x.take(c.x);
    y.take(c.y);
  }
  x = x.wider();
  y = y.wider();
  const SvgFrame frame{left, kTop, kWidth, kHeight, x.low, x.high, y.low, y.high};
  page.axes(frame, plot.x_label, plot.y_label);
  for (std::size_t k = 0; k < plot.curves.size(); ++k) {
    const PlotCurve& c = plot.curves[k];
    const char* const colour = kColours[k % kColours.size()];
    if (c.points)
      for (std::size_t i = 0; i < c.x.size(); ++i)
        page.add("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"{}\"/>\n", frame.px(c.x[i]), frame.py(c.y[i]),
                 colour);
    else
      page.line(frame, c.x, c.y, colour, false);
    page.text(left + 10, kTop + kLine * (static_cast<double>(k) + 1), c.name, "start", colour);
  }
}

}  // namespace

std::string plots_svg(const std::string& title, const std::vector<Plot>& plots,
                      const std::vector<std::string>& remarks) {
  SvgPage page(kLeft + static_cast<double>(plots.size()) * (kWidth + kGap),
               kTop + kHeight + 60 + kLine * static_cast<double>(remarks.size()));
  page.text(kLeft, 25, title);
  for (std::size_t k = 0; k < plots.size(); ++k) draw(page, kLeft + static_cast<double>(k) * (kWidth + kGap), plots[k]);
  for (std::size_t k = 0; k < remarks.size(); ++k)
    page.text(kLeft, kTop + kHeight + 60 + kLine * static_cast<double>(k), remarks[k]);
  return page.finish();
}

}  // namespace railstrata
