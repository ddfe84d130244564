#include "ask/next_start.hpp"

#include <algorithm>
#include <utility>

namespace railstrata {
namespace {

bool same_grid(const PatchGrid& a, const PatchGrid& b) {
  return a.nx == b.nx && a.ny == b.ny && a.dx == b.dx && a.dy == b.dy && a.x0 == b.x0 && a.y0 == b.y0 &&
         a.line == b.line;
}

double continued(double last, double before, double share) { return last + share * (last - before); }

/// Cells that have come into contact since keep their pressure; those of the last patch stay in it, as far as the
/// pressure can tell.
void continue_pressure(double share, const Plane& before, Plane& last) {
  constexpr double kLeast = 0.05;  // of the last pressure
  for (std::size_t i = 0; i < last.size(); ++i)
    if (last[i] > 0 && before[i] > 0) last[i] = std::max(kLeast * last[i], continued(last[i], before[i], share));
}

/// Tractions of cells that were in the same state twice.
void continue_traction(double share, const TangentialSolution& before, TangentialSolution& last) {
  for (std::size_t i = 0; i < last.state.size(); ++i) {
    if (last.state[i] == ContactState::separated || last.state[i] != before.state[i]) continue;
    last.q_x[i] = continued(last.q_x[i], before.q_x[i], share);
    last.q_y[i] = continued(last.q_y[i], before.q_y[i], share);
  }
  last.extrapolated = true;
  for (double TangentialSolution::*number :
       {&TangentialSolution::creepage_x, &TangentialSolution::creepage_y, &TangentialSolution::force_y})
    last.*number = continued(last.*number, before.*number, share);
}

void continue_solution(double share, const RollingSolution& before, RollingSolution& last) {
  continue_pressure(share, before.normal.pressure, last.normal.pressure);
  continue_traction(share, before.tangential, last.tangential);
  for (double NormalSolution::*number : {&NormalSolution::load, &NormalSolution::approach})
    last.normal.*number = continued(last.normal.*number, before.normal.*number, share);
}

/// Whether the patches of both lie on the same grids.
bool same_grids(const BemNeighbour& a, const BemNeighbour& b) {
  return std::equal(a.patches.begin(), a.patches.end(), b.patches.begin(), b.patches.end(),
                    [](const BemStart& x, const BemStart& y) { return same_grid(x.grid, y.grid); });
}

void continue_patches(double share, const BemNeighbour& before, BemNeighbour& last) {
  for (std::size_t k = 0; k < last.patches.size(); ++k)
    continue_solution(share, before.patches[k].solution, last.patches[k].solution);
  constexpr double kMost = 2;  // a plane far from that descent, or none, would be kept
  last.descent = std::clamp(continued(last.descent, before.descent, share), last.descent / kMost, kMost * last.descent);
}

}  // namespace

NextStart::Coordinates NextStart::coordinates(const CaseSpec& spec) {
  Coordinates out;
  for (std::size_t k = 0; k < kState.size(); ++k) out[k] = kState[k].coordinate(spec);
  return out;
}

BemNeighbour NextStart::of(const CaseSpec& spec) const {
  constexpr double kFarthest = 2;  // steps
  const BemNeighbour& last = last_.solved;
  const BemNeighbour& before = before_.solved;
  if (last.empty() || !same_grids(last, before)) return last;
  const Coordinates now = coordinates(spec);
  double along = 0, square = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double step = last_.at[i] - before_.at[i];
    along += (now[i] - last_.at[i]) * step;
    square += step * step;
  }
  if (!(square > 0) || !(along > 0) || along > kFarthest * square) return last;
  BemNeighbour start = last;
  const double share = along / square;
  continue_patches(share, before, start);
  for (std::size_t k = 0; k < std::min(start.others.size(), before.others.size()); ++k)
    if (same_grids(start.others[k], before.others[k])) continue_patches(share, before.others[k], start.others[k]);
  return start;
}

void NextStart::add(const CaseSpec& spec, BemNeighbour solved) {
  before_ = std::move(last_);
  last_ = {coordinates(spec), std::move(solved)};
}

}  // namespace railstrata
