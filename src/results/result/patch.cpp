#include "result/patch.hpp"

#include <limits>

#include "contact/patch_extent.hpp"
#include "core/parabola.hpp"

namespace railstrata {
namespace {

/// Mean of sqrt(t) over the cell whose middle is at t = b; nothing is left where t < 0.
double mean_root(double b) {
  const auto integral = [](double t) { return t > 0 ? 2.0 / 3.0 * t * std::sqrt(t) : 0.0; };
  return integral(b + 0.5) - integral(b - 0.5);
}

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
  if (station > 0 && station + 1 < f.stations) {
    const int a = top - f.columns, b = top + f.columns;
    const ParabolaTop t = parabola_top(f.x[a], f.p[a], f.x[top], f.p[top], f.x[b], f.p[b]);
    m.p_max += t.above;
    m.p_max_x = t.at;
  }
  if (column > 0 && column + 1 < f.columns) {
    const int a = top - 1, b = top + 1;
    m.p_max += parabola_top(f.y[a], f.p[a], f.y[top], f.p[top], f.y[b], f.p[b]).above;
  }
}

double shear(const ContactField& f, int i) { return std::hypot(f.q_x[i], f.q_y[i]); }

/// A point that sticks next to one of its column that slips.
struct Front {
  int sticks, slips;
  int on() const { return sticks - slips; }
};

double bound_beside(const ContactField& f, const Front& front, int i) {
  return f.bound.empty() ? shear(f, front.slips) / f.p[front.slips] * f.p[i] : f.bound[i];
}

/// Distance from the sticking point to the front, of points; none where the point ahead of it does not stick. Of values
/// at points: where stick reaches the leading edge, the square of the margin is that of Carter's stick,
/// (x - front) (edge - x) [Johnson1985 sec. 8.3].
std::optional<double> front_behind(const ContactField& f, const Front& front) {
  const auto sticks = [&](int i) { return i >= 0 && i < f.size() && f.state[i] == ContactState::stick; };
  const auto margin = [&](int i) { return bound_beside(f, front, i) - shear(f, i); };
  const int ahead = front.sticks + front.on(), after = ahead + front.on();
  if (!sticks(ahead) || !(f.p[front.slips] > 0)) return {};
  StickMargins margins{margin(front.sticks), margin(ahead), {}};
  if (f.at_points) {
    const double edge = chord_along(f, ahead % f.columns).end, room = edge - f.x[ahead];
    if (room > 0) margins.near *= std::sqrt(room / (edge - f.x[front.sticks]));
    return front_behind_point(margins);
  }
  if (sticks(after)) margins.after = margin(after);
  return front_behind_cell(margins);
}

/// Length of a column's chord that slips: to the front behind stick, half of the way where there is none; the outermost
/// points in contact stand for what is beyond them.
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
    const int i0 = at(std::clamp(s, first, last)), i1 = at(std::clamp(s + 1, first, last));
    const bool slips0 = f.state[i0] == ContactState::slip, slips1 = f.state[i1] == ContactState::slip;
    if (!slips0 && !slips1) continue;
    double from = f.x[at(s)], to = f.x[at(s + 1)];
    if (slips0 != slips1) {
      const double back = slips0 ? front_behind(f, {i1, i0}).value_or(0.5) : 0.5;
      (slips0 ? to : from) = slips0 ? to - back * (to - from) : 0.5 * (from + to);
    }
    length += std::max(0.0, std::min(to, chord.end) - std::max(from, chord.begin));
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
  if (f.at_points) return slipping_share_of_chords(f);
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
  double largest = 0;
  for (int i = 0; i < f.size(); ++i) {
    largest = std::max(largest, shear(f, i));
    const Front front{i, i - f.columns};
    if (front.slips < 0 || f.state[front.slips] != ContactState::slip || f.state[i] != ContactState::stick) continue;
    if (const std::optional<double> back = front_behind(f, front))
      largest =
          std::max(largest, (1 - *back) * bound_beside(f, front, i) + *back * bound_beside(f, front, front.slips));
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

double front_behind_point(const StickMargins& m) {
  const double rise = square(m.next) - square(m.near);
  return rise > 0 ? std::min(square(m.near) / rise, 1.0) : 1.0;
}

double front_behind_cell(const StickMargins& m) {
  constexpr double kLeast = -0.5, kMost = 1;
  constexpr int kHalvings = 40;
  const double rise = m.after ? square(*m.after) - square(m.next) : 0;
  if (!(rise > 0)) return front_behind_point(m);
  const double wanted = m.near / std::sqrt(rise);
  double low = kLeast, high = kMost;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (mean_root(middle) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace railstrata
