#include "geometry/height_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/counted_random.hpp"

namespace railstrata {
namespace {

using Kind = IrregularityKind;
constexpr double kPi = std::numbers::pi, kEndless = std::numeric_limits<double>::infinity();
constexpr int kWaves = 200;  // of a roughness: bands of equal ratio, one wave in the middle of each

SurfaceHeight operator*(double a, SurfaceHeight h) { return {a * h.z, a * h.along}; }

SurfaceHeight wave(double amplitude, double number, double x) {
  return {amplitude * std::cos(number * x), -amplitude * number * std::sin(number * x)};
}

SurfaceHeight cosine_hollow(double depth, double length, double x) {
  if (!(std::abs(x) < 0.5 * length)) return {};
  const SurfaceHeight h = wave(-0.5 * depth, 2 * kPi / length, x);
  return {h.z - 0.5 * depth, h.along};
}

/// From 0 to 1 over a length, from x = 0 on.
SurfaceHeight rise(double x, double length) {
  if (!(x > 0)) return {};
  if (!(x < length)) return {1, 0};
  const SurfaceHeight h = wave(-0.5, kPi / length, x);
  return {0.5 + h.z, h.along};
}

SurfaceHeight times(SurfaceHeight a, SurfaceHeight b) { return {a.z * b.z, a.along * b.z + a.z * b.along}; }

/// A wave that begins and ends within its stretch.
SurfaceHeight eased(const Irregularity& is, double x, double over, SurfaceHeight h) {
  if (is.from) h = times(h, rise(x - *is.from, over));
  if (is.to) {
    const SurfaceHeight end = rise(*is.to - x, over);
    h = times(h, {end.z, -end.along});
  }
  return h;
}

SurfaceHeight dip(const Irregularity& is, double x) {
  const double left = 1 - std::abs(x) / is.ramp, half = 0.5 * *is.angle, side = x < 0 ? -1 : 1;
  if (!(left > 0)) return {};
  if (is.shape == RampShape::line) return {-half * is.ramp * left, x == 0 ? 0 : side * half};
  return {-0.5 * half * is.ramp * left * left, x == 0 ? 0 : side * half * left};
}

SurfaceHeight flat(const Irregularity& is, double radius, double x) {
  if (is.depth) return cosine_hollow(*is.depth, *is.length, x);
  const double half = 0.5 * *is.length;
  if (!(std::abs(x) < half)) return {};
  return {-(half - x) * (half + x) / (2 * radius), x / radius};
}

double across(const Irregularity& is, double y) {
  if (!is.width) return 1;
  return std::abs(y) < 0.5 * *is.width ? 0.5 * (1 + std::cos(2 * kPi * y / *is.width)) : 0;
}

/// Mean with weights 1 + cos(2 pi d/length) of the points' shares of the way.
std::vector<double> smoothed(const std::vector<double>& x, const std::vector<double>& z, double length) {
  std::vector<double> out;
  const auto share = [&](std::size_t i) { return x[std::min(i + 1, x.size() - 1)] - x[i > 0 ? i - 1 : 0]; };
  for (std::size_t k = 0; k < x.size(); ++k) {
    double sum = 0, weights = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double d = x[i] - x[k];
      if (i != k && !(std::abs(d) < 0.5 * length)) continue;
      const double weight = share(i) * (1 + std::cos(2 * kPi * d / length));
      sum += weight * z[i];
      weights += weight;
    }
    out.push_back(weights > 0 ? sum / weights : z[k]);
  }
  return out;
}

/// Those of the parabolas through three points each; none beyond the ends.
std::vector<double> slopes(const std::vector<double>& x, const std::vector<double>& z) {
  std::vector<double> out(x.size(), 0.0);
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const double a = x[i] - x[i - 1], b = x[i + 1] - x[i];
    out[i] = ((z[i] - z[i - 1]) / a * b + (z[i + 1] - z[i]) / b * a) / (a + b);
  }
  return out;
}

}  // namespace

