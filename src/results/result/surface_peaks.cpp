#include "result/surface_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/parabola.hpp"
#include "result/patch.hpp"

namespace railstrata {
namespace {

constexpr int kLeastPoints = 4;

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

/// The same of cells. The outermost has any share of its area in contact, and its neighbours' stresses feel that: the
/// edge is taken from p² of the second to the fourth, a parabola, and the smooth part from the third to the fifth as
/// a + b t + c t³, t being the distance from the edge: it is linear where all slips, and sticking zones bend it the
/// more the closer they are. None where there is a front between those cells.
std::optional<Sym3> at_edge_of_cells(const SurfaceRow& row, int outermost, int inward, int points) {
  constexpr int kCells = 7;
  if (points < kCells) return {};
  const auto cell = [&](int k) { return outermost + k * inward; };
  for (int k = 2; k < kCells; ++k)
    if (row.state[cell(k)] != row.state[cell(1)]) return {};
  const double v = square(row.p[cell(1)]), rise = square(row.p[cell(2)]) - v,
               bend = square(row.p[cell(3)]) - square(row.p[cell(2)]) - rise, slope = rise - 0.5 * bend;
  const double root = slope * slope - 2 * bend * v;
  if (!(slope > 0) || root < 0) return {};
  const double beyond = 2 * v / (slope + std::sqrt(root));  // of the edge, in cells, from the second
  if (beyond > 2) return {};
  const double t0 = beyond + 1, t1 = beyond + 2, t2 = beyond + 3;
  const Sym3 s0 = smooth(row, cell(2)), s1 = smooth(row, cell(3)), s2 = smooth(row, cell(4));
  const double cube0 = t0 * t0 * t0, cube1 = t1 * t1 * t1, cube2 = t2 * t2 * t2;
  const Sym3 first = s1 - s0, second = s2 - s1, c = (1 / (cube2 - 2 * cube1 + cube0)) * (second - first),
             b = first - (cube1 - cube0) * c;
  return s0 - t0 * b - cube0 * c;
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
  const auto margin = [&](int i) { return f * row.p[i] - row.q[i]; };
  const StickMargins margins{margin(near), margin(next), margin(next + on)};
  const double back = row.cells ? front_behind_cell(margins) : front_behind_point(margins);
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
  const auto edge = [&](int outermost, int inward) {
    const auto of_cells = row.cells ? at_edge_of_cells(row, outermost, inward, last - first + 1) : std::nullopt;
    return of_cells ? *of_cells : at_edge(row, outermost, inward);
  };
  out.behind = edge(first, 1);
  out.ahead = edge(last, -1);
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
