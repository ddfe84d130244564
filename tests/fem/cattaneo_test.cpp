// A sphere at rest, pressed by its weight and then loaded by a slowly rising torque: the contact sticks inside and
// slips in a ring that grows inward.
#include <gtest/gtest.h>

#include "small_rolling.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

struct TangentialLook {
  double ratio = 0;                         // F_x / (f N) of the moment looked at
  double a = 0, h = 0;                      // Hertz's radius, element size
  double stick_area = 0, contact_area = 0;  // of the nodes
  double centre_traction = 0;               // over f p0
};

TangentialLook look(const RollingSystem& system, const Stepper& st) {
  const double friction = system.model.spec.drive.friction_coefficient;
  TangentialLook out;
  out.ratio = st.forces().x / (friction * st.forces().z);
  out.a = system.model.hertz.a;
  out.h = system.model.spec.mesh.element_size;
  const ContactSurface& rail = system.rail_surface();
  for (int c = 1; c + 1 < rail.columns; ++c)
    for (int j = 1; j + 1 < rail.stations.nodes(); ++j) {
      const NodeTraction& t = st.state().tractions.at(c, j);
      if (t.p <= 0) continue;
      const double area =
                       0.25 * (rail.width[c - 1] + rail.width[c]) * (rail.stations.at[j + 1] - rail.stations.at[j - 1]),
                   q = std::hypot(t.q1, t.q2);
      out.contact_area += area;
      if (!t.slips()) out.stick_area += area;
      if (std::hypot(rail.node[c].y, rail.stations.at[j]) < out.h)
        out.centre_traction = std::max(out.centre_traction, q / (friction * system.model.hertz.p0));
    }
  return out;
}

CaseSpec pressed_sphere() {
  CaseSpec spec = small_case();
  spec.mesh.element_size = 1.2e-3;
  spec.mesh.fine_width = 16.8e-3;
  spec.mesh.fine_depth = 6e-3;
  spec.mesh.coarse_ratio = 3;
  spec.mesh.largest = 24e-3;
  spec.geometry.wheel_section.bore_radius = 0.36;
  spec.vehicle.wheel_mass = 300;
  spec.vehicle.sprung_mass = 8200;
  spec.drive.speed = 0;
  spec.drive.friction_coefficient = 0.3;
  spec.drive.traction_coefficient = 0.3;
  spec.drive.torque_ramp = 1e-3;
  spec.run.positions = {0.0};
  spec.run.window = 1e-3;
  spec.run.run_up = 1.0;  // the damping stays on: the wheel does not travel
  spec.run.run_up_damping = 5000;
  return spec;
}

}  // namespace

// c = a (1 - F/(f N))^(1/3) [Johnson1985 eq. 7.40]; inside it q = f p0 (sqrt(1 - r²/a²) - c/a sqrt(1 - r²/c²)).
TEST(SlowCattaneo, StickRadiusOfASphereIsWithinOneElementOfTheClosedForm) {
  const RollingSystem system = small_system(pressed_sphere());
  const double limit = system.model.spec.drive.friction_coefficient * system.model.load;
  Stepper st(system, solve_preload(system, 1e-5));
  double force = 0;
  for (double wanted : {0.3, 0.7}) {
    for (int k = 0; k < 20000 && st.forces().x < wanted * limit; ++k) {
      st.step();
      ASSERT_GE(st.forces().x, force - 1e-3 * limit);  // the closed form holds for a force that only grows
      force = std::max(force, st.forces().x);
    }
    const TangentialLook t = look(system, st);
    ASSERT_NEAR(t.ratio, wanted, 0.01);
    ASSERT_GT(t.a, 5 * t.h);
    const double c = t.a * std::cbrt(1 - t.ratio);
    EXPECT_NEAR(std::sqrt(t.contact_area / std::numbers::pi), t.a, t.h);
    EXPECT_NEAR(std::sqrt(t.stick_area / std::numbers::pi), c, t.h);
    EXPECT_NEAR(t.centre_traction, 1 - c / t.a, 0.02);
  }
  EXPECT_LT(std::abs(st.position()), 0.01 * system.model.hertz.a);
}

}  // namespace railstrata
