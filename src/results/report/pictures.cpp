#include "report/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "record/unit.hpp"
#include "report/svg_page.hpp"
#include "result/patch.hpp"

namespace railstrata {
namespace {

constexpr int kMapPoints = 72;
constexpr const char* kColourA = "#0b5fa5";
constexpr const char* kColourB = "#c2410c";

struct Rgb {
  double r, g, b;
};
constexpr std::array<Rgb, 5> kPressureColours{
    {{255, 255, 255}, {166, 206, 227}, {66, 146, 198}, {8, 81, 156}, {3, 19, 67}}};
constexpr std::array<Rgb, 5> kDifferenceColours{
    {{11, 95, 165}, {146, 197, 222}, {255, 255, 255}, {244, 165, 130}, {194, 65, 12}}};

std::string colour(const std::array<Rgb, 5>& stops, double t) {
  const double s = std::clamp(t, 0.0, 1.0) * 4;
  const auto k = std::min<std::size_t>(static_cast<std::size_t>(s), 3);
  const double w = s - static_cast<double>(k);
  const auto mix = [&](double u, double v) { return static_cast<int>(std::lround(u + w * (v - u))); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(stops[k].r, stops[k + 1].r), mix(stops[k].g, stops[k + 1].g),
                     mix(stops[k].b, stops[k + 1].b));
}

std::vector<double> scaled(const std::vector<double>& v, double factor) {
  std::vector<double> out(v);
  for (double& x : out) x *= factor;
  return out;
}

double largest(const std::vector<double>& v) { return v.empty() ? 0 : *std::max_element(v.begin(), v.end()); }

void draw_centre_line(SvgPage& page, const SvgFrame& f, const PictureSide& side, const char* stroke) {
  const CentreLine line = centre_line(side.field);
  std::vector<double> q;
  for (std::size_t i = 0; i < line.q_x.size(); ++i) q.push_back(kToMega * std::hypot(line.q_x[i], line.q_y[i]));
  page.line(f, scaled(line.x, kToMilli), scaled(line.p, kToMega), stroke, false);
  page.line(f, scaled(line.x, kToMilli), q, stroke, true);
}

void draw_map(SvgPage& page, const SvgFrame& f, const FieldComparison& g, const std::array<Rgb, 5>& stops,
              const std::vector<double>& shade) {
  const int nx = static_cast<int>(g.x.size()), ny = static_cast<int>(g.y.size()),
            sx = (nx + kMapPoints - 1) / kMapPoints, sy = (ny + kMapPoints - 1) / kMapPoints;
  const double w = sx * f.width / (nx - 1), h = sy * f.height / (ny - 1);
  for (int i = 0; i < nx; i += sx)
    for (int j = 0; j < ny; j += sy) {
      const std::size_t k = static_cast<std::size_t>(i) * g.y.size() + static_cast<std::size_t>(j);
      if (!(g.p_a[k] > 0 || g.p_b[k] > 0)) continue;
      page.add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
               f.px(kToMilli * g.x[i]) - w / 2, f.py(kToMilli * g.y[j]) - h / 2, w + 0.2, h + 0.2,
               colour(stops, shade[k]));
    }
}

void draw_maps(SvgPage& page, double top, double width, const PictureSide& a, const PictureSide& b,
               const FieldComparison& g) {
  const double p = std::max(largest(g.p_a), largest(g.p_b));
  std::vector<double> gap;
  double reach = 1;  // Pa
  for (std::size_t k = 0; k < g.p_a.size(); ++k) reach = std::max(reach, std::abs(g.p_a[k] - g.p_b[k]));
  for (std::size_t k = 0; k < g.p_a.size(); ++k) gap.push_back(0.5 + 0.5 * (g.p_a[k] - g.p_b[k]) / reach);
  const double x0 = kToMilli * g.x.front(), x1 = kToMilli * g.x.back(), y0 = kToMilli * g.y.front(),
               y1 = kToMilli * g.y.back();
  const double height = width * (y1 - y0) / (x1 - x0);
  const auto frame = [&](int k) { return SvgFrame{60 + k * (width + 60), top, width, height, x0, x1, y0, y1}; };
  draw_map(page, frame(0), g, kPressureColours, scaled(g.p_a, 1 / p));
  draw_map(page, frame(1), g, kPressureColours, scaled(g.p_b, 1 / p));
  draw_map(page, frame(2), g, kDifferenceColours, gap);
  page.axes(frame(0), "x [mm], rolling to the right",
            fmt::format("p of {}: 0 to {:.0f} MPa, y [mm]", a.name, kToMega * p));
  page.axes(frame(1), "x [mm]", fmt::format("p of {}, same colours", b.name));
  page.axes(frame(2), "x [mm]", fmt::format("difference: -{0:.0f} (blue) to {0:.0f} MPa (red)", kToMega * reach));
}

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

std::string comparison_svg(const PictureSide& a, const PictureSide& b, const FieldComparison& g) {
  const double map = 270, aspect = (g.y.back() - g.y.front()) / (g.x.back() - g.x.front());
  SvgPage page(1060, 400 + map * aspect + 60);
  const SvgFrame lines{60,
                       50,
                       930,
                       280,
                       kToMilli * g.x.front(),
                       kToMilli * g.x.back(),
                       0,
                       1.08 * kToMega * std::max({largest(g.p_a), largest(g.p_b), 1.0})};
  page.axes(lines, "x [mm] from the axle, rolling to the right",
            "p (lines) and |q| (dashed) through the largest pressure [MPa]");
  draw_centre_line(page, lines, a, kColourA);
  draw_centre_line(page, lines, b, kColourB);
  page.text(lines.left + 10, lines.top + 18, a.name, "start", kColourA);
  page.text(lines.left + 10, lines.top + 35, b.name, "start", kColourB);
  draw_maps(page, 400, map, a, b, g);
  return page.finish();
}

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
