// Slip of the cells against Carter's closed form, and the work of friction against what is put in.
#include "bem/cell_slip.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "bem/case_patch.hpp"
#include "bem/rolling_contact.hpp"
#include "half_space_pair.hpp"
#include "tests/halfspace/classical_rolling.hpp"

namespace railstrata {
namespace {

constexpr LeadingEdge kEdges[] = {LeadingEdge::sub_cell, LeadingEdge::whole_cell};

/// Largest deviations of the slip, over the creepage of saturation.
struct SlipErrors {
  double inside = 0, at_front = 0, at_trailing_edge = 0;
};

/// The middle of a patch sixty times as wide as long, at half the creepage of saturation. With x = t a Carter's stick
/// zone is t > c = 0 and the slip behind it sqrt((1 - t)(c - t)). [Carter1926]
SlipErrors against_carter(int cells, LeadingEdge edge) {
  const double a = 2e-3, b = 120e-3, load = 4e5, friction = 0.3;
  const HertzGap gap = hertz_gap(a, b, contact_modulus(kSteel, kSteel), load);
  PatchGrid g = centred_grid(cells + 4, 20, a / cells, b / 18);
  g.x0 += 0.3 * g.dx;
  const InfluenceOperator op(pair_of(kSteel, kSteel), g.nx, g.ny, g.dx, g.dy);
  const double p0 = hertz_contact(gap.A, gap.B, contact_modulus(kSteel, kSteel), load).p0,
               saturation = carter_rolling(a, p0, 2 * gap.A, friction, 1).creepage;
  RollingContact contact;
  contact.gap = quadratic_gap(g, gap.A, gap.B);
  contact.target.load = load;
  contact.friction = friction;
  contact.leading_edge = edge;
  contact.x.creepage = 0.5 * saturation;
  const TangentialSolution s = solve_rolling(op, g, contact).tangential;
  SlipErrors out;
  for (int i = 1; i < g.nx; ++i) {
    const std::size_t k = g.index(i, g.ny / 2);
    if (s.state[k] == ContactState::separated) continue;
    const double t = g.x(i) / a, exact = t < 0 ? std::sqrt((1 - t) * -t) : 0.0,
                 error = std::abs(s.cell_slip.x[k] / saturation - exact);
    double& worst = s.state[g.index(i - 1, g.ny / 2)] == ContactState::separated ? out.at_trailing_edge
                    : std::abs(g.x(i)) < 1.5 * g.dx                              ? out.at_front
                                                                                 : out.inside;
    worst = std::max(worst, error);
  }
  return out;
}

// The slip of the step alone, half a cell ahead of the traction, is 6 % off on 20 cells and 4 % on 40.
TEST(CellSlip, AlongALongPatchIsCartersToTheTrailingEdgeAndLikeARootAtTheFront) {
  for (const LeadingEdge edge : kEdges) {
    double front[3];
    for (int k = 0; k < 3; ++k) {
      const SlipErrors e = against_carter(10 << k, edge);
      EXPECT_LT(e.inside, 0.01);
      EXPECT_LT(e.at_trailing_edge, 0.003);
      front[k] = e.at_front;
    }
    EXPECT_LT(front[0], 0.08);
    EXPECT_NEAR(front[2] / front[0], 0.5, 0.06) << "order one half";
  }
}

/// Powers over V, N.
struct Balance {
  double put_in = 0;  ///< forces times creepages, moment times spin and, where the radius varies, of each cell its own;
                      ///< and the axle's torque against the pressure
  double taken = 0;   ///< by friction
  double of_cells = 0;  ///< sum of traction times slip times area
};

/// The pressure's work on the gap that comes and goes is that of a pressure off the middle, which layers make.
Balance balance(const PatchGrid& g, const RollingContact& contact, const RollingSolution& s) {
  const TangentialSolution& t = s.tangential;
  Balance out;
  for (int i = 1; i + 1 < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      const std::size_t k = g.index(i, j);
      if (t.state[k] == ContactState::separated) continue;
      const double opens = (contact.gap[g.index(i + 1, j)] - contact.gap[g.index(i - 1, j)]) / (2 * g.dx),
                   spin =
                       contact.spin + (contact.local_spin.empty() ? 0.0 : contact.local_spin[static_cast<size_t>(j)]);
      const double x = t.creepage_x - contact.spin * g.y(j) +
                       (contact.extra_slip.x.empty() ? 0 : contact.extra_slip.x[k]),
                   y = t.creepage_y + spin * g.x(i);
      out.put_in += (t.q_x[k] * x + t.q_y[k] * y + s.normal.pressure[k] * opens) * g.cell_area();
      out.of_cells += (t.q_x[k] * t.cell_slip.x[k] + t.q_y[k] * t.cell_slip.y[k]) * g.cell_area();
    }
  out.taken = t.dissipation;
  return out;
}

struct Pair {
  const char *wheel, *rail;
  double shift;
  double of_cells;  ///< largest deviation of the cells' own products
};

CaseSpec on_a_layer(const Pair& pair, double thickness, double ratio) {
  CaseSpec spec;
  spec.geometry.wheel_profile = pair.wheel;
  spec.geometry.rail_profile = pair.rail;
  spec.geometry.lateral_shift = pair.shift;
  if (!(thickness > 0)) return spec;
  LayerSpec layer;
  layer.thickness = thickness;
  layer.material.young = ratio * spec.rail_material.young;
  spec.layers.push_back(layer);
  return spec;
}

struct Driven {
  double traction, lateral, spin;
};

// Default cells, LMA on CN60 and S1002 on UIC60: what friction takes is what comes in, and the cells' own products are
// within 0.5 % of it (with traction and slip both of the end of a step 3 to 12 % were lacking). Whole cells stick under
// the slip of another place where they spin.
void expect_balance(const CaseSpec& spec, double of_cells, const std::string& which) {
  const Placement placement = place(spec, {});
  const double weight = spec.vehicle.load();
  CasePatch patch = make_case_patch(spec, placement, {}, {.load = weight, .approach = {}});
  for (const Driven& d : {Driven{0.2, 0, 0}, {0.45, 0, 0}, {0, 0, 0.6}, {0.2, 5e-4, -0.3}})
    for (const LeadingEdge edge : kEdges) {
      RollingContact& c = patch.contact;
      c.leading_edge = edge;
      c.x.force = -d.traction * weight;
      c.y.creepage = d.lateral;
      c.spin = d.spin != 0 ? d.spin : wheel_spin(placement.contact);
      const Balance b = balance(patch.grid, c, solve_rolling(*patch.influence, patch.grid, c));
      const bool elsewhere = edge == LeadingEdge::whole_cell && d.spin != 0;
      EXPECT_NEAR(b.taken / b.put_in, 1, elsewhere ? 0.015 : 2e-3) << which << ' ' << d.traction << ' ' << d.spin;
      EXPECT_NEAR(b.of_cells / b.put_in, 1, elsewhere ? 0.015 : of_cells)
          << which << ' ' << d.traction << ' ' << d.spin;
    }
}

TEST(CellSlip, FrictionTakesWhatForcesCreepagesMomentAndSpinPutIn) {
  for (const Pair& pair : {Pair{"LMA", "CN60", 1.5e-3, 0.005}, Pair{"S1002", "UIC60", 2e-3, 0.006}})
    for (const auto& [thickness, ratio] : {std::pair(0.0, 1.0), std::pair(2e-3, 2.0), std::pair(2e-3, 0.5)})
      expect_balance(on_a_layer(pair, thickness, ratio), pair.of_cells,
                     fmt::format("{} {} {}", pair.wheel, thickness, ratio));
}

// From rest: the work of the forces is stored in the bodies or taken by friction, in every step.
TEST(CellSlip, StepsOfRollingStoreOrDissipateTheWorkOfTheForces) {
  const ReferenceContact c(1.2, 0.9, 0.5e-3);
  const auto energy = [&](const TangentialSolution& s) {
    Plane x(c.grid.size()), y(c.grid.size());
    c.influence.tangential(s.q_x.data(), s.q_y.data(), x.data(), y.data(), c.grid.nx);
    return 0.5 * (dot(s.q_x, x) + dot(s.q_y, y)) * c.grid.cell_area();
  };
  for (const LeadingEdge edge : kEdges) {
    RollingContact p;
    p.gap = quadratic_gap(c.grid, 1.2, 0.9);
    p.target.load = c.kLoad;
    p.friction = c.kFriction;
    p.leading_edge = edge;
    p.kind = RollingKind::shift;
    p.x.force = -0.3 * c.kFriction * c.kLoad;
    RollingSolution s = solve_rolling(c.influence, c.grid, p);
    p.x = {-1.5e-3, {}};
    p.y = {5e-4, {}};
    double work = 0, friction = 0;
    const double stored = energy(s.tangential);
    for (int step = 0; step < 30; ++step) {
      const RollingSolution last = s;
      roll_on_one_cell(c.influence, c.grid, last, p);
      s = solve_rolling(c.influence, c.grid, p, {}, &last);
      const TangentialSolution &t = s.tangential, &before = last.tangential;
      work +=
          0.5 * c.grid.dx * ((t.force_x + before.force_x) * p.x.creepage + (t.force_y + before.force_y) * p.y.creepage);
      friction += t.dissipation * c.grid.dx;
    }
    EXPECT_NEAR((energy(s.tangential) - stored + friction) / work, 1, edge == LeadingEdge::whole_cell ? 1e-4 : 1e-3);
  }
}

}  // namespace
}  // namespace railstrata
