// The solver over its whole range: every traction from none to full slide, axis ratios 0.1 to 10, equal, dissimilar and
// layered bodies, uniform and local friction.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "bem/rolling_contact.hpp"
#include "half_space_pair.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {
namespace {

struct Bodies {
  const char* name;
  LayeredHalfSpace rail;
  double friction;
};
std::ostream& operator<<(std::ostream& out, const Bodies& b) { return out << b.name; }

constexpr double kLoad = 8e4;

/// 15 x 15 cells around an ellipse of 5 mm mean semi-axis, with room for the patch to grow by a half on a soft layer.
struct Patch {
  PatchGrid grid;
  InfluenceOperator influence;
  RollingContact contact;
  double slope;  // of the surface under full friction: the size of a large creepage
  Patch(const Bodies& bodies, double axis_ratio)
      : grid(centred_grid(10, 10, 5e-3 * std::sqrt(axis_ratio) / 7, 5e-3 / std::sqrt(axis_ratio) / 7)),
        influence(combined_compliance(homogeneous_compliance(kSteel), layered_compliance(bodies.rail)), grid.nx,
                  grid.ny, grid.dx, grid.dy) {
    const double modulus = contact_modulus(kSteel, bodies.rail.substrate);
    const HertzGap gap = hertz_gap(7 * grid.dx, 7 * grid.dy, modulus, kLoad);
    slope = bodies.friction * hertz_contact(gap.A, gap.B, modulus, kLoad).p0 / modulus;
    contact.gap = quadratic_gap(grid, gap.A, gap.B);
    contact.target.load = kLoad;
    contact.friction = bodies.friction;
  }
  /// A friction coefficient that falls across the patch and is nothing at one side.
  void friction_field() {
    contact.local_friction.resize(grid.size());
    for (int i = 0; i < grid.nx; ++i)
      for (int j = 0; j < grid.ny; ++j)
        contact.local_friction[grid.index(i, j)] = contact.friction * std::max(0.0, 1.2 * (j + 0.5) / grid.ny - 0.2);
  }
  /// Friction the converged pressure can give (dissimilar bodies shift it); with a field it depends a little on the
  /// traction.
  double available() const {
    const NormalSolution s = solve_normal(influence, grid, contact.gap, contact.target);
    double f = 0;
    for (std::size_t k = 0; k < grid.size(); ++k)
      f += s.pressure[k] * grid.cell_area() *
           (contact.local_friction.empty() ? contact.friction : contact.local_friction[k]);
    return f;
  }
};

/// Normal and frictional contact conditions in every cell; lengths and tractions over their own sizes.
void expect_contact(const Patch& p, const RollingContact& c, const RollingSolution& s, const std::string& what) {
  const TangentialSolution& t = s.tangential;
  EXPECT_NEAR(s.normal.load, kLoad, 1e-5 * kLoad) << what;
  ASSERT_FALSE(s.normal.touches_edge) << what;
  double rigid = 0;
  for (std::size_t k = 0; k < p.grid.size(); ++k) rigid = std::max(rigid, std::hypot(t.slip.x[k], t.slip.y[k]));
  for (std::size_t k = 0; k < p.grid.size(); ++k) {
    const double g = (c.local_friction.empty() ? c.friction : c.local_friction[k]) * s.normal.pressure[k],
                 q = std::hypot(t.q_x[k], t.q_y[k]), slip = std::hypot(t.slip.x[k], t.slip.y[k]);
    ASSERT_GE(s.normal.pressure[k], 0) << what;
    ASSERT_LE(q, g * (1 + 1e-9) + 1e-3) << what;
    if (slip > 1e-3 * rigid && g > 0) {
      ASSERT_GE(t.q_x[k] * t.slip.x[k] + t.q_y[k] * t.slip.y[k], 0.99 * g * slip)
          << what << ": slip along the traction, which is f p";
    }
  }
  if (c.x.force) {
    EXPECT_NEAR(t.force_x, *c.x.force, 1e-5 * c.friction * kLoad) << what;
  }
  if (c.y.force) {
    EXPECT_NEAR(t.force_y, *c.y.force, 1e-5 * c.friction * kLoad) << what;
  }
}

class ContactOf : public testing::TestWithParam<Bodies> {
 protected:
  /// Forces along x, along y and across.
  void expect_convergence(const Patch& p, RollingKind kind, std::initializer_list<double> levels,
                          const std::string& what) const {
    const double available = p.available();
    for (double level : levels)
      for (double angle : {0.0, 0.5, 0.7}) {  // times pi
        RollingContact c = p.contact;
        c.kind = kind;
        if (angle != 0.5) c.x.force = level * available * std::cos(angle * std::numbers::pi);
        if (angle != 0.0) c.y.force = level * available * std::sin(angle * std::numbers::pi);
        const std::string where = what + " level " + std::to_string(level) + " angle " + std::to_string(angle);
        ASSERT_NO_THROW(expect_contact(p, c, solve_rolling(p.influence, p.grid, c), where)) << where;
      }
  }
};

TEST_P(ContactOf, ConvergesForEveryTractionAndAxisRatio) {
  for (double ratio : {0.1, 0.3, 1.0, 3.0, 10.0}) {
    const std::string what = "a/b " + std::to_string(ratio);
    Patch p(GetParam(), ratio);
    expect_convergence(p, RollingKind::steady, {0.0, 1e-3, 0.1, 0.5, 0.9, 0.99, 0.9999}, what);
    if (ratio != 0.3 && ratio != 3)
      expect_convergence(p, RollingKind::shift, {0.0, 0.1, 0.5, 0.9, 0.9999}, what + " shift");
    for (double level : {1e-3, 0.1, 1.0, 100.0}) {
      RollingContact c = p.contact;
      c.x.creepage = level * p.slope;
      c.y.creepage = -0.5 * level * p.slope;
      c.spin = 10 * level * p.slope;
      const RollingSolution s = solve_rolling(p.influence, p.grid, c);
      expect_contact(p, c, s, what + " creepage " + std::to_string(level));
      if (level > 10) {
        EXPECT_EQ(s.tangential.stick_area, 0);
      }
    }
    p.friction_field();
    expect_convergence(p, RollingKind::steady, {0.1, 0.7}, what + " field");
  }
}
INSTANTIATE_TEST_SUITE_P(Bodies, ContactOf,
                         testing::Values(Bodies{"equal", {{}, kSteel}, 0.4},
                                         Bodies{"dissimilar", {{}, {100e9, 0.15}}, 0.4},
                                         Bodies{"strongly coupled", {{}, {2.1e9, 0.1}}, 1.0},
                                         Bodies{"stiff layer", {{{1e-3, {840e9, 0.3}}}, kSteel}, 0.4},
                                         Bodies{"soft layer", {{{1e-3, {52.5e9, 0.3}}}, kSteel}, 0.4}),
                         [](const auto& body) {
                           std::string name = body.param.name;
                           for (char& c : name)
                             if (c == ' ') c = '_';
                           return name;
                         });

}  // namespace
}  // namespace railstrata
