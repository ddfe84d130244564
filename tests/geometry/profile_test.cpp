#include "geometry/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <stdexcept>

#include "core/faults.hpp"
#include "geometry/builtin_profiles.hpp"
#include "geometry/point_scatter.hpp"
#include "geometry/profile_names.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

constexpr double mm = 1e-3;

Profile wheel(const std::string& name) { return builtin_profile(ProfileKind::wheel, name); }
Profile rail(const std::string& name) { return builtin_profile(ProfileKind::rail, name); }

std::vector<Profile> all_profiles() {
  return {wheel("LMA"), wheel("S1002"), rail("CN60"), rail("UIC60"), rail("UIC54")};
}

/// Points of a reference list, in metres, z up.
std::vector<Vec2> listed(const std::string& file) {
  std::ifstream in(source_dir() / "data/profiles" / file);
  std::vector<Vec2> points;
  for (std::string line; std::getline(in, line);) {
    double y, z;
    if (line[0] != '#' && std::sscanf(line.c_str(), "%lf,%lf", &y, &z) == 2) points.push_back({y * mm, -z * mm});
  }
  return points;
}

double largest_distance(const Profile& profile, const std::vector<Vec2>& points) {
  double worst = points.size() < 1000 ? 1.0 : 0.0;
  for (const Vec2 p : points)
    if (p.y > profile.y_min() + 0.5 * mm && p.y < profile.y_max()) {
      const ProfilePoint on = profile.at(profile.s_at_y(p.y));
      worst = std::max(worst, std::abs(on.position.z - p.z) * on.tangent.y);
    }
  return worst;
}

Vec2 tangent_at_end(const ProfileSegment& g, Vec2 p) {
  if (g.radius == 0) return (1 / norm(g.p1 - g.p0)) * (g.p1 - g.p0);
  const Vec2 arm = (1 / g.radius) * (p - g.centre);
  const double turn = cross(g.p0 - g.centre, g.p1 - g.centre) > 0 ? 1 : -1;
  return turn * Vec2{-arm.z, arm.y};
}

/// Distance by which two segments fail to be tangent at their junction: the heel of the angle between them on the
/// smaller of their radii.
double misfit(const ProfileSegment& a, const ProfileSegment& b) {
  const auto size = [](const ProfileSegment& g) { return g.radius > 0 ? g.radius : norm(g.p1 - g.p0); };
  return std::abs(cross(tangent_at_end(a, a.p1), tangent_at_end(b, b.p0))) * std::min(size(a), size(b));
}

TEST(Profile, arcs_join_tangentially_within_1e_6_mm_except_at_LMAs_two_drawn_kinks) {
  for (const Profile& profile : {wheel("LMA"), rail("CN60"), rail("UIC60"), rail("UIC54")}) {
    const auto& g = profile.segments();
    ASSERT_GE(g.size(), 8u);
    for (std::size_t i = 1; i < g.size(); ++i) {
      EXPECT_LT(norm(g[i].p0 - g[i - 1].p1), 1e-6 * mm);
      const bool drawn_kink =
          profile.name() == "LMA" && (std::abs(g[i].p0.y - 30 * mm) < 1e-9 || std::abs(g[i].p0.y - 60 * mm) < 1e-9);
      if (drawn_kink)
        EXPECT_GT(misfit(g[i - 1], g[i]), 0.1 * mm);
      else
        EXPECT_LT(misfit(g[i - 1], g[i]), 1e-6 * mm) << profile.name() << " junction " << i;
    }
  }
}

TEST(Profile, built_in_curves_pass_through_the_reference_lists) {
  constexpr double rounding = 0.71e-6 * mm;
  EXPECT_LT(largest_distance(wheel("LMA"), listed("lma_wheel.csv")), rounding);
  EXPECT_LT(largest_distance(rail("CN60"), listed("cn60_head.csv")), rounding);
  EXPECT_LT(largest_distance(rail("UIC60"), listed("uic60_60e1_head.csv")),
            2 * rounding);  // its listed face is not quite tangent
  EXPECT_LT(largest_distance(rail("UIC54"), listed("uic54_54e1_head.csv")), 2 * rounding);
  EXPECT_LT(largest_distance(wheel("S1002"), listed("s1002_wheel.csv")), 130 * rounding);  // zone C's steps are closed
}

