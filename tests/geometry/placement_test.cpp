#include "geometry/placement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/faults.hpp"
#include "geometry/profile_names.hpp"

namespace railstrata {
namespace {

constexpr double mm = 1e-3;

Profile wheel(const std::string& name) { return builtin_profile(ProfileKind::wheel, name); }
Profile rail(const std::string& name) { return builtin_profile(ProfileKind::rail, name); }

TrackGeometry upright() {
  TrackGeometry track;
  track.cant = 0;
  return track;
}

/// Smallest vertical gap found by brute force over the wheel's lateral coordinate.
double brute_force_gap(const Profile& w, const Profile& r, const TrackGeometry& track, const RigidContact& c) {
  double smallest = 1;
  for (double s = r.s_min(); s < r.s_max(); s += 2e-6) {
    const Vec2 p = rail_to_model(track, r.at(s).position);
    const double y = p.y - c.wheel_offset_y;
    if (y > w.y_min() && y < w.y_max()) smallest = std::min(smallest, w.height(y) + c.wheel_offset_z - p.z);
  }
  return smallest;
}

TEST(Placement, LMA_on_CN60_at_1_in_40_touches_on_the_rails_axis_on_the_wheels_cone) {
  const Profile lma = wheel("LMA"), cn60 = rail("CN60");
  const RigidContact c = place_wheel(lma, cn60, {});
  EXPECT_NEAR(lma.at(c.wheel_s).position.y, 6.06 * mm, 0.01 * mm);
  EXPECT_NEAR(c.rail_s, 0, 1e-9);
  EXPECT_NEAR(c.angle, std::atan(1.0 / 40), 1e-6);  // the cone's 1:40 is the cant
  EXPECT_NEAR(c.angle, 25e-3, 0.01e-3);
  EXPECT_NEAR(c.rolling_radius, 0.430 - 0.1715 * mm, 1e-3 * mm);
  EXPECT_NEAR(c.curvature_rail_lateral, 1 / 0.3, 1e-9);
  EXPECT_NEAR(c.curvature_wheel_lateral, 0, 1e-9);
  EXPECT_NEAR(c.curvature_rolling, std::cos(c.angle) / c.rolling_radius, 1e-12);
  EXPECT_NEAR(c.axle_height, c.point.z + c.rolling_radius, 1e-12);
}

TEST(Placement, every_built_in_pair_just_touches_over_a_range_of_shifts) {
  for (const char* w : {"LMA", "S1002"})
    for (const char* r : {"CN60", "UIC60", "UIC54"})
      for (const double shift : {-5.0, 0.0, 1.5, 6.0}) {
        const Profile wp = wheel(w), rp = rail(r);
        TrackGeometry track;
        track.lateral_shift = shift * mm;
        const RigidContact c = place_wheel(wp, rp, track);
        EXPECT_NEAR(brute_force_gap(wp, rp, track, c), 0, 1e-9) << w << " " << r << " " << shift;
        const Vec2 on_wheel = wp.at(c.wheel_s).position;
        EXPECT_NEAR(norm(Vec2{on_wheel.y + c.wheel_offset_y, on_wheel.z + c.wheel_offset_z} - c.point), 0, 1e-12);
        const Vec2 wheel_tangent = wp.at(c.wheel_s).tangent,
                   rail_tangent = rail_to_model(track, rp.at(c.rail_s).tangent);
        EXPECT_NEAR(cross(wheel_tangent, rail_tangent), 0, 1e-6) << w << " " << r << " " << shift;
      }
}

TEST(Placement, the_gauge_is_measured_16_mm_below_the_top_of_the_canted_rail) {
  const RigidContact c = place_wheel(wheel("LMA"), rail("CN60"), {});
  const double rail_axis = 0.5 * 1.353 + 0.070 - c.wheel_offset_y,
               face = 0.5 * 1.435 - rail_axis;  // from the track's centre; from the rail's axis
  const Profile cn60 = rail("CN60");
  const double top = rail_to_model({}, cn60.at(cn60.s_at_y(7.5 * mm)).position).z;
  double nearest = 1;
  for (double s = cn60.s_min(); s < -0.02; s += 1e-6) {
    const Vec2 p = rail_to_model({}, cn60.at(s).position);
    if (std::abs(p.z - (top - 16 * mm)) < 2e-6) nearest = std::min(nearest, std::abs(p.y - face));
  }
  EXPECT_LT(nearest, 1e-6);
}

TEST(Placement, a_far_shift_to_the_gauge_side_brings_the_flange_to_the_gauge_face) {
  TrackGeometry track;
  track.lateral_shift = 10 * mm;  // to the field side: the flange, on the gauge side, meets the rail
  const RigidContact c = place_wheel(wheel("LMA"), rail("CN60"), track);
  EXPECT_LT(c.point.y, -25 * mm);
  EXPECT_LT(c.angle, 70 * M_PI / 180 + 0.01);
  EXPECT_GT(std::abs(c.angle), 0.5);
}

TEST(Placement, arcs_touch_where_their_centres_are_in_line) {  // plane on a circle, cant turned about the crown
  TrackGeometry track = upright();
  track.lateral_shift = 4 * mm;
  const RigidContact two_arcs = place_wheel(wheel("arc:R=500 mm"), rail("arc:R=300 mm"), track);
  const double y = 4 * mm * 300 / 800;  // on the line from one centre to the other
  EXPECT_NEAR(std::sin(-two_arcs.angle), 4e-3 / 0.8, 1e-9);
  EXPECT_NEAR(two_arcs.point.y, y, 1e-9);

  const RigidContact hollow = place_wheel(wheel("arc:R=-450 mm"), rail("arc:R=300 mm"), track);
  EXPECT_NEAR(std::sin(-hollow.angle), -4e-3 / 0.15, 1e-8);
}

// A ball of the wheel's radius, turned about its own vertical, is the same ball.
TEST(Placement, yaw_does_not_move_the_contact_of_a_ball) {
  TrackGeometry track = upright();
  track.lateral_shift = 30 * mm;
  track.wheel_radius = 0.4;
  const Profile ball = wheel("arc:R=400 mm"), head = rail("arc:R=300 mm");
  const RigidContact straight = place_wheel(ball, head, track);
  ASSERT_GT(std::abs(straight.angle), 0.04);
  for (const double yaw : {-0.05, 0.005, 0.05}) {
    track.yaw = yaw;
    const RigidContact c = place_wheel(ball, head, track);
    EXPECT_NEAR(c.x, 0, 1e-9) << yaw;
    EXPECT_NEAR(norm(c.point - straight.point), 0, 1e-9) << yaw;
    EXPECT_NEAR(c.axle_height, straight.axle_height, 1e-12) << yaw;
    EXPECT_NEAR(c.rolling_radius, c.axle_height - c.point.z, 1e-12) << yaw;
  }
}

/// The same over the wheel's lower surface around the contact, turned about the vertical by the yaw.
double brute_force_gap_of_yawed(const Profile& w, const Profile& r, const TrackGeometry& track, const RigidContact& c) {
  const double yaw = std::atan(track.yaw);
  double smallest = 1;
  for (double s = c.wheel_s - 10 * mm; s < std::min(w.s_max(), c.wheel_s + 10 * mm); s += 1e-5) {
    const Vec2 p = w.at(s).position;
    const double radius = track.wheel_radius - p.z;
    for (double x = -4 * mm; x <= 8 * mm; x += 0.1 * mm) {
      const double y = c.wheel_offset_y + p.y * std::cos(yaw) + x * std::sin(yaw),
                   z = c.axle_height - std::sqrt(radius * radius - x * x);
      const Vec2 on_rail = model_to_rail(track, {y, z});
      if (on_rail.y > r.y_min() && on_rail.y < r.y_max())
        smallest = std::min(smallest, on_rail.z - r.height(on_rail.y));
    }
  }
  return smallest;
}

TEST(Placement, a_yawed_wheel_just_touches_and_before_the_axle_where_the_contact_is_steep) {
  const Profile lma = wheel("LMA"), cn60 = rail("CN60");
  for (const double shift : {0.0, 9.5}) {
    TrackGeometry track;
    track.lateral_shift = shift * mm;
    track.yaw = 0.01;
    const RigidContact c = place_wheel(lma, cn60, track);
    EXPECT_NEAR(brute_force_gap_of_yawed(lma, cn60, track, c), 0, 1e-7) << shift;
    const double sideways = lma.at(c.wheel_s).position.y * std::sin(c.yaw);
    EXPECT_NEAR((c.x + sideways) / (c.rolling_radius * std::tan(c.angle) * std::tan(c.yaw)), 1, 1e-3) << shift;
    EXPECT_GT(c.x + sideways, 0) << shift;
  }
}

TEST(Placement, a_plane_touches_a_canted_crown_at_its_top) {
  TrackGeometry track;
  const RigidContact c = place_wheel(wheel("flat"), rail("arc:R=300 mm"), track);
  EXPECT_NEAR(c.angle, 0, 1e-9);
  EXPECT_NEAR(c.rail_s, 0.3 * std::atan(1.0 / 40), 1e-9);
}

TEST(Placement, of_equal_gaps_the_one_nearest_the_tape_circle_is_taken) {
  TrackGeometry track = upright();
  track.lateral_shift = 1.234 * mm;
  const RigidContact c = place_wheel(wheel("flat"), rail("flat"), track);
  EXPECT_NEAR(c.point.y, 1.234 * mm, 0.05 * mm);
  EXPECT_EQ(c.wheel_offset_z, 0);
}

/// Two crowns of R = 100 mm at y = -12 and 12 mm with a hollow of the same radius between them.
Profile two_crowns() {
  constexpr double kR = 100 * mm, kC = 12 * mm;
  const double h = std::sqrt(4 * kR * kR - kC * kC) - kR, join = 0.5 * (h - kR),
               end = std::sqrt(kR * kR - 100 * mm * mm) - kR;
  return Profile::from_segments(ProfileKind::rail, "two crowns",
                                {{{-22 * mm, end}, {-6 * mm, join}, {-kC, -kR}, kR},
                                 {{-6 * mm, join}, {6 * mm, join}, {0, h}, kR},
                                 {{6 * mm, join}, {22 * mm, end}, {kC, -kR}, kR}});
}

// A cylinder on two crowns, one of which stands lower by h = 24 mm sin(cant): lowered by h it touches there too; the
// ridge of the gap lies in the middle of the hollow, sqrt(4 R² - c²) - 2 R above the line of the crowns' tops.
TEST(Placement, further_contacts_are_those_of_the_lowered_wheel) {
  TrackGeometry track = upright();
  track.cant = 1e-3;
  const Profile crowns = two_crowns(), cylinder = wheel("flat");
  const RigidContact first = place_wheel(cylinder, crowns, track);
  const double lower = 24 * mm * std::sin(std::atan(track.cant));
  EXPECT_TRUE(further_contacts(cylinder, crowns, track, first, 0.99 * lower).empty());
  const auto further = further_contacts(cylinder, crowns, track, first, 1.01 * lower);
  ASSERT_EQ(further.size(), 1U);
  const RigidContact& other = further[0];
  EXPECT_NEAR(first.axle_height - other.axle_height, lower, 1e-12);
  EXPECT_NEAR(std::abs(first.point.y - other.point.y), 24 * mm * std::cos(std::atan(track.cant)), 1e-9);
  EXPECT_NEAR(first.point.z - other.point.z, lower, 1e-12);
  EXPECT_NEAR(other.angle, 0, 1e-9);
  EXPECT_EQ(other.rolling_radius, first.rolling_radius);
  const Ridge ridge = ridge_between(cylinder, crowns, track, first, other);
  EXPECT_NEAR(ridge.rail_s, 0, 0.15 * mm) << "tilted by the cant and sampled by 0.05 mm";
  const double depth = 2 * 0.1 - std::sqrt(0.04 - 144 * mm * mm);
  EXPECT_NEAR(ridge.gap + first.wheel_offset_z, depth + 0.5 * lower, 1e-6);
}

/// Largest difference of place, plane and further contacts under 0.1 mm.
double difference_of_places(const Profile& w, const Profile& r, const TrackGeometry& track, const RigidContact& a,
                            const RigidContact& b) {
  constexpr double kDescent = 0.1 * mm;
  const auto places = [&](const RigidContact& first) {
    std::vector<RigidContact> out = further_contacts(w, r, track, first, kDescent);
    out.push_back(first);
    out.push_back(overlap_place(w, r, track, first, {}, first.wheel_offset_z - kDescent));
    return out;
  };
  const std::vector<RigidContact> of_a = places(a), of_b = places(b);
  EXPECT_EQ(of_a.size(), of_b.size());
  double most = 0;
  for (std::size_t k = 0; k < std::min(of_a.size(), of_b.size()); ++k)
    for (const auto member : {&RigidContact::rail_s, &RigidContact::x, &RigidContact::angle,
                              &RigidContact::rolling_radius, &RigidContact::wheel_offset_z})
      most = std::max(most, std::abs(of_a[k].*member - of_b[k].*member));
  return most;
}

TEST(Placement, beside_a_known_place_is_that_of_a_search_of_all_gaps) {
  for (const auto& [w, r] : {std::pair(wheel("S1002"), rail("UIC60")), {wheel("LMA"), rail("CN60")}})
    for (const double shift : {-3.0, 0.4, 5.3})
      for (const double roll : {0.0, 1e-3}) {
        TrackGeometry track;
        track.lateral_shift = shift * mm;
        track.yaw = 2e-3;
        track.roll = roll;
        const RigidContact before = place_wheel(w, r, track);
        track.lateral_shift += 1e-7;
        track.yaw += 1e-7;
        const RigidContact beside = place_wheel(w, r, track, {}, {&before, 0.1 * mm}), anew = place_wheel(w, r, track);
        EXPECT_LT(difference_of_places(w, r, track, beside, anew), 1e-13) << w.name() << " " << shift << " " << roll;
      }
}

TEST(Placement, a_wheel_on_its_tread_touches_nowhere_else) {
  TrackGeometry track;
  const Profile lma = wheel("LMA"), cn60 = rail("CN60");
  EXPECT_TRUE(further_contacts(lma, cn60, track, place_wheel(lma, cn60, track), 0.2 * mm).empty());
  const Profile plane = wheel("flat"), flat = rail("flat");  // equal everywhere: one place, not a thousand
  EXPECT_TRUE(further_contacts(plane, flat, upright(), place_wheel(plane, flat, upright()), 0.2 * mm).empty());
  for (int i = 0; i < 20; ++i) {  // a crown so sharp that the gap rises by more than a micrometre between two samples
    TrackGeometry track_of_edge = upright();
    track_of_edge.cant = 0.003 * i;
    const Profile sharp = circular_profile(ProfileKind::rail, 0.5 * mm);
    EXPECT_TRUE(
        further_contacts(plane, sharp, track_of_edge, place_wheel(plane, sharp, track_of_edge), 0.1 * mm).empty())
        << i;
  }
}

TEST(Placement, rail_and_model_frame_invert_each_other) {
  TrackGeometry track;
  const Vec2 p{0.013, -0.027}, back = model_to_rail(track, rail_to_model(track, p));
  EXPECT_NEAR(norm(back - p), 0, 1e-17);
  EXPECT_LT(rail_to_model(track, {0, 1}).y, 0);  // the rail leans to the track's centre
}

std::string error_of(const Profile& w, const Profile& r, const TrackGeometry& track) {
  try {
    place_wheel(w, r, track);
  } catch (const CaseError& e) {
    return e.what();
  }
  return "";
}

TEST(Placement, errors_say_what_is_wrong) {
  TrackGeometry track;
  track.lateral_shift = 0.2;
  EXPECT_NE(error_of(wheel("LMA"), rail("CN60"), track)
                .find("wheel LMA on rail CN60: the wheel misses the rail; its tape circle stands 193.9 mm from the "
                      "rail's axis\n"
                      "    remedy: check lateral_shift, gauge and back_to_back"),
            std::string::npos);
  track = upright();
  track.lateral_shift = 40 * mm;
  EXPECT_NE(error_of(wheel("flat"), rail("arc:R=300 mm"), track)
                .find("the contact lies at the end of a profile, at wheel y = -"),
            std::string::npos);
  std::vector<Vec2> crown;
  for (int i = -10; i <= 10; ++i) crown.push_back({i * mm, -i * i * mm * mm / 0.6});
  const Profile shallow = Profile::from_points(ProfileKind::rail, "crown", crown);
  EXPECT_NE(
      error_of(wheel("LMA"), shallow, upright())
          .find("the rail profile crown ends 0.2 mm below its top on the gauge side, above the gauge depth of 16.0 mm"),
      std::string::npos);
}

}  // namespace
}  // namespace railstrata
