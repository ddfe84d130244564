#include "bem/several_patches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bem/solve_bem.hpp"
#include "core/faults.hpp"

namespace railstrata {
namespace {

constexpr double kCrown = 0.1, kHalfDistance = 12e-3;  // m

/// A rail with two crowns of R = 100 mm at y = -12 and 12 mm and a hollow between them; the wheel a cone (of the rail's
/// inclination) or a cylinder.
Placement two_crowns(double cant, double wheel_slope) {
  constexpr double kOuter = 22e-3;
  const double h = std::sqrt(4 * kCrown * kCrown - kHalfDistance * kHalfDistance) - kCrown,  // of the hollow's centre
      join = 0.5 * (h - kCrown), end = std::sqrt(kCrown * kCrown - 1e-4) - kCrown, half = 0.5 * kHalfDistance;
  const Vec2 along = (1 / std::hypot(1.0, wheel_slope)) * Vec2{1, wheel_slope};
  Placement p{Profile::from_segments(ProfileKind::wheel, "cone", {{-40e-3 * along, 40e-3 * along, {}, 0}}),
              Profile::from_segments(ProfileKind::rail, "two crowns",
                                     {{{-kOuter, end}, {-half, join}, {-kHalfDistance, -kCrown}, kCrown},
                                      {{-half, join}, {half, join}, {0, h}, kCrown},
                                      {{half, join}, {kOuter, end}, {kHalfDistance, -kCrown}, kCrown}}),
              {},
              {},
              {}};
  p.track.gauge_depth = 0.3e-3;
  p.track.cant = cant;
  const double tape = 0.5 * p.track.back_to_back + p.track.flange_back_to_tape,
               axis = 0.5 * p.track.gauge - gauge_face_y(p.rail, p.track);
  p.track.lateral_shift = axis - tape;  // the tape circle over the rail's axis
  p.contact = place_wheel(p.wheel, p.rail, p.track);
  return p;
}

/// Two crowns with contacts of one angle, atan(cant).
Placement level_crowns(double cant) {
  TrackGeometry track;
  track.cant = cant;
  const Vec2 tangent = rail_to_model(track, {1, 0});
  return two_crowns(cant, tangent.z / tangent.y);
}

CaseSpec driven(double traction) {
  CaseSpec spec;
  spec.drive.friction_coefficient = 0.3;
  spec.drive.traction_coefficient = traction;
  return spec;
}

BemOptions coarse() {
  BemOptions options;
  options.cell = 0.5e-3;
  return options;
}

TEST(SeveralPatches, TwoEqualOnesShareTheLoadInHalves) {
  const CaseSpec spec = driven(0.1);
  const BemResult both = solve_bem(spec, two_crowns(0, 0), BemOptions{});
  ASSERT_EQ(both.further.size(), 1U);
  const BemPatch& other = both.further[0];
  const double weight = static_load(spec);
  EXPECT_NEAR(both.force.normal / other.force.normal, 1, 1e-6);
  EXPECT_NEAR(both.force.x / other.force.x, 1, 1e-6);
  EXPECT_NEAR(both.force.normal / weight, 0.5, 1e-6);
  EXPECT_NEAR(both.contact.point.y + other.contact.point.y, 0, 1e-9);

  CaseSpec half = spec;
  half.vehicle.sprung_mass = 0.5 * weight / spec.vehicle.gravity - spec.vehicle.wheel_mass;
  half.geometry.rail_profile = "arc:R=100 mm";
  half.geometry.wheel_profile = "flat";
  half.geometry.cant = 0;
  const BemResult alone = solve_bem(half, place(half, {}), BemOptions{});
  ASSERT_TRUE(alone.further.empty());
  EXPECT_NEAR(both.patch.largest_pressure / alone.patch.largest_pressure, 1, 2e-5);
  EXPECT_NEAR(both.patch.largest_traction / alone.patch.largest_traction, 1, 1e-4);
  EXPECT_NEAR(both.rigid_slip.x / alone.rigid_slip.x, 1, 1e-3);
  EXPECT_EQ(both.patch.area, alone.patch.area);
  // each is pressed down by the other's N/(pi E* r) besides, which is no approach of its own
  EXPECT_NEAR(both.approach / alone.approach, 1, 1e-4);
}

// By Hertz: one crown lies lower by h = 2 c tan(cant); the loads are N ~ (approach)^1.5, each approach less the other's
// N/(pi E* 2c).
TEST(SeveralPatches, ALowerCrownTakesWhatHertzGivesIt) {
  const CaseSpec spec = driven(0);
  const double weight = static_load(spec), modulus = contact_modulus({210e9, 0.3}, {210e9, 0.3});
  const double radius = CaseSpec{}.geometry.wheel_radius;
  const auto load_at = [&](double approach) {
    const HertzContact under = hertz_contact(0.5 / radius, 0.5 / kCrown, modulus, weight);
    return approach > 0 ? weight * std::pow(approach / under.approach, 1.5) : 0.0;
  };
  for (const double cant : {0.5e-3, 1e-3, 1.5e-3}) {
    const BemResult r = solve_bem(spec, two_crowns(cant, 0), coarse());
    ASSERT_EQ(r.further.size(), 1U) << cant;
    const double lower = 2 * kHalfDistance * cant, by_other = 1 / (std::numbers::pi * modulus * 2 * kHalfDistance);
    double low = 0, high = 1e-3, upper_load = 0, lower_load = 0;
    for (int i = 0; i < 100; ++i) {
      const double descent = 0.5 * (low + high);
      for (int k = 0; k < 50; ++k) {
        upper_load = load_at(descent - lower_load * by_other);
        lower_load = load_at(descent - lower - upper_load * by_other);
      }
      (upper_load + lower_load < weight ? low : high) = descent;
    }
    EXPECT_NEAR(r.force.normal / weight, upper_load / weight, 5e-3) << cant;
    EXPECT_NEAR(r.further[0].force.normal / weight, lower_load / weight, 5e-3) << cant;
  }
}

// From one patch to two and back the loads are continuous; the second begins with none.
TEST(SlowSeveralPatches, TheSecondStartsFromNoLoad) {
  const CaseSpec spec = driven(0.05);
  double previous = 0.5;
  bool ended = false;
  for (double cant = 0; cant < 6e-3; cant += 0.25e-3) {
    const BemResult r = solve_bem(spec, two_crowns(cant, 0), coarse());
    const double second = r.further.empty() ? 0.0 : r.further[0].force.normal / static_load(spec);
    EXPECT_LT(second, previous + 1e-6) << cant;
    EXPECT_GT(second, previous - 0.09) << cant;
    EXPECT_NEAR(-force_on_rail(r).z / static_load(spec), 1, 1e-5) << cant;
    if (second == 0 && previous > 0) {
      EXPECT_LT(previous, 0.03) << cant;
    }
    ended |= second == 0;
    previous = second;
  }
  EXPECT_TRUE(ended);
}

// The patch on the larger radius drives, that on the smaller one brakes.
TEST(SeveralPatches, OnDifferentRadiiTheirForcesAreOppositeWithoutTraction) {
  const CaseSpec spec = driven(0);
  const BemResult r = solve_bem(spec, level_crowns(0.05), coarse());
  ASSERT_EQ(r.further.size(), 1U);
  const bool first_larger = r.contact.rolling_radius > r.further[0].contact.rolling_radius;
  const BemPatch &larger = first_larger ? static_cast<const BemPatch&>(r) : r.further[0],
                 &smaller = first_larger ? r.further[0] : r;
  const double weight = static_load(spec);
  EXPECT_NEAR(larger.contact.rolling_radius - smaller.contact.rolling_radius,
              2 * kHalfDistance * std::sin(std::atan(0.05)), 1e-6);
  EXPECT_NEAR((larger.force.x + smaller.force.x) / weight, 0, 1e-6);
  EXPECT_LT(larger.force.x, -0.05 * weight) << "on the rail: backwards";
  EXPECT_NEAR(-force_on_rail(r).z / weight, 1, 1e-6);
  // (1 - xi_k)/r_k is the turn of the wheel over its way
  EXPECT_NEAR((1 - larger.rigid_slip.x) / larger.contact.rolling_radius,
              (1 - smaller.rigid_slip.x) / smaller.contact.rolling_radius, 1e-12);
}

/// The load of the patch on the flange's root, of the weight; 0 where there is none.
double flange_load(const CaseSpec& spec, const BemResult& r) {
  double sum = 0;
  for (const BemPatch* p : {static_cast<const BemPatch*>(&r), r.further.empty() ? nullptr : &r.further[0]})
    if (p && p->contact.angle > 0.3) sum += p->force.normal;
  return sum / static_load(spec);
}

// S1002 on UIC60 inclined by 1:20 goes over to the flange within half a millimetre: one patch on the tread (of two
// lobes), that and one in the flange's root 22 degrees steep, the root alone.
TEST(SlowSeveralPatches, S1002OnUic60GoesOverToTheFlangeWithoutAGap) {
  CaseSpec spec = driven(0.02);
  spec.geometry.rail_profile = "UIC60";
  spec.geometry.wheel_profile = "S1002";
  spec.geometry.cant = 0.05;
  spec.geometry.gauge_depth = 14e-3;
  BemOptions options;
  options.cell = 1e-3;
  double previous = 0, first = 0;
  int shared = 0;
  for (double shift = 9.43e-3; shift < 9.935e-3; shift += 0.05e-3) {
    spec.geometry.lateral_shift = shift;
    const BemResult r = solve_bem(spec, place(spec, {}), options);
    const double load = flange_load(spec, r);
    EXPECT_GT(load, previous - 1e-9) << shift;
    EXPECT_LT(load, previous + 0.18) << shift;
    if (!r.further.empty()) {
      ++shared;
      EXPECT_NEAR(-force_on_rail(r).z / static_load(spec), 1, 1e-6) << shift;
      EXPECT_NEAR(force_on_rail(r).x / static_load(spec), -0.02, 1e-6) << shift;
      if (first == 0) first = load;
    }
    previous = load;
  }
  EXPECT_GE(shared, 8);
  EXPECT_LT(first, 0.03) << "it begins with no load";
  EXPECT_GT(previous, 1) << "and bears all in the end";
}

// UIC60 inclined by 1:40: solved apart, the patch in the flange's root at 17 degrees and that on the gauge corner at 7
// both reach the ridge between them.
TEST(SlowSeveralPatches, PatchesThatReachTheRidgeBetweenThemAreOneInThePlaneOfTheFirst) {
  CaseSpec spec = driven(0);
  spec.geometry.rail_profile = "UIC60";
  spec.geometry.wheel_profile = "S1002";
  spec.geometry.gauge_depth = 14e-3;
  spec.geometry.lateral_shift = 8.7e-3;
  const Placement p = place(spec, {});
  const BemResult r = solve_bem(spec, p, coarse());
  const auto further = further_contacts(p.wheel, p.rail, p.track, p.contact, r.approach / std::cos(p.contact.angle));
  const auto aslant = std::find_if(further.begin(), further.end(), [&](const RigidContact& c) {
    return std::abs(c.angle - p.contact.angle) > kAngleOfOnePlane;
  });
  ASSERT_NE(aslant, further.end());
  EXPECT_TRUE(r.further.empty());
  EXPECT_EQ(r.contact.rail_s, p.contact.rail_s);
  for (const RigidContact& c : {p.contact, *aslant}) {
    double most = 0;
    for (std::size_t k = 0; k < r.field.p.size(); ++k)
      if (std::abs(r.field.y[k] - c.point.y) < 1e-3) most = std::max(most, r.field.p[k]);
    EXPECT_GT(most, 0.2 * r.patch.largest_pressure) << c.angle;
  }
}

TEST(SeveralPatches, ALateralCreepageIsCommonToAll) {
  CaseSpec spec = driven(0);
  spec.drive.lateral_creepage = 1e-3;
  const BemResult r = solve_bem(spec, two_crowns(0, 0), coarse());
  EXPECT_NEAR(r.rigid_slip.y / r.further.at(0).rigid_slip.y, 1, 1e-9);
  EXPECT_GT(r.force.tangential, 0);
}

/// Lateral friction on the rail, each patch's along its own plane.
double lateral_friction(const BemResult& r) {
  double sum = r.force.tangential;
  for (const BemPatch& p : r.further) sum += p.force.tangential;
  return sum;
}

// Two equal crowns: half of each force on each, under the creepages that one crown has for those halves.
TEST(SeveralPatches, AGivenLateralForceIsSharedByEqualOnesUnderOneCreepage) {
  CaseSpec spec = driven(0.1);
  spec.drive.lateral_traction_coefficient = -0.08;
  const double weight = static_load(spec);
  const BemResult r = solve_bem(spec, level_crowns(0), coarse());
  ASSERT_EQ(r.further.size(), 1U);
  EXPECT_NEAR(lateral_friction(r) / weight, 0.08, 1e-6);
  EXPECT_NEAR(force_on_rail(r).x / weight, -0.1, 1e-6);
  EXPECT_NEAR(-force_on_rail(r).z / weight, 1, 1e-6);
  EXPECT_NEAR(r.force.tangential / weight, 0.04, 1e-4);
  EXPECT_NEAR(r.rigid_slip.y, r.further[0].rigid_slip.y, 1e-12);
  spec.vehicle.sprung_mass = 0.5 * weight / spec.vehicle.gravity - spec.vehicle.wheel_mass;
  const BemResult one = solve_bem(spec, two_crowns(0.025, 0), coarse());  // the other crown 0.6 mm too low
  ASSERT_TRUE(one.further.empty());
  EXPECT_NEAR(r.rigid_slip.y / one.rigid_slip.y, 1, 0.01);
}

// In the flange's root and on the tread, one or both forces given: the sum along the patches' own planes.
TEST(SeveralPatches, AGivenLateralForceClosesOverInclinedOnes) {
  CaseSpec spec = driven(0);
  spec.geometry.wheel_profile = "S1002";
  spec.geometry.rail_profile = "UIC60";
  spec.geometry.gauge_depth = 14e-3;
  spec.geometry.cant = 0.05;
  spec.geometry.lateral_shift = 9.65e-3;
  spec.drive.lateral_traction_coefficient = -0.05;
  const double weight = static_load(spec);
  const Placement p = place(spec, {});
  BemOptions options;
  options.cell = 1e-3;
  for (const bool creepage : {false, true}) {
    if (creepage) spec.drive.creepage = 0;
    const BemResult r = solve_bem(spec, p, options);
    ASSERT_EQ(r.further.size(), 1U);
    EXPECT_GT(std::abs(r.contact.angle - r.further[0].contact.angle), kAngleOfOnePlane);
    EXPECT_NEAR(lateral_friction(r) / weight, 0.05, 1e-6);
    EXPECT_NEAR(-force_on_rail(r).z / weight, 1, 1e-6);
    if (!creepage) {
      EXPECT_NEAR(force_on_rail(r).x / weight, 0, 1e-6);
    }
    EXPECT_NEAR(r.rigid_slip.y * std::cos(r.contact.angle),
                r.further[0].rigid_slip.y * std::cos(r.further[0].contact.angle), 1e-12);
  }
}

TEST(SeveralPatches, TractionBeyondBothIsRefusedAndLayersAreCoupled) {
  CaseSpec spec = driven(0.29);
  EXPECT_THROW(solve_bem(spec, level_crowns(0.05), coarse()), CaseError);
  spec = driven(0.05);
  spec.layers.push_back({});
  spec.layers[0].material.young = 2 * 210e9;
  const BemResult r = solve_bem(spec, level_crowns(0.05), coarse());
  ASSERT_EQ(r.further.size(), 1U);
  EXPECT_NEAR(-force_on_rail(r).z / static_load(spec), 1, 1e-6);
  EXPECT_NEAR(force_on_rail(r).x / (-0.05 * static_load(spec)), 1, 2e-5);
}

}  // namespace
}  // namespace railstrata