TEST(Profile, S1002_formulas_agree_with_the_reference_list_outside_zone_C) {
  double worst = 0;  // the list's first point, y = -70, is 2e-4 mm beside its circle
  for (const Vec2 p : listed("s1002_wheel.csv"))
    if ((p.y / mm > -69.95 && p.y / mm < -35.01) || p.y / mm > -25.99)
      worst = std::max(worst, std::abs(-mm * s1002_height_mm(p.y / mm) - p.z));
  EXPECT_GT(worst, 0);
  EXPECT_LT(worst, 6e-7 * mm);
}

TEST(Profile, LMA_measures_as_drawn) {
  const Profile lma = wheel("LMA");
  EXPECT_NEAR(lma.at(lma.s_max()).position.y - lma.at(lma.s_min()).position.y, 135 * mm, 1e-12);  // rim width
  EXPECT_NEAR(lma.height(-54 * mm), -28 * mm, 1e-12);                                             // crest
  double front = -54 * mm, base = -30 * mm;  // where the flange's face passes 12 mm below the tape circle
  while (base - front > 1e-12) (lma.height(0.5 * (front + base)) < -12 * mm ? front : base) = 0.5 * (front + base);
  EXPECT_NEAR(front + 70 * mm, 31.97 * mm, 0.005 * mm);  // flange thickness
  EXPECT_NEAR(lma.at(lma.s_min()).tangent.y, 0, 1e-12);  // vertical back
  EXPECT_NEAR(lma.y_min(), -70 * mm, 1e-12);
}

TEST(Profile, curvatures_are_one_over_the_drawn_radii_and_convex_positive) {
  const Profile cn60 = rail("CN60"), lma = wheel("LMA");
  EXPECT_NEAR(cn60.at(0).curvature, 1 / 0.300, 1e-9);
  EXPECT_NEAR(cn60.at(cn60.s_at_y(-15 * mm)).curvature, 1 / 0.080, 1e-9);
  EXPECT_NEAR(cn60.at(cn60.s_at_y(30 * mm)).curvature, 1 / 0.013, 1e-9);
  EXPECT_NEAR(lma.at(0).curvature, -1 / 0.450, 1e-9);
  EXPECT_NEAR(lma.at(lma.s_at_y(6 * mm)).curvature, 0, 1e-12);
  EXPECT_NEAR(lma.at(lma.s_at_y(-54 * mm)).curvature, 1 / 0.012, 1e-9);
}

TEST(Profile, outward_normals_leave_the_material) {
  EXPECT_GT(rail("CN60").at(0).outward.z, 0.999);
  EXPECT_LT(wheel("LMA").at(0).outward.z, -0.999);
  EXPECT_LT(rail("CN60").at(rail("CN60").s_min()).outward.y, -0.99);
}

TEST(Profile, s_is_the_arc_length_from_y_0) {
  for (const Profile& profile : all_profiles()) {
    EXPECT_NEAR(profile.at(0).position.y, 0, 1e-12) << profile.name();
    EXPECT_NEAR(profile.at(0).position.z, 0, 1e-8) << profile.name();
    for (std::size_t k = 1; k < profile.knots().size(); ++k) {
      const double from = profile.knots()[k - 1], to = profile.knots()[k];
      double length = 0;
      const int n = 1000;
      for (int i = 0; i < n; ++i)
        length += norm(profile.at(from + (to - from) * (i + 0.9999999) / n).position -
                       profile.at(from + (to - from) * i / n).position);
      EXPECT_NEAR(length, to - from, 1e-6 * (to - from)) << profile.name() << " piece " << k;
    }
  }
}

