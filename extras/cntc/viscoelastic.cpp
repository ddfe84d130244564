#include "cntc/viscoelastic.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/faults.hpp"

namespace railstrata::cntc {

HalfSpaceMaterial soft(const HalfSpaceMaterial& m, const Viscosity& v) { return {m.young / (1 + v.share), m.poisson}; }

Delay::Delay(const Materials& m, const PatchGrid& g, double speed)
    : grid_(g),
      pair_(combined_compliance(homogeneous_compliance(m.body[0]), homogeneous_compliance(m.body[1]))),
      share_(m.viscosity->share),
      way_(speed * m.viscosity->time),
      kernel_((2 * static_cast<std::size_t>(g.nx) + 1) * static_cast<std::size_t>(g.ny)) {
  for (int j = 0; j < g.ny; ++j) fill_row(j);
}

Delay::Kernel Delay::weighted(Kernel sum, double w, const RectangleInfluence& v) {
  return {sum.nn + w * v.nn, sum.xx + w * v.xx, sum.xy + w * v.xy, sum.yy + w * v.yy};
}

/// The part of R between `from` and `to` ahead of x, by Gauss's rule in exp(-distance / way).
Delay::Kernel Delay::late(double x, double y, double from, double to) const {
  constexpr double kNode[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
  constexpr double kWeight[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                0.2369268850561891};
  const double begin = std::exp(-from / way_), left = std::expm1(-(to - from) / way_);  // below 0
  Kernel out;
  for (int k = 0; k < 5; ++k) {
    const double passed = 0.5 * (1 + kNode[k]) * left, ahead = from - way_ * std::log1p(passed);
    out = weighted(out, -0.5 * kWeight[k] * left * begin, rectangle_influence(pair_, x + ahead, y, grid_.dx, grid_.dy));
  }
  return out;
}

/// From the farthest offset ahead down: R at x is what lies within a cell ahead and the rest of R one cell on.
void Delay::fill_row(int j) {
  constexpr double kForgotten = 40;  // exp(-40)
  const double y = j * grid_.dy, dx = grid_.dx, far = grid_.nx * dx, kept = std::exp(-dx / way_);
  const auto add = [](Kernel a, double w, const Kernel& b) {
    return Kernel{a.nn + w * b.nn, a.xx + w * b.xx, a.xy + w * b.xy, a.yy + w * b.yy};
  };
  Kernel R;
  const double first = std::min(far, way_);
  for (double from = 0, length = first; from < kForgotten * way_; from += length, length = std::max(first, 0.5 * from))
    R = add(R, 1, late(far, y, from, from + length));
  for (int i = grid_.nx; i >= -grid_.nx; --i) {
    const double x = i * dx;
    if (i < grid_.nx) R = add(add(late(x, y, 0, 0.5 * dx), 1, late(x, y, 0.5 * dx, dx)), kept, R);
    const RectangleInfluence at_once = rectangle_influence(pair_, x, y, dx, grid_.dy);
    Kernel& out = kernel_[static_cast<std::size_t>(i + grid_.nx) * static_cast<std::size_t>(grid_.ny) +
                          static_cast<std::size_t>(j)];
    out = add({}, share_, weighted(R, -1, at_once));
  }
}

Plane Delay::normal(const Plane& p) const {
  Plane out(grid_.size(), 0.0);
  for (int m = 0; m < grid_.nx; ++m)
    for (int n = 0; n < grid_.ny; ++n) {
      const double source = p[grid_.index(m, n)];
      if (source == 0) continue;
      for (int i = 0; i < grid_.nx; ++i)
        for (int j = 0; j < grid_.ny; ++j) out[grid_.index(i, j)] += at(i - m, std::abs(j - n)).nn * source;
    }
  return out;
}

PlanePair Delay::tangential(const Plane& q_x, const Plane& q_y) const {
  const std::size_t cells = grid_.size() + static_cast<std::size_t>(grid_.ny);
  PlanePair out{Plane(cells, 0.0), Plane(cells, 0.0)};
  for (int m = 0; m < grid_.nx; ++m)
    for (int n = 0; n < grid_.ny; ++n) {
      const std::size_t from = grid_.index(m, n);
      if (q_x[from] == 0 && q_y[from] == 0) continue;
      for (int i = 0; i <= grid_.nx; ++i)
        for (int j = 0; j < grid_.ny; ++j) {
          const Kernel& k = at(i - m, std::abs(j - n));
          const double across = j < n ? -k.xy : k.xy;
          out.x[grid_.index(i, j)] += k.xx * q_x[from] + across * q_y[from];
          out.y[grid_.index(i, j)] += across * q_x[from] + k.yy * q_y[from];
        }
    }
  return out;
}

namespace {

/// The slip by a displacement, rail minus wheel, over the step from the cell ahead.
Plane slip_of(const PatchGrid& g, const Plane& u) {
  Plane out(g.size());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = (u[k + static_cast<std::size_t>(g.ny)] - u[k]) / g.dx;
  return out;
}

double largest_change(const Plane& a, const Plane& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

}  // namespace

RollingSolution solve_delayed(const InfluenceOperator& of_soft_bodies, const Materials& materials, const PatchGrid& g,
                              RollingContact c, const RollingOptions& options, const RollingSolution* start,
                              std::array<Plane, 3>& late) {
  constexpr int kMostTurns = 200;
  const Delay delay(materials, g, c.speed);
  const Plane gap = c.gap;
  PlanePair extra = c.extra_slip;
  for (Plane* part : {&extra.x, &extra.y}) part->resize(g.size(), 0.0);
  RollingSolution s = solve_rolling(of_soft_bodies, g, c, options, start);
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const TangentialSolution& t = s.tangential;
    PlanePair u = delay.tangential(t.q_x, t.q_y);
    late = {delay.normal(s.normal.pressure), {}, {}};
    c.gap = gap;
    add_scaled(c.gap, 1, late[0]);
    c.extra_slip = extra;
    add_scaled(c.extra_slip.x, 1, slip_of(g, u.x));
    add_scaled(c.extra_slip.y, 1, slip_of(g, u.y));
    u.x.resize(g.size());
    u.y.resize(g.size());
    late[1] = std::move(u.x);
    late[2] = std::move(u.y);
    const RollingSolution before = std::exchange(s, solve_rolling(of_soft_bodies, g, c, options, &s));
    const double allowed =
        options.coupling_tolerance * *std::max_element(s.normal.pressure.begin(), s.normal.pressure.end());
    if (largest_change(s.normal.pressure, before.normal.pressure) <= allowed &&
        largest_change(s.tangential.q_x, before.tangential.q_x) <= allowed &&
        largest_change(s.tangential.q_y, before.tangential.q_y) <= allowed)
      return s;
  }
  throw NumericalError("the delayed displacement of viscoelastic bodies does not settle");
}

}  // namespace railstrata::cntc
