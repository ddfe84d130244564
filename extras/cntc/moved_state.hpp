#pragma once
// The state of a potential contact area seen from behind, and on another grid.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "cntc/problem.hpp"

namespace railstrata::cntc {

inline void reverse(Plane& values) { std::reverse(values.begin(), values.end()); }
inline void turn_vectors(PlanePair& v) {
  for (Plane* part : {&v.x, &v.y}) {
    reverse(*part);
    for (double& value : *part) value = -value;
  }
}

/// Half a turn about the normal, by which rolling to -x becomes rolling to +x: cells in the opposite order, components
/// in the plane with the other sign.
inline PatchGrid turned(PatchGrid g) {
  g.x0 = -g.x(g.nx - 1);
  g.y0 = -g.y(g.ny - 1);
  return g;
}

inline void turn(RollingSolution& s) {
  reverse(s.normal.pressure);
  reverse(s.normal.gap);
  TangentialSolution& t = s.tangential;
  PlanePair q{std::move(t.q_x), std::move(t.q_y)};
  for (PlanePair* pair : {&q, &t.slip, &t.cell_slip}) turn_vectors(*pair);
  t.q_x = std::move(q.x);
  t.q_y = std::move(q.y);
  std::reverse(t.state.begin(), t.state.end());
  for (Plane* plane : {&t.plastic, &t.bound, &t.lost_friction, &t.film_flexibility, &s.temperature}) reverse(*plane);
  for (Plane& flux : s.flux) reverse(flux);
  for (double* value : {&t.creepage_x, &t.creepage_y, &t.force_x, &t.force_y}) *value = -*value;
}

/// By how many elements one grid lies beside another one of the same elements.
struct Offset {
  int x = 0, y = 0;
};
inline std::optional<Offset> offset_of(const PatchGrid& g, const PatchGrid& from) {
  constexpr double kNear = 1e-3;  // of an element
  const auto same = [](double a, double b) { return std::abs(a - b) < 0.1 * kNear * a; };
  const double x = (g.x0 - from.x0) / g.dx, y = (g.y0 - from.y0) / g.dy;
  const Offset out{static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))};
  if (!same(g.dx, from.dx) || !same(g.dy, from.dy) || std::abs(x - out.x) > kNear || std::abs(y - out.y) > kNear)
    return {};
  return out;
}

/// The state of a potential contact area on another one of the same elements. What lies outside of it is forgotten.
class Moved {
 public:
  Moved(const PatchGrid& to, const PatchGrid& from, Offset by) : to_(to), from_(from), by_(by) {}

  RollingSolution of(const RollingSolution& s) const {
    RollingSolution out = s;
    TangentialSolution& t = out.tangential;
    for (Plane* plane : {&out.normal.pressure, &out.normal.gap, &out.temperature, &t.q_x, &t.q_y, &t.slip.x, &t.slip.y,
                         &t.cell_slip.x, &t.cell_slip.y, &t.plastic, &t.bound, &t.lost_friction, &t.film_flexibility})
      *plane = values(*plane);
    for (Plane& flux : out.flux) flux = values(flux);
    t.state = values(t.state, ContactState::separated);
    return out;
  }

 private:
  template <class T>
  std::vector<T> values(const std::vector<T>& old, T outside = {}) const {
    if (old.empty()) return {};
    std::vector<T> out(to_.size(), outside);
    for (int i = 0; i < to_.nx; ++i)
      for (int j = 0; j < to_.ny; ++j) {
        const int x = i + by_.x, y = j + by_.y;
        if (x >= 0 && x < from_.nx && y >= 0 && y < from_.ny) out[to_.index(i, j)] = old[from_.index(x, y)];
      }
    return out;
  }

  const PatchGrid &to_, &from_;
  Offset by_;
};

}  // namespace railstrata::cntc