TEST(Profile, s_at_y_inverts_the_position_over_the_whole_running_surface) {
  for (const Profile& profile : all_profiles())
    for (int i = 0; i <= 1000; ++i) {
      const double y = profile.y_min() + (profile.y_max() - profile.y_min()) * i / 1000;
      EXPECT_NEAR(profile.at(profile.s_at_y(y)).position.y, y, 1e-13) << profile.name();
    }
}

TEST(Profile, lateral_coordinates_and_arc_lengths_outside_are_refused) {
  const Profile lma = wheel("LMA");
  EXPECT_THROW(lma.s_at_y(65.1 * mm), std::out_of_range);
  EXPECT_THROW(lma.at(lma.s_max() + 1e-6), std::out_of_range);
  EXPECT_THROW(Profile::from_segments(ProfileKind::rail, "gap", {{{-1, 0}, {0, 0}, {}, 0}, {{0, 1e-6}, {1, 0}, {}, 0}}),
               std::invalid_argument);
}

TEST(Profile, running_surface_ends_where_the_curve_turns_vertical) {
  const double r = 0.030, edge = 0.05;  // a bullnose: three quarters of the way round its underside comes back
  const Vec2 c{edge, -r};
  const Profile nose = Profile::from_segments(
      ProfileKind::rail, "nose",
      {{{-0.02, 0}, {edge, 0}, {}, 0}, {{edge, 0}, {edge + r * std::cos(-0.5), -r + r * std::sin(-0.5)}, c, r}});
  EXPECT_NEAR(nose.y_max(), edge + r, 1e-12);
  EXPECT_LT(nose.at(nose.s_max()).position.y, nose.y_max() - 1e-3);
}

TEST(Profile, circular_profiles_are_arcs_about_their_centre) {
  for (const double radius : {0.3, -0.45, 0.013}) {
    for (const ProfileKind kind : {ProfileKind::rail, ProfileKind::wheel}) {
      const Profile arc = circular_profile(kind, radius, 0.02);
      EXPECT_TRUE(arc.primitive());
      for (const double y : {arc.y_min(), -0.003, 0.0, 0.007, arc.y_max()}) {
        EXPECT_NEAR(arc.at(arc.s_at_y(y)).curvature, 1 / radius, 1e-9);
        const double sagitta = std::abs(radius) - std::sqrt(radius * radius - y * y);
        EXPECT_NEAR(arc.height(y), sagitta * (radius > 0 ? 1 : -1) * (kind == ProfileKind::rail ? -1 : 1), 1e-15);
      }
    }
  }
  EXPECT_EQ(circular_profile(ProfileKind::rail, std::numeric_limits<double>::infinity()).height(0.01), 0.0);
}

TEST(ProfileNames, arcs_and_planes_have_names) {
  EXPECT_NEAR(rail("arc:R=300 mm").at(0).curvature, 1 / 0.3, 1e-9);
  EXPECT_NEAR(rail("arc:R=300 mm, W=10 mm").y_max(), 5e-3, 1e-12);
  EXPECT_NEAR(wheel("flat:W=0.12 m").y_min(), -60e-3, 1e-12);
  EXPECT_TRUE(wheel("flat:W=10 mm").primitive());
  EXPECT_NEAR(wheel("arc:R=-0.45 m").at(0).curvature, -1 / 0.45, 1e-9);
  EXPECT_EQ(wheel("flat").at(0).curvature, 0.0);
  EXPECT_EQ(rail("uic60").name(), "UIC60");
  EXPECT_FALSE(rail("UIC60").primitive());
}

std::string error_of(const std::string& name, ProfileKind kind = ProfileKind::rail) {
  try {
    builtin_profile(kind, name);
  } catch (const CaseError& e) {
    return e.what();
  }
  return "";
}

