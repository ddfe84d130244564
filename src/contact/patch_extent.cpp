#include "contact/patch_extent.hpp"

#include <algorithm>

namespace railstrata {
namespace {

template <class T, class P>
Chord chord(int n, double noise, T&& t, P&& p) {
  int first = -1, last = -1;
  for (int i = 0; i < n; ++i)
    if (p(i) > noise) {
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
  return c;
}

Chord chord_across(const ContactField& f, int station) {
  const auto at = [&](int c) { return station * f.columns + c; };
  return chord(
      f.columns, f.p_noise, [&](int c) { return f.y[at(c)]; }, [&](int c) { return f.p[at(c)]; });
}

}  // namespace

double vanishing_place(double t_in, double p_in, double t_last, double p_last, double t_out) {
  const double slope = (p_in * p_in - p_last * p_last) / (t_last - t_in);  // decrease of p² per length
  const double distance = slope * (t_last - t_in) > 0 ? p_last * p_last / slope : t_out - t_last;
  return t_out > t_last ? std::min(t_last + distance, t_out) : std::max(t_last + distance, t_out);
}

Chord chord_along(const ContactField& f, int column) {
  const auto at = [&](int s) { return s * f.columns + column; };
  return chord(
      f.stations, f.p_noise, [&](int s) { return f.x[at(s)]; }, [&](int s) { return f.p[at(s)]; });
}

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
    if (const Chord across = chord_across(f, s); across.length() > out.width) {
      out.width = across.length();
      out.widest = across;
    }
  return out;
}

int contact_regions(const ContactField& f) {
  std::vector<char> open(static_cast<std::size_t>(f.size()));
  for (int i = 0; i < f.size(); ++i) open[i] = f.p[i] > f.p_noise && f.p[i] > 0;
  int regions = 0;
  std::vector<int> front;
  for (int start = 0; start < f.size(); ++start) {
    if (!open[start]) continue;
    ++regions;
    open[start] = 0;
    front.assign(1, start);
    while (!front.empty()) {
      const int column = front.back() % f.columns, station = front.back() / f.columns;
      front.pop_back();
      for (int s = std::max(station - 1, 0); s <= std::min(station + 1, f.stations - 1); ++s)
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, f.columns - 1); ++c)
          if (const int i = s * f.columns + c; open[i]) {
            open[i] = 0;
            front.push_back(i);
          }
    }
  }
  return regions;
}

}  // namespace railstrata
