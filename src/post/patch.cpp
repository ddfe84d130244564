#include "post/patch.hpp"

#include <algorithm>
#include <cmath>

namespace railstrata {
namespace {

struct Chord {
  double begin = 0, end = 0;
  bool any = false;
  double length() const { return end - begin; }
};

// Where the pressure of points t[i] vanishes beyond its last value above the noise: p² is linear near the edge of a
// smooth contact.
double edge(double t_in, double p_in, double t_last, double p_last, double t_out) {
  const double slope = (p_in * p_in - p_last * p_last) / (t_last - t_in);  // decrease of p² per length
  const double distance = slope * (t_last - t_in) > 0 ? p_last * p_last / slope : t_out - t_last;
  return t_out > t_last ? std::min(t_last + distance, t_out) : std::max(t_last + distance, t_out);
}

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
    c.end =
        last > first ? edge(t(last - 1), p(last - 1), t(last), p(last), t(last + 1)) : 0.5 * (t(last) + t(last + 1));
  if (first > 0)
    c.begin = last > first ? edge(t(first + 1), p(first + 1), t(first), p(first), t(first - 1))
                           : 0.5 * (t(first) + t(first - 1));
  return c;
}

// Offset and height above the middle value of the top of the parabola through three points.
struct Top {
  double at, above;
};
Top parabola_top(double t0, double f0, double t1, double f1, double t2, double f2) {
  const double a = ((f2 - f1) / (t2 - t1) - (f1 - f0) / (t1 - t0)) / (t2 - t0);
  if (a >= 0) return {t1, 0};
  const double b = (f1 - f0) / (t1 - t0) + a * (t1 - t0);  // slope at t1
  const double d = std::clamp(-b / (2 * a), t0 - t1, t2 - t1);
  return {t1 + d, b * d + a * d * d};
}

}  // namespace

PatchMeasures measure_patch(const ContactField& f) {
  PatchMeasures m;
  if (f.size() == 0) return m;
  const int nc = f.columns, ns = f.stations;
  auto at = [nc](int c, int s) { return s * nc + c; };
  const int top = static_cast<int>(std::max_element(f.p.begin(), f.p.end()) - f.p.begin()), tc = top % nc,
            ts = top / nc;
  m.p_max = f.p[top];
  m.p_max_x = f.x[top];
  m.p_max_y = f.y[top];
  if (ts > 0 && ts + 1 < ns) {
    const int a = at(tc, ts - 1), b = at(tc, ts + 1);
    const Top t = parabola_top(f.x[a], f.p[a], f.x[top], f.p[top], f.x[b], f.p[b]);
    m.p_max += t.above;
    m.p_max_x = t.at;
  }
  if (tc > 0 && tc + 1 < nc) {
    const int a = at(tc - 1, ts), b = at(tc + 1, ts);
    const Top t = parabola_top(f.y[a], f.p[a], f.y[top], f.p[top], f.y[b], f.p[b]);
    m.p_max += t.above;
    m.p_max_y = t.at;
  }
  double touching = 0, slipping = 0;
  for (int i = 0; i < f.size(); ++i) {
    m.q_max = std::max(m.q_max, std::hypot(f.q_x[i], f.q_y[i]));
    m.force_x -= f.area[i] * f.q_x[i];
    m.force_y -= f.area[i] * f.q_y[i];
    m.force_z += f.area[i] * f.p[i];
    if (f.p[i] > f.p_noise && f.p[i] > 0) {
      touching += f.area[i];
      if (f.state[i] == ContactState::slip) slipping += f.area[i];
    }
  }
  m.slip_area_fraction = touching > 0 ? slipping / touching : 0;

  std::vector<Chord> along(nc);
  int first = -1, last = -1;
  for (int c = 0; c < nc; ++c) {
    along[c] = chord(
        ns, f.p_noise, [&](int s) { return f.x[at(c, s)]; }, [&](int s) { return f.p[at(c, s)]; });
    m.length = std::max(m.length, along[c].length());
    if (along[c].any) {
      if (first < 0) first = c;
      last = c;
    }
  }
  double y_begin = 0, y_end = 0;
  for (int s = 0; s < ns; ++s) {
    const Chord c = chord(
        nc, f.p_noise, [&](int k) { return f.y[at(k, s)]; }, [&](int k) { return f.p[at(k, s)]; });
    if (c.length() > m.width) {
      m.width = c.length();
      y_begin = c.begin;
      y_end = c.end;
    }
  }
  if (first >= 0) {
    const int s = ts;
    for (int c = first; c < last; ++c)
      m.area += 0.5 * (along[c].length() + along[c + 1].length()) * (f.y[at(c + 1, s)] - f.y[at(c, s)]);
    // the rounded ends beyond the outermost columns: a parabola's segment
    m.area += 2.0 / 3.0 *
              (along[first].length() * std::max(0.0, f.y[at(first, s)] - y_begin) +
               along[last].length() * std::max(0.0, y_end - f.y[at(last, s)]));
  }
  return m;
}

CentreLine centre_line(const ContactField& f) {
  CentreLine line;
  if (f.size() == 0) return line;
  const int column = static_cast<int>(std::max_element(f.p.begin(), f.p.end()) - f.p.begin()) % f.columns;
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

}  // namespace railstrata
