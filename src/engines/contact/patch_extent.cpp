#include "contact/patch_extent.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parabola.hpp"

namespace railstrata {
namespace {

/// Distance from the edge of a row to its third point in contact, whatever the force per length outside it. A value at
/// a point is a force over the length that the point stands for; p is as the root of d (L - d), d from the edge, L the
/// row's length [Johnson1985 sec. 4.2]. Of the third point's force, half less h² p'/6 lies outside.
double distance_by_force(double of_others, double third, double h, double length) {
  constexpr int kRounds = 8;
  constexpr double kMost = 0.9;
  double d = 1.5 * (of_others / third + 0.5 * h);
  for (int k = 0; k < kRounds; ++k) {
    const double u = std::min(d / length, kMost), root = std::sqrt(u * (1 - u)),
                 mean = ((2 * u - 1) * root / 4 + std::asin(2 * u - 1) / 8 + std::numbers::pi / 16) / root,
                 slope = (1 - 2 * u) / (2 * u * (1 - u) * length);
    d *= (of_others / third + 0.5 * h - square(h) * slope / 6) / (mean * length);
  }
  return d;
}

/// Of the n points first_index, first_index + apart, … at their places.
Chord chord(const ContactField& f, int n, int first_index, int apart, const std::vector<double>& place) {
  const auto t = [&](int i) { return place[first_index + i * apart]; };
  const auto p = [&](int i) { return f.p[first_index + i * apart]; };
  int first = -1, last = -1;
  for (int i = 0; i < n; ++i)
    if (p(i) > f.p_noise) {
      if (first < 0) first = i;
      last = i;
    }
  if (first < 0) return {};
  Chord c{t(first), t(last), true};
  if (last + 1 < n)
    c.end = last > first ? vanishing_place(t(last - 1), p(last - 1), t(last), p(last), t(last + 1))
                         : 0.5 * (t(last) + t(last + 1));
  if (first > 0)
    c.begin = last > first ? vanishing_place(t(first + 1), p(first + 1), t(first), p(first), t(first - 1))
                           : 0.5 * (t(first) + t(first - 1));
  constexpr int kThird = 2;
  if (!f.at_points || last - first < 2 * kThird || first == 0 || last + 1 == n) return c;
  if (!(p(first + kThird) > f.p_noise && p(last - kThird) > f.p_noise)) return c;
  const auto distance = [&](int outermost, int inward) {
    const int third = outermost + kThird * inward;
    double force = 0;
    for (int i = third - inward; i > 0 && i + 1 < n && p(i) > 0; i -= inward)
      force += 0.5 * p(i) * (t(i + 1) - t(i - 1));
    const double h = std::abs(t(third) - t(third - inward));
    return distance_by_force(force, p(third), h, c.length());
  };
  const double begin = t(first + kThird) - distance(first, 1), end = t(last - kThird) + distance(last, -1);
  return {std::clamp(begin, t(first - 1), t(first + 1)), std::clamp(end, t(last - 1), t(last + 1)), true};
}

}  // namespace

double vanishing_place(double t_in, double p_in, double t_last, double p_last, double t_out) {
  const double slope = (p_in * p_in - p_last * p_last) / (t_last - t_in);  // decrease of p² per length
  const double distance = slope * (t_last - t_in) > 0 ? p_last * p_last / slope : t_out - t_last;
  return t_out > t_last ? std::min(t_last + distance, t_out) : std::max(t_last + distance, t_out);
}

Chord chord_along(const ContactField& f, int column) { return chord(f, f.stations, column, f.columns, f.x); }

PatchExtent patch_extent(const ContactField& f) {
  PatchExtent out;
  for (int c = 0; c < f.columns; ++c) {
    const Chord& along = out.along.emplace_back(chord_along(f, c));
    out.length = std::max(out.length, along.length());
    if (!along.any) continue;
    if (out.first < 0) out.first = c;
    out.last = c;
  }
  for (int s = 0; s < f.stations; ++s)
    if (const Chord across = chord(f, f.columns, s * f.columns, 1, f.y); across.length() > out.width) {
      out.width = across.length();
      out.widest = across;
    }
  return out;
}

ConnectedRegions connected_regions(int columns, const std::vector<double>& p, double least) {
  ConnectedRegions out{std::vector<int>(p.size(), ConnectedRegions::kNone), 0};
  const int size = static_cast<int>(p.size());
  std::vector<int> front;
  const auto take = [&](int i) {
    if (!(p[i] > least) || out.of[i] != ConnectedRegions::kNone) return;
    out.of[i] = out.count;
    front.push_back(i);
  };
  for (int start = 0; start < size; ++start) {
    take(start);
    if (front.empty()) continue;
    while (!front.empty()) {
      const int column = front.back() % columns, station = front.back() / columns;
      front.pop_back();
      for (int s = std::max(station - 1, 0); s <= station + 1 && s * columns < size; ++s)
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, columns - 1); ++c) take(s * columns + c);
    }
    ++out.count;
  }
  return out;
}

int contact_regions(const ContactField& f) { return connected_regions(f.columns, f.p, std::max(f.p_noise, 0.0)).count; }

}  // namespace railstrata
