#include "result/patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/patch_extent.hpp"
#include "core/parabola.hpp"
#include "result/front_of_slip.hpp"

namespace railstrata {
namespace {

/// The point of largest pressure; of several beside one another with the same, as along a line contact, the middle one.
int point_of_largest_pressure(const ContactField& f) {
  const int top = static_cast<int>(std::max_element(f.p.begin(), f.p.end()) - f.p.begin());
  int equal = 0;
  while (top % f.columns + equal + 1 < f.columns && f.p[top + equal + 1] == f.p[top]) ++equal;
  return top + equal / 2;
}

/// p_max and its place, refined from the point of largest pressure along both directions.
void find_peak(const ContactField& f, int top, PatchMeasures& m) {
  const int column = top % f.columns, station = top / f.columns;
  m.p_max = f.p[top];
  m.p_max_x = f.x[top];
  m.p_max_y = f.y[top];
  if (station > 0 && station + 1 < f.stations) {
    const int a = top - f.columns, b = top + f.columns;
    const ParabolaTop t = parabola_top(f.x[a], f.p[a], f.x[top], f.p[top], f.x[b], f.p[b]);
    m.p_max += t.above;
    m.p_max_x = t.at;
  }
  if (column > 0 && column + 1 < f.columns) {
    const int a = top - 1, b = top + 1;
    const ParabolaTop t = parabola_top(f.y[a], f.p[a], f.y[top], f.p[top], f.y[b], f.p[b]);
    m.p_max += t.above;
    m.p_max_y = t.at;
  }
}

/// Length of a column's chord in which the slip share, linear between points and level beyond the outermost ones in
/// contact, is one half or more.
double slipping_length(const ContactField& f, int column, const Chord& chord) {
  const auto at = [&](int s) { return s * f.columns + column; };
  int first = f.stations, last = -1;
  for (int s = 0; s < f.stations; ++s)
    if (f.p[at(s)] > f.p_noise) {
      first = std::min(first, s);
      last = s;
    }
  double length = 0;
  for (int s = std::max(first - 1, 0); s < std::min(last + 1, f.stations - 1); ++s) {
    const auto above = [&](int k) { return f.slip_share[at(std::clamp(k, first, last))] - 0.5; };
    const double x0 = f.x[at(s)], x1 = f.x[at(s + 1)], a0 = above(s), a1 = above(s + 1);
    if (a0 < 0 && a1 < 0) continue;
    const double crossing = (a0 < 0) == (a1 < 0) ? x0 : x0 + (x1 - x0) * a0 / (a0 - a1);
    const double from = std::max(a0 < 0 ? crossing : x0, chord.begin), to = std::min(a1 < 0 ? crossing : x1, chord.end);
    length += std::max(0.0, to - from);
  }
  return length;
}

/// Slipping share of the chords' area. Beyond the outermost columns the chord length falls as the square root of the
/// distance to the side; the slipping part keeps its length until it is the whole chord, as in Carter's strips.
double slipping_share_of_chords(const ContactField& f) {
  struct Strip {
    double y, length, slipping;
  };
  std::vector<Strip> strips;
  for (int c = 0; c < f.columns; ++c) {
    const auto at = [&](int s) { return s * f.columns + c; };
    const Chord along = chord_along(f, c);
    if (along.any) strips.push_back({f.y[at(0)], along.length(), slipping_length(f, c, along)});
  }
  double touching = 0, slipping = 0;
  for (std::size_t k = 1; k < strips.size(); ++k) {
    const double half = 0.5 * (strips[k].y - strips[k - 1].y);
    touching += half * (strips[k].length + strips[k - 1].length);
    slipping += half * (strips[k].slipping + strips[k - 1].slipping);
  }
  const auto add_side = [&](const Strip& inner, const Strip& last) {
    const double step = last.y - inner.y,
                 side = vanishing_place(inner.y, inner.length, last.y, last.length, last.y + step),
                 area = last.length * std::abs(side - last.y), share = last.slipping / last.length;
    touching += 2.0 / 3.0 * area;
    slipping += (share - share * share * share / 3) * area;
  };
  if (strips.size() < 2) return strips.empty() ? 0 : strips[0].slipping / strips[0].length;
  add_side(strips[1], strips[0]);
  add_side(strips[strips.size() - 2], strips.back());
  return slipping / touching;
}

double slipping_share(const ContactField& f) {
  if (!f.slip_share.empty()) return slipping_share_of_chords(f);
  double touching = 0, slipping = 0;
  for (int i = 0; i < f.size(); ++i) {
    if (!(f.p[i] > f.p_noise && f.p[i] > 0)) continue;
    touching += f.area[i];
    if (f.state[i] == ContactState::slip) slipping += f.area[i];
  }
  return touching > 0 ? slipping / touching : 0;
}

/// Length, width and area from the chords of columns and stations; y at the station of largest pressure.
void find_extent(const ContactField& f, int peak_station, PatchMeasures& m) {
  const PatchExtent e = patch_extent(f);
  m.length = e.length;
  m.width = e.width;
  if (e.first < 0) return;
  if (f.line_length > 0) {
    m.width = std::numeric_limits<double>::quiet_NaN();
    m.area = m.length * f.line_length;
    return;
  }
  const auto y = [&](int c) { return f.y[peak_station * f.columns + c]; };
  for (int c = e.first; c < e.last; ++c)
    m.area += 0.5 * (e.along[c].length() + e.along[c + 1].length()) * (y(c + 1) - y(c));
  // the rounded ends beyond the outermost columns: a parabola's segment
  m.area += 2.0 / 3.0 *
            (e.along[e.first].length() * std::max(0.0, y(e.first) - e.widest.begin) +
             e.along[e.last].length() * std::max(0.0, e.widest.end - y(e.last)));
}

}  // namespace

PatchMeasures measure_patch(const ContactField& f) {
  PatchMeasures m;
  if (f.size() == 0) return m;
  const int top = point_of_largest_pressure(f);
  find_peak(f, top, m);
  for (int i = 0; i < f.size(); ++i) add_point(m, f, i);
  m.slip_area_fraction = slipping_share(f);
  find_extent(f, top / f.columns, m);
  return m;
}

double shear_at_front_of_slip(const ContactField& f) {
  const auto q = [&](int i) { return std::hypot(f.q_x[i], f.q_y[i]); };
  double largest = 0;
  for (int i = 0; i < f.size(); ++i) {
    largest = std::max(largest, q(i));
    const int behind = i - f.columns, ahead = i + f.columns;
    if (behind < 0 || ahead >= f.size() || !(f.p[behind] > 0) || f.state[behind] != ContactState::slip ||
        f.state[i] != ContactState::stick || f.state[ahead] != ContactState::stick)
      continue;
    const double friction = q(behind) / f.p[behind];
    const auto bound = [&](int k) { return f.bound.empty() ? friction * f.p[k] : f.bound[k]; };
    const auto margin = [&](int k) { return bound(k) - q(k); };
    StickMargins margins{margin(i), margin(ahead), {}};
    if (const int after = ahead + f.columns; after < f.size() && f.state[after] == ContactState::stick)
      margins.after = margin(after);
    const double back = front_behind_cell(margins);
    largest = std::max(largest, f.bound.empty() ? friction * ((1 - back) * f.p[i] + back * f.p[behind])
                                                : (1 - back) * bound(i) + back * bound(behind));
  }
  return largest;
}

CentreLine centre_line(const ContactField& f) {
  CentreLine line;
  if (f.size() == 0) return line;
  const int column = point_of_largest_pressure(f) % f.columns;
  for (int s = 0; s < f.stations; ++s) {
    const int i = s * f.columns + column;
    line.x.push_back(f.x[i]);
    line.p.push_back(f.p[i]);
    line.q_x.push_back(f.q_x[i]);
    line.q_y.push_back(f.q_y[i]);
    line.slip_x.push_back(f.slip_x[i]);
    line.y = f.y[i];
  }
  return line;
}

double subsurface_begin(const PatchMeasures& patch, double first_layer) {
  return std::min(0.05 * shorter_axis(patch), 0.5 * first_layer);
}

}  // namespace railstrata