SurfaceHeight HeightField::Line::at(double at) const {
  if (!(at > x.front())) return {z.front(), 0};
  if (!(at < x.back())) return {z.back(), 0};
  const auto i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
  const double h = x[i] - x[i - 1], t = (at - x[i - 1]) / h, u = 1 - t;
  const double rise = z[i] - z[i - 1], a = h * slope[i - 1] - rise, b = rise - h * slope[i];
  return {u * z[i - 1] + t * z[i] + t * u * (a * u + b * t),
          (rise + (1 - 2 * t) * (a * u + b * t) + t * u * (b - a)) / h};
}

SurfaceHeight HeightField::Part::of_lines(double x, double y) const {
  const auto after =
      std::lower_bound(lines.begin(), lines.end(), y, [](const Line& line, double v) { return line.y < v; });
  if (after == lines.begin()) return lines.front().at(x);
  if (after == lines.end()) return lines.back().at(x);
  const Line& before = *(after - 1);
  const double t = (y - before.y) / (after->y - before.y);
  const SurfaceHeight a = before.at(x), b = after->at(x);
  return {(1 - t) * a.z + t * b.z, (1 - t) * a.along + t * b.along};
}

SurfaceHeight HeightField::Part::along(double x, double y) const {
  const double from_middle = x - is.at.value_or(0);
  switch (is.kind) {
    case Kind::indentation:
      return cosine_hollow(*is.depth, *is.length, from_middle);
    case Kind::corrugation:
      return eased(is, x, *is.wavelength, wave(0.5 * *is.depth, 2 * kPi / *is.wavelength, from_middle));
    case Kind::dip:
      return dip(is, from_middle);
    case Kind::step:
      return *is.height * rise(from_middle + 0.5 * *is.length, *is.length);
    case Kind::flat:
      return flat(is, wheel_radius, from_middle);
    case Kind::out_of_round:
      return wave(0.5 * *is.depth, is.order / wheel_radius, from_middle);
    case Kind::file:
      return of_lines(from_middle, y);
    case Kind::roughness:
      break;
  }
  SurfaceHeight sum;
  for (const Wave& w : waves) {
    const SurfaceHeight h = wave(w.amplitude, w.number, x + w.phase / w.number);
    sum = {sum.z + h.z, sum.along + h.along};
  }
  return eased(is, x, *is.longest, sum);
}

HeightField::HeightField(const std::vector<Irregularity>& all, BodyId on, double wheel_radius) {
  for (const Irregularity& is : all) {
    if (is.on != on) continue;
    Part part{is, wheel_radius, {}, {}};
    if (is.kind == Kind::roughness) {
      const double ratio = std::pow(*is.longest / *is.shortest, 1.0 / kWaves);
      double power = 0;
      for (int n = 0; n < kWaves; ++n) {
        const double k = 2 * kPi / *is.longest * std::pow(ratio, n + 0.5), band = std::pow(k, 1 - is.exponent);
        power += band;
        part.waves.push_back(
            {k, std::sqrt(2 * band),
             2 * kPi * uniform_number(mixed(static_cast<std::uint64_t>(is.seed)) + static_cast<std::uint64_t>(n))});
      }
      for (Wave& w : part.waves) w.amplitude *= *is.rms / std::sqrt(power);
    }
    for (std::size_t i = 0; i < is.z.size(); ++i) {
      const double y = is.y.empty() ? 0 : is.y[i];
      auto line =
          std::lower_bound(part.lines.begin(), part.lines.end(), y, [](const Line& l, double v) { return l.y < v; });
      if (line == part.lines.end() || line->y != y) line = part.lines.insert(line, Line{y, {}, {}, {}});
      const auto place = std::lower_bound(line->x.begin(), line->x.end(), is.x[i]) - line->x.begin();
      line->x.insert(line->x.begin() + place, is.x[i]);
      line->z.insert(line->z.begin() + place, is.z[i]);
    }
    for (Line& line : part.lines) {
      if (is.smoothing > 0) line.z = smoothed(line.x, line.z, is.smoothing);
      line.slope = slopes(line.x, line.z);
    }
    parts_.push_back(std::move(part));
  }
}