TEST(ProfileNames, unknown_names_are_answered_with_the_nearest) {
  EXPECT_EQ(error_of("CN06"),
            "there is no built-in rail profile 'CN06'\n    remedy: did you mean 'CN60'? Known: CN60, UIC54, UIC60, "
            "flat, arc:R=300 mm; or give a file");
  EXPECT_NE(error_of("CN60", ProfileKind::wheel).find("no built-in wheel profile 'CN60'"), std::string::npos);
  EXPECT_NE(error_of("arc:R=300")
                .find("cannot read R=300 of the profile 'arc:R=300'\n    remedy: write for example arc:R=300 mm"),
            std::string::npos);
  for (const char* name : {"arc:R=0 mm", "arc:R=-4 mm", "arc:R=1e300 m", "arc:R=nan mm"})
    EXPECT_NE(error_of(name).find("is not between 5 mm and 1000 m"), std::string::npos) << name;
  EXPECT_NE(error_of("arc").find("cannot read the profile 'arc'"), std::string::npos);
}

std::string arc_points_error(std::vector<Vec2> points) {
  try {
    Profile::from_points(ProfileKind::rail, "list", std::move(points));
  } catch (const CaseError& e) {
    return e.what();
  }
  return "";
}

std::vector<Vec2> crown(double radius, double half_width, double spacing) {
  std::vector<Vec2> points;
  const int n = static_cast<int>(std::round(2 * half_width / spacing));
  for (int i = 0; i <= n; ++i) {
    const double y = -half_width + 2 * half_width * i / n;
    points.push_back({y, std::sqrt(radius * radius - y * y) - radius});
  }
  return points;
}

TEST(ProfileFromPoints, a_circle_is_reproduced_with_order_4) {
  double last = 0;
  for (const double spacing : {4 * mm, 2 * mm, 1 * mm}) {
    const Profile p = Profile::from_points(ProfileKind::rail, "circle", crown(0.04, 0.02, spacing));
    double worst = 0;
    for (double y = -0.012; y <= 0.012; y += 1e-4)
      worst = std::max(worst, std::abs(p.height(y) - (std::sqrt(0.04 * 0.04 - y * y) - 0.04)));
    if (last > 0) {
      EXPECT_GT(std::log2(last / worst), 3.5);
    }
    last = worst;
  }
  EXPECT_LT(last, 1e-6 * mm);
}

TEST(ProfileFromPoints, rounding_to_1e_6_mm_leaves_a_crowns_curvature_within_1_percent) {
  std::vector<Vec2> points = crown(0.3, 0.01, 0.1 * mm);
  for (Vec2& p : points) p.z = std::round(p.z / (1e-6 * mm)) * 1e-6 * mm;
  const Profile p = Profile::from_points(ProfileKind::rail, "rounded", points);
  for (double s = -0.009; s <= 0.009; s += 1e-5) EXPECT_NEAR(p.at(s).curvature, 1 / 0.3, 0.01 / 0.3);
}

/// Deviates of a unit normal distribution, the same on every machine (sums of twelve uniform ones).
double scatter(std::mt19937& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(random()) / 4294967296.0;
  return sum;
}

TEST(ProfileFromPoints, points_scattered_by_3_micrometres_give_a_closer_curve) {
  std::mt19937 random(1);
  std::vector<Vec2> points = crown(0.3, 0.03, 0.2 * mm);
  for (Vec2& p : points) p.z += 3e-6 * scatter(random);
  EXPECT_NEAR(scatter_of(points).noise, 3e-6, 1e-6);
  const Profile p = Profile::from_points(ProfileKind::rail, "measured", points);
  for (double y = -0.025; y <= 0.025; y += 1e-4) {
    EXPECT_NEAR(p.height(y), std::sqrt(0.09 - y * y) - 0.3, 3e-6);
    EXPECT_NEAR(p.at(p.s_at_y(y)).curvature, 1 / 0.3, 2.0);
  }
}

TEST(ProfileFromPoints, short_and_noisy_lists_still_make_a_curve) {
  std::mt19937 random(2);
  std::vector<Vec2> points = crown(0.3, 0.003, 0.1 * mm);
  for (Vec2& p : points) p.z += 10e-6 * scatter(random);
  const Profile p = Profile::from_points(ProfileKind::rail, "scrap", points);
  EXPECT_NEAR(p.height(0.002), std::sqrt(0.09 - 4e-6) - 0.3, 15e-6);
}

