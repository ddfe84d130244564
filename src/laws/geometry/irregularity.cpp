#include "geometry/irregularity.hpp"

#include <algorithm>
#include <cstdint>

#include "core/counted_random.hpp"

namespace railstrata {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kWaves = 200;  // of a roughness: bands of equal ratio, one wave in the middle of each

SurfaceHeight times(SurfaceHeight a, SurfaceHeight b) { return {a.z * b.z, a.along * b.z + a.z * b.along}; }

struct HeightWave {
  double number, amplitude, phase;  // rad/m, m, rad
};

double random_phase(int seed, int wave) {
  return 2 * kPi * uniform_number(mixed(static_cast<std::uint64_t>(seed)) + static_cast<std::uint64_t>(wave));
}

std::vector<HeightWave> waves_of(const Roughness& r) {
  std::vector<HeightWave> out;
  const double ratio = std::pow(*r.longest / *r.shortest, 1.0 / kWaves);
  double power = 0;
  for (int n = 0; n < kWaves; ++n) {
    const double k = 2 * kPi / *r.longest * std::pow(ratio, n + 0.5), band = std::pow(k, 1 - r.exponent);
    power += band;
    out.push_back({k, std::sqrt(2 * band), random_phase(r.seed, n)});
  }
  for (HeightWave& w : out) w.amplitude *= *r.rms / std::sqrt(power);
  return out;
}

const double kHalfBand = std::pow(2, 1.0 / 6);  // ratio of a third-octave band's end and its middle

std::vector<HeightWave> waves_of(const RoughnessLevels& r) {
  constexpr int kOfBand = 10;
  constexpr double kReference = 1e-6;  // m
  std::vector<HeightWave> out;
  for (std::size_t band = 0; band < r.wavelengths.size(); ++band) {
    const double amplitude = kReference * std::pow(10, r.levels[band] / 20) * std::sqrt(2.0 / kOfBand);
    for (int n = 0; n < kOfBand; ++n) {
      const double within = std::pow(kHalfBand, 2 * (n + 0.5) / kOfBand - 1);
      out.push_back(
          {2 * kPi / r.wavelengths[band] * within, amplitude, random_phase(r.seed, static_cast<int>(out.size()))});
    }
  }
  return out;
}

SurfaceHeight sum_of(const std::vector<HeightWave>& waves, double x) {
  SurfaceHeight sum;
  for (const HeightWave& w : waves) {
    const SurfaceHeight h = cosine_wave(w.amplitude, w.number, x + w.phase / w.number);
    sum = {sum.z + h.z, sum.along + h.along};
  }
  return sum;
}

/// As long as slopes of random waves are looked for.
Sampled of_waves(Extent range, double longest) {
  constexpr int kLongestWaves = 20;
  if (!std::isfinite(range.from)) range.from = std::isfinite(range.to) ? range.to - kLongestWaves * longest : 0;
  range.to = std::min(range.to, range.from + kLongestWaves * longest);
  return {range, {0.0}};
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

/// Heights along one line of points.
struct PointLine {
  double y = 0;
  std::vector<double> x, z, slope;

  SurfaceHeight at(double place) const {
    if (!(place > x.front())) return {z.front(), 0};
    if (!(place < x.back())) return {z.back(), 0};
    const auto i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), place) - x.begin());
    const double h = x[i] - x[i - 1], t = (place - x[i - 1]) / h, u = 1 - t;
    const double rise = z[i] - z[i - 1], a = h * slope[i - 1] - rise, b = rise - h * slope[i];
    return {u * z[i - 1] + t * z[i] + t * u * (a * u + b * t),
            (rise + (1 - 2 * t) * (a * u + b * t) + t * u * (b - a)) / h};
  }
};

bool is_before(const PointLine& line, double y) { return line.y < y; }

std::vector<PointLine> lines_of(const HeightPoints& p) {
  std::vector<PointLine> out;
  for (std::size_t i = 0; i < p.z.size(); ++i) {
    const double y = p.y.empty() ? 0 : p.y[i];
    auto line = std::lower_bound(out.begin(), out.end(), y, is_before);
    if (line == out.end() || line->y != y) line = out.insert(line, PointLine{y, {}, {}, {}});
    const auto place = std::lower_bound(line->x.begin(), line->x.end(), p.x[i]) - line->x.begin();
    line->x.insert(line->x.begin() + place, p.x[i]);
    line->z.insert(line->z.begin() + place, p.z[i]);
  }
  for (PointLine& line : out) {
    if (p.smoothing > 0) line.z = smoothed(line.x, line.z, p.smoothing);
    line.slope = slopes(line.x, line.z);
  }
  return out;
}

}  // namespace

SurfaceHeight cosine_wave(double amplitude, double number, double x) {
  return {amplitude * std::cos(number * x), -amplitude * number * std::sin(number * x)};
}

SurfaceHeight cosine_hollow(double depth, double length, double x) {
  if (!(std::abs(x) < 0.5 * length)) return {};
  const SurfaceHeight h = cosine_wave(-0.5 * depth, 2 * kPi / length, x);
  return {h.z - 0.5 * depth, h.along};
}

SurfaceHeight cosine_rise(double x, double length) {
  if (!(x > 0)) return {};
  if (!(x < length)) return {1, 0};
  const SurfaceHeight h = cosine_wave(-0.5, kPi / length, x);
  return {0.5 + h.z, h.along};
}

SurfaceHeight WaveStretch::eased(double x, double over, SurfaceHeight h) const {
  if (from) h = times(h, cosine_rise(x - *from, over));
  if (to) {
    const SurfaceHeight end = cosine_rise(*to - x, over);
    h = times(h, {end.z, -end.along});
  }
  return h;
}

Heights Roughness::height(double, double) const {
  return [*this, waves = waves_of(*this)](double x, double) { return eased(x, *longest, sum_of(waves, x)); };
}

Sampled Roughness::sampled(double at) const { return of_waves(extent(at), *longest); }

Heights RoughnessLevels::height(double, double) const {
  return [*this, over = longest_wave(), waves = waves_of(*this)](double x, double) {
    return eased(x, over, sum_of(waves, x));
  };
}

double RoughnessLevels::shortest_wave(double) const {
  return *std::min_element(wavelengths.begin(), wavelengths.end()) / kHalfBand;
}

double RoughnessLevels::longest_wave() const {
  return *std::max_element(wavelengths.begin(), wavelengths.end()) * kHalfBand;
}

Sampled RoughnessLevels::sampled(double at) const { return of_waves(extent(at), longest_wave()); }

Heights HeightPoints::height(double at, double) const {
  return [at, lines = lines_of(*this)](double way, double aside) {
    const double place = way - at;
    const auto after = std::lower_bound(lines.begin(), lines.end(), aside, is_before);
    if (after == lines.begin()) return lines.front().at(place);
    if (after == lines.end()) return lines.back().at(place);
    const PointLine& before = *(after - 1);
    const double t = (aside - before.y) / (after->y - before.y);
    const SurfaceHeight a = before.at(place), b = after->at(place);
    return SurfaceHeight{(1 - t) * a.z + t * b.z, (1 - t) * a.along + t * b.along};
  };
}

Extent HeightPoints::extent(double at) const {
  if (x.empty()) return {at, at};
  const auto [first, last] = std::minmax_element(x.begin(), x.end());
  return {at + *first, at + *last};
}

Sampled HeightPoints::sampled(double at) const {
  std::vector<double> rows = y.empty() ? std::vector<double>{0.0} : y;
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return {extent(at), rows};
}

}  // namespace railstrata