SurfaceHeight HeightField::at(double x, double y) const {
  SurfaceHeight sum;
  for (const Part& part : parts_) {
    double place = x;
    if (part.is.on == BodyId::wheel) {  // the turn that is nearest to it
      const Extent extent = extent_of(part.is);
      const double round = 2 * kPi * part.wheel_radius,
                   middle = std::isfinite(extent.to - extent.from) ? 0.5 * (extent.from + extent.to) : 0;
      place -= round * std::round((x - middle) / round);
    }
    const double aside = y - part.is.offset;
    const SurfaceHeight h = across(part.is, aside) * part.along(place, aside);
    sum = {sum.z + h.z, sum.along + h.along};
  }
  return sum;
}

Extent extent_of(const Irregularity& is) {
  const double at = is.at.value_or(0);
  double half = 0.5 * is.length.value_or(0);
  if (is.kind == Kind::dip) half = is.ramp;
  if (is.kind == Kind::file && !is.x.empty()) {
    const auto [first, last] = std::minmax_element(is.x.begin(), is.x.end());
    return {at + *first, at + *last};
  }
  if (is.kind == Kind::corrugation || is.kind == Kind::roughness)
    return {is.from.value_or(-kEndless), is.to.value_or(kEndless)};
  if (is.kind == Kind::out_of_round) return {-kEndless, kEndless};
  return {at - half, at + half};
}

double shortest_wave(const Irregularity& is, double wheel_radius) {
  switch (is.kind) {
    case Kind::corrugation:
      return *is.wavelength;
    case Kind::dip:
      return is.ramp;
    case Kind::step:
      return 2 * *is.length;
    case Kind::out_of_round:
      return 2 * kPi * wheel_radius / is.order;
    case Kind::roughness:
      return *is.shortest;
    case Kind::file:
      return kEndless;
    case Kind::indentation:
    case Kind::flat:
      break;
  }
  return *is.length;
}

double steepest_slope(const Irregularity& is, double wheel_radius) {
  switch (is.kind) {
    case Kind::indentation:
      return kPi * *is.depth / *is.length;
    case Kind::corrugation:
      return kPi * *is.depth / *is.wavelength;
    case Kind::dip:
      return 0.5 * *is.angle;
    case Kind::step:
      return 0.5 * kPi * std::abs(*is.height) / *is.length;
    case Kind::flat:
      return is.depth ? kPi * *is.depth / *is.length : 0.5 * *is.length / wheel_radius;
    case Kind::out_of_round:
      return 0.5 * *is.depth * is.order / wheel_radius;
    case Kind::roughness:
    case Kind::file:
      break;
  }
  constexpr int kSamples = 4000, kLongestWaves = 20;
  Irregularity on_rail = is;
  on_rail.on = BodyId::rail;
  const HeightField field({on_rail}, BodyId::rail, wheel_radius);
  Extent range = extent_of(is);
  if (is.kind == Kind::roughness) {
    if (!std::isfinite(range.from)) range.from = std::isfinite(range.to) ? range.to - kLongestWaves * *is.longest : 0;
    range.to = std::min(range.to, range.from + kLongestWaves * *is.longest);
  }
  double most = 0;
  std::vector<double> rows = is.y.empty() ? std::vector<double>{0.0} : is.y;
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  for (const double y : rows)
    for (int k = 0; k <= kSamples; ++k)
      most =
          std::max(most, std::abs(field.at(range.from + (range.to - range.from) * k / kSamples, is.offset + y).along));
  return most;
}

double contact_reach(const std::vector<Irregularity>& irregularities, double wheel_radius) {
  double out = 0;
  for (const Irregularity& is : irregularities) {
    const Extent extent = extent_of(is);
    const double most =
        is.kind == Kind::step ? std::sqrt(2 * wheel_radius * std::abs(*is.height)) : 0.5 * (extent.to - extent.from);
    out += std::min(wheel_radius * steepest_slope(is, wheel_radius), most);
  }
  return out;
}

}  // namespace railstrata
