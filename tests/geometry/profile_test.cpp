#include "geometry/profile.hpp"

#include <gtest/gtest.h>

#include "geometry/placement.hpp"

namespace railstrata {
TEST(Scratch, numbers) {
  for (auto w : {"LMA", "S1002"})
    for (auto r : {"CN60", "UIC60", "UIC54"}) {
      const Profile wheel = builtin_profile(ProfileKind::wheel, w), rail = builtin_profile(ProfileKind::rail, r);
      const RigidContact c = place_wheel(wheel, rail, {});
      std::printf("%s %s knots %zu offset %.6f mm wheel y %.6f rail s %.6f angle %.4f mrad r %.6f kw %.5g kr %.5g z %.6f\n", w, r, wheel.knots().size(), 1e3 * c.wheel_offset_y,
                  1e3 * wheel.at(c.wheel_s).position.y, 1e3 * c.rail_s, 1e3 * c.angle, c.rolling_radius, c.curvature_wheel_lateral, c.curvature_rail_lateral, 1e3*c.wheel_offset_z);
      const auto o = rail_outline(rail);
      const auto p = section_properties(outline_polygon(rail, o));
      std::printf("A %.5f cm2 c %.4f Ih %.4f Iv %.4f flank %.4f\n", 1e4 * p.area, 1e3 * p.centroid_height, 1e8 * p.i_horizontal, 1e8 * p.i_vertical, 1e3 * o.flank_y);
    }
}
}  // namespace railstrata
