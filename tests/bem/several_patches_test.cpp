#include "bem/several_patches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bem/solve_bem.hpp"
#include "core/faults.hpp"
#include "reader/case_file.hpp"
#include "several_patches_cases.hpp"

namespace railstrata {
namespace {

TEST(SeveralPatches, TwoEqualOnesShareTheLoadInHalves) {
  const CaseSpec spec = driven(0.1);
  const BemResult both = solve_bem(spec, two_crowns(0, 0), BemOptions{});
  ASSERT_EQ(both.further.size(), 1U);
  const BemPatch& other = both.further[0];
  const double weight = spec.vehicle.load();
  EXPECT_NEAR(both.force.normal / other.force.normal, 1, 1e-6);
  EXPECT_NEAR(both.force.x / other.force.x, 1, 1e-6);
  EXPECT_NEAR(both.force.normal / weight, 0.5, 1e-6);
  EXPECT_NEAR(both.contact.point.y + other.contact.point.y, 0, 1e-9);

  CaseSpec half = spec;
  half.vehicle.set_load(0.5 * weight);
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
  const double weight = spec.vehicle.load(), modulus = contact_modulus({210e9, 0.3}, {210e9, 0.3});
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
    const double second = r.further.empty() ? 0.0 : r.further[0].force.normal / spec.vehicle.load();
    EXPECT_LT(second, previous + 1e-6) << cant;
    EXPECT_GT(second, previous - 0.09) << cant;
    EXPECT_NEAR(-force_on_rail(r).z / spec.vehicle.load(), 1, 1e-5) << cant;
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
  const double weight = spec.vehicle.load();
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
  if (r.contact.angle > 0.3) sum += r.force.normal;
  for (const BemPatch& p : r.further)
    if (p.contact.angle > 0.3) sum += p.force.normal;
  return sum / spec.vehicle.load();
}

/// A patch that was solved in another plane than the first one; null: there is none.
const BemPatch* in_another_plane(const BemResult& r) {
  for (const BemPatch& p : r.further)
    if (p.contact.angle != r.contact.angle) return &p;
  return nullptr;
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
    if (in_another_plane(r)) {
      ++shared;
      EXPECT_NEAR(-force_on_rail(r).z / spec.vehicle.load(), 1, 1e-6) << shift;
      EXPECT_NEAR(force_on_rail(r).x / spec.vehicle.load(), -0.02, 1e-6) << shift;
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
TEST(SlowSeveralPatches, PatchesThatReachTheRidgeBetweenThemAreOneInACommonPlane) {
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
  EXPECT_FALSE(in_another_plane(r));
  EXPECT_GT(r.contact.angle, std::min(p.contact.angle, aslant->angle) + 0.02);
  EXPECT_LT(r.contact.angle, std::max(p.contact.angle, aslant->angle) - 0.02);
  ASSERT_TRUE(r.together);
  const ContactField& all = *r.together;
  for (const RigidContact& c : {p.contact, *aslant}) {
    double most = 0;
    for (std::size_t k = 0; k < all.p.size(); ++k)
      if (std::abs(all.y[k] - c.point.y) < 1e-3) most = std::max(most, all.p[k]);
    EXPECT_GT(most, 0.2 * r.patch.largest_pressure) << c.angle;
  }
}

// Arcs of one radius whose contacts lie by D below the wheel: the sum of (D - u^2/(2 R))^2.5 goes with D^3. Each arc's
// own mean is its contact but for terms of u/R.
TEST(SeveralPatches, ACommonPlaneIsTheMeanByTheOverlap) {
  const Placement p = two_crowns(2e-3, 0);
  const double descent = 0.1e-3;
  const std::vector<RigidContact> further = further_contacts(p.wheel, p.rail, p.track, p.contact, descent);
  ASSERT_EQ(further.size(), 1U);
  const RigidContact &one = p.contact, &other = further[0];
  const double below = descent - (one.axle_height - other.axle_height);
  ASSERT_GT(below, 0.3 * descent);
  ASSERT_LT(below, 0.7 * descent);
  const double a = std::pow(descent, 3), b = std::pow(below, 3), distance = std::abs(one.rail_s - other.rail_s);
  for (const auto& contacts : {std::vector{one, other}, std::vector{other, one}}) {
    const PatchPlace place{.contacts = contacts, .stretch = {}, .beside_low = {}, .beside_high = {}};
    const RigidContact c = plane_of(p, place, descent);
    EXPECT_NEAR(c.rail_s, (a * one.rail_s + b * other.rail_s) / (a + b), 1e-3 * distance);
    EXPECT_NEAR(c.angle, (a * one.angle + b * other.angle) / (a + b), 1e-6);
    EXPECT_EQ(c.axle_height, one.axle_height);
  }
}

/// S1002 on UIC60 with two places whose angles differ by less than that of one plane, and the descent at which the
/// wheel overlaps the rail all the way between them.
struct AlmostOnePlane {
  CaseSpec spec;
  Placement placement;
  double overlapping = 0;

  AlmostOnePlane() {
    for (double shift = 4.9e-3; shift < 5.3e-3; shift += 0.02e-3) {
      spec = european(shift);
      placement = place(spec, {});
      const RigidContact& first = placement.contact;
      const auto further = further_contacts(placement.wheel, placement.rail, placement.track, first, 0.1e-3);
      if (further.size() != 1 || std::abs(further[0].angle - first.angle) > kAngleOfOnePlane) continue;
      const Ridge ridge = ridge_between(placement.wheel, placement.rail, placement.track, first, further[0]);
      overlapping = ridge.gap + first.wheel_offset_z;
      if (further[0].axle_height < first.axle_height - overlapping + 5e-6) continue;
      return;
    }
    overlapping = 0;
  }
  std::vector<Grouping> at(double descent) const { return groupings_of(spec, placement, descent); }
};

// The answer of two planes fades into that of one over the last micrometre: 3 t^2 - 2 t^3.
TEST(SeveralPatches, PlacesBecomeOneByShares) {
  const AlmostOnePlane pair;
  ASSERT_GT(pair.overlapping, 5e-6);
  for (const double over : {1e-9, 20e-6}) {
    const auto one = pair.at(pair.overlapping + over);
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0].places[0].patch, one[0].places[1].patch);
  }
  for (const double t : {0.1, 0.5, 0.9}) {
    const auto both = pair.at(pair.overlapping - (1 - t) * kFadingGap);
    ASSERT_EQ(both.size(), 2U) << t;
    EXPECT_NE(both[0].places[0].patch, both[0].places[1].patch);
    EXPECT_EQ(both[1].places[0].patch, both[1].places[1].patch);
    EXPECT_NEAR(both[1].share, 3 * t * t - 2 * t * t * t, 1e-6);
    EXPECT_NEAR(both[0].share + both[1].share, 1, 1e-15);
  }
  const auto apart = pair.at(pair.overlapping - 1.01 * kFadingGap);
  ASSERT_EQ(apart.size(), 1U);
  EXPECT_NE(apart[0].places[0].patch, apart[0].places[1].patch);
}

// Sums of the result are those of both solutions by their shares; under a load they bear it.
TEST(SeveralPatches, AMeanBearsItsLoadAndItsApproach) {
  const AlmostOnePlane pair;
  ASSERT_GT(pair.overlapping, 0);
  BemOptions options = coarse();
  CaseSpec spec = pair.spec;
  spec.drive.friction_coefficient = 0.3;
  options.descent = pair.overlapping - 0.5 * kFadingGap;
  spec.vehicle.approach = options.descent * std::cos(reference_of(pair.placement, options.descent).angle);
  const BemResult pressed = solve_bem(spec, pair.placement, options);
  ASSERT_EQ(pressed.others.size(), 1U);
  EXPECT_NEAR(pressed.share + pressed.others[0].share, 1, 1e-15);
  EXPECT_NEAR(pressed.share, 0.5, 1e-6);
  double vertical = 0, power = 0;
  for (const BemPatch* p : patches_of(pressed)) {
    vertical += pressed.share * p->force.z;
    power += pressed.share * p->dissipation;
  }
  for (const BemPatch& p : pressed.others[0].patches) {
    vertical += pressed.others[0].share * p.force.z;
    power += pressed.others[0].share * p.dissipation;
  }
  EXPECT_NEAR(force_on_rail(pressed).z / vertical, 1, 1e-14);
  EXPECT_NEAR(dissipation(pressed) / power, 1, 1e-14);
  options.descent = 0;
  spec.vehicle.set_load(-vertical);
  const BemResult loaded = solve_bem(spec, pair.placement, options);
  EXPECT_EQ(loaded.others.size(), 1U);
  EXPECT_NEAR(-force_on_rail(loaded).z / spec.vehicle.load(), 1, 2 * options.balance);
  EXPECT_NEAR(norm(force_on_rail(loaded) - force_on_rail(pressed)) / -vertical, 0, 1e-4);
}

// CONTACT's rules, by module 1 of extras/cntc: cells of 0.5 mm, friction 1e-4.
TEST(PlaneOfAPatch, GivesTheLateralForceOfContactsRules) {
  constexpr double kForces[][2] = {{-1, 1740.8}, {-0.5, 2159.7}, {0, 2751.7}, {0.5, 3502.5},
                                   {1, 4332.7},  {2, 5854.2},    {3, 7077.7}};
  for (const auto& [shift, force] : kForces) {
    const CaseSpec spec = european(1e-3 * shift);
    const BemResult r = solve_bem(spec, place(spec, {}), coarse());
    EXPECT_NEAR(force_on_rail(r).y, force, 2e-3 * force) << shift;
  }
}

/// Mean slope of the rail, by the pressure on it.
double slope_under_pressure(const Placement& p, const ContactField& field) {
  double sum = 0, total = 0;
  for (std::size_t k = 0; k < field.p.size(); ++k) {
    if (!(field.p[k] > 0)) continue;
    const Vec2 at = model_to_rail(p.track, {field.y[k], field.z[k]}),
               t = rail_to_model(p.track, p.rail.at(p.rail.s_at_y(at.y)).tangent);
    sum += field.p[k] * t.z / t.y;
    total += field.p[k];
  }
  return sum / total;
}

// The overlap's inclinations have one mean, the rail's and the wheel's: its depth is 0 at both ends.
TEST(PlaneOfAPatch, IsTheSlopeUnderItsOwnPressure) {
  for (const double shift : {0.0, 0.5e-3, 1e-3, 3e-3}) {
    const CaseSpec spec = european(shift);
    const Placement p = place(spec, {});
    const BemResult r = solve_bem(spec, p, coarse());
    EXPECT_NEAR(std::tan(r.contact.angle), slope_under_pressure(p, r.field), 1.5e-3) << shift;
  }
}

TEST(PlaneOfAPatch, MovesWithoutStepsOverTheShift) {
  constexpr double kStep = 0.02e-3, kWay = 2e-3;
  std::vector<double> force, angle, radius;
  for (double shift = -0.5 * kWay; shift <= 0.5 * kWay; shift += kStep) {
    const CaseSpec spec = european(shift);
    BemOptions options;
    options.cell = 1e-3;
    const BemResult r = solve_bem(spec, place(spec, {}), options);
    force.push_back(force_on_rail(r).y);
    angle.push_back(r.contact.angle);
    radius.push_back(r.contact.rolling_radius);
  }
  for (const std::vector<double>& of : {force, angle, radius}) {
    const auto [least, most] = std::ranges::minmax(of);
    double largest = 0;
    for (std::size_t k = 1; k < of.size(); ++k) largest = std::max(largest, std::abs(of[k] - of[k - 1]));
    EXPECT_LT(largest, 0.04 * (most - least)) << "of a way of a hundred steps";
  }
}

TEST(PlaneOfAPatch, OfALevelContactIsThatOfTheFirstTouch) {
  CaseSpec spec = driven(0.1);
  spec.geometry.wheel_profile = "arc:R=200 mm";
  spec.geometry.rail_profile = "arc:R=300 mm";
  spec.geometry.cant = 0;
  const Placement p = place(spec, {});
  EXPECT_TRUE(same_place(reference_of(p, 0.1e-3), p.contact));
}

/// The tread and the gauge corner of S1002 on UIC60, some 7 and 17 degrees steep, 4 mm apart.
CaseSpec tread_and_corner(double shift) {
  CaseSpec spec = driven(0.1);
  spec.geometry.rail_profile = "UIC60";
  spec.geometry.wheel_profile = "S1002";
  spec.geometry.wheel_radius = 0.46;
  spec.geometry.back_to_back = 1.36;
  spec.geometry.gauge_depth = 14e-3;
  spec.geometry.lateral_shift = shift;
  spec.geometry.yaw = 8e-3;
  return spec;
}

TEST(SeveralPatches, InOnePlaneAreTakenApartWhereTheyAreNotConnected) {
  const CaseSpec spec = tread_and_corner(5.3e-3);
  const Placement p = place(spec, {});
  BemOptions options;
  options.cell = 1e-3;
  const BemResult r = solve_bem(spec, p, options);
  ASSERT_EQ(r.further.size(), 1U);
  const BemPatch& other = r.further[0];
  EXPECT_EQ(r.contact.angle, other.contact.angle);
  EXPECT_GT(std::abs(r.place.angle - other.place.angle), 0.15);
  for (const BemPatch* piece : {static_cast<const BemPatch*>(&r), &other}) {
    EXPECT_NEAR(std::tan(piece->place.angle), slope_under_pressure(p, piece->field), 0.015);
    EXPECT_NEAR(piece->surroundings.rail_y, p.rail.at(piece->place.rail_s).position.y, 1e-12);
    double normal = 0, across = 0, turn = 0, low = 1, high = -1;
    for (std::size_t k = 0; k < piece->field.p.size(); ++k) {
      const ContactField& f = piece->field;
      normal += f.p[k] * f.area[k];
      across += f.q_y[k] * f.area[k];
      const double t = piece->grid.y(static_cast<int>(k) % piece->grid.ny),
                   from = dot(piece->place.point - piece->contact.point,
                              {std::cos(piece->contact.angle), std::sin(piece->contact.angle)});
      turn += f.area[k] * ((f.x[k] + piece->contact.x - piece->place.x) * f.q_y[k] - (t - from) * f.q_x[k]);
      if (!(f.p[k] > 0)) continue;
      low = std::min(low, t - from);
      high = std::max(high, t - from);
    }
    EXPECT_NEAR(piece->force.normal, normal, 1e-9 * normal);
    EXPECT_NEAR(piece->force.tangential, across, 1e-9 * normal);
    EXPECT_NEAR(piece->force.moment, turn, 1e-9 * normal);
    EXPECT_LT(low, 0) << "its place is under it";
    EXPECT_GT(high, 0);
    EXPECT_LT(high - low, 10e-3) << "without the gap";
  }
  for (std::size_t k = 0; k < r.field.p.size(); ++k) {
    ASSERT_TRUE(r.field.p[k] == 0 || other.field.p[k] == 0);
    ASSERT_EQ(r.field.p[k] + other.field.p[k], r.together->p[k]);
  }
  EXPECT_NEAR(-force_on_rail(r).z / spec.vehicle.load(), 1, 1e-4);
  // the wheel turns as a whole
  EXPECT_NEAR((1 - r.rigid_slip.x) / r.place.rolling_radius, (1 - other.rigid_slip.x) / other.place.rolling_radius,
              1e-12);
}

// Between 5.1 and 5.2 mm of shift the wheel touches first at the gauge corner instead of the tread.
TEST(SeveralPatches, InOnePlaneAreTheSameWhicheverIsFirst) {
  constexpr double kCorner = 0.2;  // rad
  double low = 5.1e-3, high = 5.2e-3;
  const auto first = [](double shift) { return place(tread_and_corner(shift), {}).contact.angle; };
  ASSERT_LT(first(low), kCorner);
  ASSERT_GT(first(high), kCorner);
  while (high - low > 1e-9) (first(0.5 * (low + high)) < kCorner ? low : high) = 0.5 * (low + high);
  BemOptions options;
  options.cell = 1e-3;
  const auto solved = [&](double shift) {
    const CaseSpec spec = tread_and_corner(shift);
    return solve_bem(spec, place(spec, {}), options);
  };
  const BemResult before = solved(low), after = solved(high);
  const double load = tread_and_corner(low).vehicle.load();
  const Vec3 force = force_on_rail(before), change = force_on_rail(after) - force;
  EXPECT_NEAR(change.y, 0, 1e-4 * load);
  EXPECT_NEAR(before.contact.angle, after.contact.angle, 1e-4);
  EXPECT_NEAR(before.force.normal, after.force.normal, 1e-3 * load);
  EXPECT_NEAR(before.force.moment, after.force.moment, 1e-3 * std::abs(before.force.moment));
}

// A shift of a nanometre, at which the wheel touches first at another of its two places, changes nothing.
TEST(SeveralPatches, CreepagesAreTheSameWhicheverIsFirst) {
  CaseSpec spec = driven(0);
  spec.geometry.wheel_profile = "S1002";
  spec.geometry.rail_profile = "UIC60";
  spec.geometry.gauge_depth = 14e-3;
  spec.geometry.back_to_back = 1.36;
  spec.geometry.wheel_radius = 0.46;
  spec.geometry.cant = 0.025;
  spec.drive.creepage = -1e-3;
  spec.drive.lateral_creepage = 1e-3;
  const auto at = [&](double shift) {
    spec.geometry.lateral_shift = shift;
    return place(spec, {});
  };
  double low = 3e-3, high = 6.5e-3;
  const double between = 0.3;  // rad
  ASSERT_LT(at(low).contact.angle, between);
  ASSERT_GT(at(high).contact.angle, between);
  while (high - low > 1e-9) (at(0.5 * (low + high)).contact.angle < between ? low : high) = 0.5 * (low + high);
  BemOptions options;
  options.cell = 1e-3;
  const auto change = [&](CreepageOf of) {
    spec.drive.creepage_of = of;
    const Placement before = at(low);
    const BemResult one = solve_bem(spec, before, options);
    EXPECT_EQ(one.further.size(), 1U);
    const Placement after = at(high);
    const Vec3 d = force_on_rail(solve_bem(spec, after, options)) - force_on_rail(one);
    return std::hypot(d.x, d.y) / spec.vehicle.load();
  };
  EXPECT_LT(change(CreepageOf::wheel), 2e-4);
  EXPECT_LT(change(CreepageOf::contact), 2e-4);
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
  const double weight = spec.vehicle.load();
  const BemResult r = solve_bem(spec, level_crowns(0), coarse());
  ASSERT_EQ(r.further.size(), 1U);
  EXPECT_NEAR(lateral_friction(r) / weight, 0.08, 1e-6);
  EXPECT_NEAR(force_on_rail(r).x / weight, -0.1, 1e-6);
  EXPECT_NEAR(-force_on_rail(r).z / weight, 1, 1e-6);
  EXPECT_NEAR(r.force.tangential / weight, 0.04, 1e-4);
  EXPECT_NEAR(r.rigid_slip.y, r.further[0].rigid_slip.y, 1e-12);
  spec.vehicle.set_load(0.5 * weight);
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
  const double weight = spec.vehicle.load();
  const Placement p = place(spec, {});
  BemOptions options;
  options.cell = 1e-3;
  for (const bool creepage : {false, true}) {
    if (creepage) spec.drive.creepage = 0;
    const BemResult r = solve_bem(spec, p, options);
    const BemPatch* other = in_another_plane(r);
    ASSERT_NE(other, nullptr);
    EXPECT_GT(std::abs(r.contact.angle - other->contact.angle), kAngleOfOnePlane);
    EXPECT_NEAR(lateral_friction(r) / weight, 0.05, 1e-6);
    EXPECT_NEAR(-force_on_rail(r).z / weight, 1, 1e-6);
    if (!creepage) {
      EXPECT_NEAR(force_on_rail(r).x / weight, 0, 1e-6);
    }
    EXPECT_NEAR(r.rigid_slip.y * std::cos(r.place.angle), other->rigid_slip.y * std::cos(other->place.angle), 1e-12);
  }
}

TEST(SeveralPatches, TractionUpToTheFrictionOfBothIsFoundAndBeyondItRefused) {
  const BemResult r = solve_bem(driven(0.29), level_crowns(0.05), coarse());
  EXPECT_NEAR(force_on_rail(r).x / (-0.29 * driven(0.29).vehicle.load()), 1, 2e-5);
  EXPECT_GT(r.further.at(0).patch.slip_area, 0.999 * r.further.at(0).patch.area)
      << "one slides, the other does not yet";
  EXPECT_LT(r.patch.slip_area, 0.9 * r.patch.area);
  EXPECT_THROW(solve_bem(driven(0.301), level_crowns(0.05), coarse()), CaseError);
}

TEST(SeveralPatches, LayersAreCoupled) {
  CaseSpec spec = driven(0.05);
  spec.layers.push_back({});
  spec.layers[0].material.young = 2 * 210e9;
  const BemResult r = solve_bem(spec, level_crowns(0.05), coarse());
  ASSERT_EQ(r.further.size(), 1U);
  EXPECT_NEAR(-force_on_rail(r).z / spec.vehicle.load(), 1, 1e-6);
  EXPECT_NEAR(force_on_rail(r).x / (-0.05 * spec.vehicle.load()), 1, 2e-5);
}

}  // namespace
}  // namespace railstrata
