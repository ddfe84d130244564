#include "mesh/grading.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace railstrata {

std::vector<double> graded_points(double a, double b, const std::function<double(double)>& size) {
  assert(a < b);
  constexpr int kSamples = 400;
  std::vector<double> count(kSamples + 1, 0.0);
  const double dx = (b - a) / kSamples;
  for (int i = 0; i < kSamples; ++i) count[i + 1] = count[i] + dx / size(a + (i + 0.5) * dx);
  const int n = std::max(1, static_cast<int>(std::ceil(count.back() - 0.25)));

  std::vector<double> points{a};
  for (int k = 1, i = 0; k < n; ++k) {
    const double wanted = count.back() * k / n;
    while (count[i + 1] < wanted) ++i;
    points.push_back(a + dx * (i + (wanted - count[i]) / (count[i + 1] - count[i])));
  }
  points.push_back(b);
  return points;
}

std::vector<double> growing_spacings(double length, double first, double ratio, double largest) {
  assert(first > 0 && ratio > 1);
  std::vector<double> out;
  double rest = length, step = first;
  while (step * ratio < largest && rest > 2.7 * step * ratio) {
    step *= ratio;
    out.push_back(step);
    rest -= step;
  }
  const double limit = std::min(largest, step * ratio);
  const int n = std::max(1, static_cast<int>(std::ceil(rest / limit - 1e-9)));
  out.insert(out.end(), n, rest / n);
  return out;
}

bool snap_interior(std::vector<double>& points, double value) {
  assert(points.size() >= 2 && std::is_sorted(points.begin(), points.end()));
  const auto nearest = std::min_element(points.begin(), points.end(),
                                        [&](double p, double q) { return std::abs(p - value) < std::abs(q - value); });
  if (nearest == points.begin() || nearest == points.end() - 1) return false;
  const double a = points.front(), b = points.back(), old = *nearest;
  for (double& p : points) p = p <= old ? a + (p - a) * (value - a) / (old - a) : b - (b - p) * (b - value) / (b - old);
  *nearest = value;
  return true;
}

namespace {

int coarse_steps(double begin, double end, double coarse) {
  return std::max(1, static_cast<int>(std::ceil((end - begin) / coarse - 1e-6)));
}

void append_run(StationPair& stations, const std::vector<double>& spacings) {
  double at = stations.fine.back();
  for (double d : spacings) {
    at += d;
    stations.fine.push_back(at);
    stations.coarse.push_back(at);
  }
}

// A whole number of coarse steps round the ring, as near to the wanted one as that allows.
StationPair uniform_ring(double begin, double step, int ratio) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const int coarse_count = std::max(3, static_cast<int>(std::lround(kTurn / (ratio * step)))),
            count = coarse_count * ratio;
  StationPair out;
  out.fine_begin = begin;
  out.fine_end = begin + kTurn;
  for (int i = 0; i < count; ++i) {
    const double at = begin + kTurn * i / count;
    out.fine.push_back(at);
    if (i % ratio == 0) out.coarse.push_back(at);
  }
  return out;
}

// Even steps from plane to plane, in groups of up to `ratio`, which are the coarse ones.
void append_pieces(StationPair& stations, const std::vector<double>& ends, double step, int ratio) {
  stations.fine.push_back(ends.front());
  stations.coarse.push_back(ends.front());
  for (std::size_t p = 1; p < ends.size(); ++p) {
    const double from = ends[p - 1], length = ends[p] - from;
    const int count = std::max(1, static_cast<int>(std::lround(length / step))), groups = (count + ratio - 1) / ratio;
    for (int i = 1, group = 1; i <= count; ++i) {
      const double at = i == count ? ends[p] : from + length * i / count;
      stations.fine.push_back(at);
      if (i < (group * count + groups / 2) / groups) continue;
      stations.coarse.push_back(at);
      ++group;
    }
  }
}

void append_fine_range(StationPair& stations, double begin, int coarse_count, double step, int ratio,
                       const std::vector<double>& planes) {
  stations.fine_begin = begin;
  stations.fine_end = begin + coarse_count * ratio * step;
  std::vector<double> ends{begin};
  for (double plane : planes)
    if (plane > ends.back() + 0.5 * step && plane < stations.fine_end - 0.5 * step) ends.push_back(plane);
  if (ends.size() > 1) {
    ends.push_back(stations.fine_end);
    append_pieces(stations, ends, step, ratio);
    return;
  }
  for (int i = 0; i <= coarse_count * ratio; ++i) {
    const double at = begin + i * step;
    stations.fine.push_back(at);
    if (i % ratio == 0) stations.coarse.push_back(at);
  }
}

}  // namespace

StationPair extruded_stations(double begin, double end, double step, int ratio, double end_length, double largest,
                              const std::vector<double>& planes) {
  StationPair out;
  const double coarse = ratio * step;
  const std::vector<double> run = growing_spacings(end_length, coarse, kStationGrowth, largest);
  double at = begin;
  for (double d : run) {
    at -= d;
    out.fine.push_back(at);
  }
  std::reverse(out.fine.begin(), out.fine.end());
  out.coarse = out.fine;
  append_fine_range(out, begin, coarse_steps(begin, end, coarse), step, ratio, planes);
  append_run(out, run);
  return out;
}

StationPair ring_stations(double begin, double end, double step, int ratio, double largest,
                          const std::vector<double>& planes) {
  StationPair out;
  const double coarse = ratio * step;
  if (2 * std::numbers::pi - (end - begin) < 4 * coarse) return uniform_ring(begin, step, ratio);
  append_fine_range(out, begin, coarse_steps(begin, end, coarse), step, ratio, planes);
  const double rest = 2 * std::numbers::pi - (out.fine_end - out.fine_begin);
  std::vector<double> run = growing_spacings(rest / 2, coarse, kStationGrowth, largest);
  append_run(out, run);
  std::reverse(run.begin(), run.end());
  run.pop_back();  // the last element closes the ring
  append_run(out, run);
  return out;
}

std::vector<double> thinned(const std::vector<double>& stations, double largest) {
  assert(stations.size() >= 2 && std::is_sorted(stations.begin(), stations.end()));
  std::vector<double> out{stations.front()};
  for (std::size_t i = 1; i + 1 < stations.size(); ++i)
    if (stations[i + 1] - out.back() > largest * (1 + 1e-9)) out.push_back(stations[i]);
  out.push_back(stations.back());
  return out;
}

}  // namespace railstrata
