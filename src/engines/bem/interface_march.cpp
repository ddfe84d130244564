#include "bem/interface_march.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/faults.hpp"
#include "core/stop_request.hpp"

namespace railstrata {
namespace {

constexpr double kShearTolerance = 5e-4;   // of the largest shear of the loads
constexpr double kSteadyTolerance = 1e-4;  // of the largest slip, a step
constexpr int kMostTurns = 2000;           // of alternating directions
constexpr double kFurther = 1.6;           // over-relaxation
constexpr double kCounts = 0.1;            // of the fastest slip: cells that slip

double largest_size(const PlanePair& v) {
  double most = 0;
  for (std::size_t k = 0; k < v.x.size(); ++k) most = std::max(most, std::hypot(v.x[k], v.y[k]));
  return most;
}

double pair_change(const PlanePair& a, const PlanePair& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.x.size(); ++k) most = std::max(most, std::hypot(a.x[k] - b.x[k], a.y[k] - b.y[k]));
  return most;
}

}  // namespace

InterfaceMarch::InterfaceMarch(InterfaceWaves waves, const ShearLimit& limit, int border)
    : waves_(std::move(waves)), limit_(limit), border_(border) {
  const PatchGrid& g = waves_.grid();
  hold_ = std::sqrt(waves_.stiffest() * waves_.stiffness_over(0.5 * g.nx * g.dx));
  const Plane none(g.size(), 0.0), row(static_cast<std::size_t>(g.ny), 0.0);
  slip_ = shear_ = rate_ = {none, none};
  ahead_ = {row, row};
}

bool InterfaceMarch::held(int i, int j) const {
  const PatchGrid& g = waves_.grid();
  const int side = border_ / 3;  // nothing enters or leaves there
  return i < border_ || i >= g.nx - border_ || (!g.line && (j < side || j >= g.ny - side));
}

PlanePair InterfaceMarch::left() const {
  const PatchGrid& g = waves_.grid();
  PlanePair out = ahead_;
  for (int j = 0; j < g.ny; ++j) {
    out.x[static_cast<std::size_t>(j)] = slip_.x[g.index(border_, j)];
    out.y[static_cast<std::size_t>(j)] = slip_.y[g.index(border_, j)];
  }
  return out;
}

void InterfaceMarch::turn_to_next() { ahead_ = left(); }

/// One step of alternating directions; whether both hold.
bool InterfaceMarch::settle(const InterfaceLoad& load, const PlanePair& before, const Plane& bound) {
  const PatchGrid& g = waves_.grid();
  PlanePair right = load.shear;
  for (std::size_t k = 0; k < g.size(); ++k) {
    right.x[k] += hold_ * slip_.x[k] - shear_.x[k];
    right.y[k] += hold_ * slip_.y[k] - shear_.y[k];
  }
  const PlanePair free = waves_.slip_under(right, hold_);
  double apart = 0, moved = 0;
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      const std::size_t k = g.index(i, j);
      const double x = kFurther * free.x[k] + (1 - kFurther) * slip_.x[k] + shear_.x[k] / hold_,
                   y = kFurther * free.y[k] + (1 - kFurther) * slip_.y[k] + shear_.y[k] / hold_;
      const double dx = x - before.x[k], dy = y - before.y[k], size = std::sqrt(dx * dx + dy * dy);
      const double share = held(i, j) || !(hold_ * size > bound[k]) ? 0 : 1 - bound[k] / (hold_ * size);
      const double slip_x = before.x[k] + share * dx, slip_y = before.y[k] + share * dy;
      apart = std::max({apart, std::abs(free.x[k] - slip_x), std::abs(free.y[k] - slip_y)});
      moved = std::max({moved, std::abs(slip_x - slip_.x[k]), std::abs(slip_y - slip_.y[k])});
      slip_.x[k] = slip_x;
      slip_.y[k] = slip_y;
      shear_.x[k] = hold_ * (x - slip_x);
      shear_.y[k] = hold_ * (y - slip_y);
    }
  return hold_ * std::max(apart, moved) <= kShearTolerance * largest_size(load.shear);
}

void InterfaceMarch::step(const InterfaceLoad& load) {
  const PatchGrid& g = waves_.grid();
  PlanePair before = slip_;
  const int front = g.nx - border_;  // from there on slip turns from what lies ahead to what lies behind
  for (int j = 0; j < g.ny; ++j) {
    const std::size_t row = static_cast<std::size_t>(j), rear = g.index(0, j);
    for (int i = 0; i < front; ++i) {
      before.x[g.index(i, j)] = slip_.x[g.index(i + 1, j)];
      before.y[g.index(i, j)] = slip_.y[g.index(i + 1, j)];
    }
    for (int i = front; i < g.nx; ++i) {
      const double t = static_cast<double>(i - front) / border_, share = t * t * (3 - 2 * t);
      before.x[g.index(i, j)] = ahead_.x[row] + share * (before.x[rear] - ahead_.x[row]);
      before.y[g.index(i, j)] = ahead_.y[row] + share * (before.y[rear] - ahead_.y[row]);
    }
  }
  Plane bound(g.size(), limit_.shear);
  if (limit_.friction > 0) {
    const Plane more = waves_.pressure(slip_);
    for (std::size_t k = 0; k < g.size(); ++k) bound[k] += limit_.friction * std::max(0.0, load.pressure[k] + more[k]);
  }
  int turns = 0;
  while (!settle(load, before, bound))
    if (++turns > kMostTurns) throw NumericalError("the slip of the interface does not settle under its shear limit");
  for (std::size_t k = 0; k < g.size(); ++k) {
    rate_.x[k] = slip_.x[k] - before.x[k];
    rate_.y[k] = slip_.y[k] - before.y[k];
  }
}

InterfacePassage InterfaceMarch::pass(const InterfaceLoad& load) {
  const PatchGrid& g = waves_.grid();
  for (int cells = 0; cells < 2 * g.nx; ++cells) {
    stop_if_requested();
    const PlanePair last = slip_;
    step(load);
    if (pair_change(slip_, last) <= kSteadyTolerance * largest_size(slip_)) break;
  }
  InterfacePassage out;
  const double fastest = largest_size(rate_);
  for (std::size_t k = 0; k < g.size(); ++k) {
    const std::size_t row = k % static_cast<std::size_t>(g.ny);
    const double slip = std::hypot(slip_.x[k] - ahead_.x[row], slip_.y[k] - ahead_.y[row]);
    out.largest = std::max(out.largest, slip);
    if (k < g.index(border_ + 1, 0) && k >= g.index(border_, 0)) out.left = std::max(out.left, slip);
    const double rate = std::hypot(rate_.x[k], rate_.y[k]);
    if (!held(static_cast<int>(k) / g.ny, static_cast<int>(row)))
      out.shear = std::max(out.shear, std::hypot(shear_.x[k], shear_.y[k]));
    if (rate > kCounts * fastest) out.area += g.cell_area();
    out.work += (shear_.x[k] * rate_.x[k] + shear_.y[k] * rate_.y[k]) * g.cell_area() / g.dx;
  }
  return out;
}

}  // namespace railstrata
