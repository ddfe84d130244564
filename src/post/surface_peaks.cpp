#include "post/surface_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace railstrata {
namespace {

constexpr int kLeastPoints = 4;

double square(double v) { return v * v; }

Sym3 smooth(const SurfaceRow& row, int i) {
  Sym3 s = row.stress(i);
  s.xx += row.p[i];
  s.yy += 2 * row.poisson * row.p[i];
  s.zz = s.xz = s.yz = 0;
  return s;
}

Sym3 at_edge(const SurfaceRow& row, int outermost, int inward) {
  const double outer = square(row.p[outermost]), inner = square(row.p[outermost + inward]);
  const double beyond = inner > outer ? std::min(outer / (inner - outer), 1.0) : 1.0;  // points, from the outermost
  const Sym3 a = smooth(row, outermost + inward), b = smooth(row, outermost + 2 * inward);
  return a + (1 + beyond) * (a - b);
}

/// The front between a slipping point and the sticking ones at `slipping` + `on`, + 2 `on`, … to `end`. The first two
/// of them miss the strain that sticking surfaces share, by the cusp next to them; where there are four the last two
/// say it.
std::optional<Sym3> at_front(const SurfaceRow& row, int slipping, int on, int end) {
  const int near = slipping + on, next = near + on;
  const auto sticks = [&](int count) {
    for (int k = 1; k <= count; ++k) {
      const int i = slipping + k * on;
      if ((end - i) * on < 0 || row.state[i] != ContactState::stick) return false;
    }
    return true;
  };
  if (!sticks(3) || !(row.q[slipping] > 0)) return {};
  const int skipped = sticks(4) ? 2 : 1, first = near + skipped * on;
  const double f = row.q[slipping] / row.p[slipping];
  const auto left = [&](int i) { return square(f * row.p[i] - row.q[i]); };
  const double rise = left(next) - left(near), back = rise > 0 ? std::min(left(near) / rise, 1.0) : 1.0;
  const double p = row.p[near] + back * (row.p[slipping] - row.p[near]);
  const Sym3 slip = row.stress(slipping), a = smooth(row, first), b = smooth(row, first + on);
  const double share = f * p / row.q[slipping];
  Sym3 front = a + (skipped + back) * (a - b);
  front.xx -= p;
  front.yy -= 2 * row.poisson * p;
  front.zz = -p;
  front.xz = share * slip.xz;
  front.yz = share * slip.yz;
  return front;
}

}  // namespace

SurfacePeaks surface_peaks(const SurfaceRow& row) {
  SurfacePeaks out;
  int first = 0, last = static_cast<int>(row.p.size()) - 1;
  while (first <= last && !(row.p[first] > 0)) ++first;
  while (last >= first && !(row.p[last] > 0)) --last;
  if (last - first + 1 < kLeastPoints) return out;
  out.first = first;
  out.last = last;
  out.behind = at_edge(row, first, 1);
  out.ahead = at_edge(row, last, -1);
  const auto is = [&](int i, ContactState state) { return row.state[i] == state; };
  const auto add = [&](int at, const std::optional<Sym3>& stress) {
    if (stress) out.fronts.push_back({at, *stress});
  };
  for (int i = first; i < last; ++i) {
    if (is(i, ContactState::slip) && is(i + 1, ContactState::stick)) add(i + 1, at_front(row, i, 1, last));
    if (is(i, ContactState::stick) && is(i + 1, ContactState::slip)) add(i, at_front(row, i + 1, -1, first));
  }
  return out;
}

}  // namespace railstrata