TEST(ProfileFromPoints, a_kink_is_rounded_over_its_neighbours_without_overshoot) {
  std::vector<Vec2> points;
  for (int i = -200; i <= 200; ++i)
    points.push_back({0.1 * mm * i, i < 100 ? 0.0 : -0.1 * mm * (i - 100)});  // 45 degrees down at y = 10 mm
  const Profile p = Profile::from_points(ProfileKind::rail, "kink", points);
  for (double y = -0.019; y <= 0.019; y += 1e-5) {
    const double exact = y < 0.01 ? 0.0 : -(y - 0.01);
    EXPECT_NEAR(p.height(y), exact, std::abs(y - 0.01) < 1 * mm ? 0.02 * mm : 1e-3 * mm);
  }
}

TEST(ProfileFromPoints, defects_are_named) {
  EXPECT_NE(arc_points_error({{-0.01, 0}, {0, 0}, {0.01, 0}}).find("3 points are too few for a profile"),
            std::string::npos);
  auto points = crown(300, 20, 0.5);  // millimetres
  EXPECT_NE(
      arc_points_error(points).find("the curve is 40.03 m long; a wheel or rail profile measures between 5 and 500 mm"),
      std::string::npos);
  points = crown(0.3, 0.02, 0.5 * mm);
  points[7].z = std::nan("");
  EXPECT_NE(arc_points_error(points).find("point 8 is not a finite number"), std::string::npos);
  points = crown(0.3, 0.02, 0.5 * mm);
  std::swap(points[20], points[23]);
  EXPECT_NE(arc_points_error(points).find("turns back on itself at point 21"), std::string::npos);
  EXPECT_EQ(arc_points_error(points).find("outlier"), std::string::npos) << "two points change places";
  points = crown(0.3, 0.02, 0.1 * mm);
  points[60].z += 0.5 * mm;
  EXPECT_NE(
      arc_points_error(points).find("the order along the curve, without loops; or remove point 61 if it is an outlier"),
      std::string::npos)
      << arc_points_error(points);
  points.clear();
  for (int i = 0; i < 40; ++i)
    points.push_back({0.01 * std::cos(0.2 * i), 0.01 * std::sin(0.2 * i)});  // more than once round
  EXPECT_NE(arc_points_error(points).find("the curve crosses itself"), std::string::npos);
  points = crown(0.3, 0.02, 0.5 * mm);
  for (Vec2& p : points) p.y += 0.75;
  EXPECT_NE(arc_points_error(points).find("does not cover y = 0"), std::string::npos);
}

// Of segments and of points: heights and normals change their sign, arc lengths, kinks' knots and curvatures stay.
TEST(Profile, UpturnedIsTheSameCurveAsOfTheOtherBody) {
  std::vector<Vec2> points;
  for (double y = -20e-3; y < 20.1e-3; y += 1e-3) points.push_back({y, -y * y / 0.4});
  for (const Profile& p :
       {builtin_profile(ProfileKind::rail, "CN60"), Profile::from_points(ProfileKind::rail, "points", points)}) {
    const Profile up = p.upturned();
    EXPECT_EQ(up.kind(), ProfileKind::wheel);
    for (double s = p.s_min(); s < p.s_max(); s += 0.37e-3) {
      const ProfilePoint a = p.at(s), b = up.at(s);
      EXPECT_EQ(b.position.y, a.position.y);
      EXPECT_EQ(b.position.z, -a.position.z);
      EXPECT_NEAR(b.outward.y, a.outward.y, 1e-15);
      EXPECT_NEAR(b.outward.z, -a.outward.z, 1e-15);
      EXPECT_NEAR(b.curvature, a.curvature, 1e-9 * std::abs(a.curvature));
    }
  }
}

}  // namespace
}  // namespace railstrata
