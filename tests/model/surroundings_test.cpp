#include "model/surroundings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/profile_names.hpp"

namespace railstrata {
namespace {

SolvedPatch patch_of(double low, double high) { return {low, high, -0.02, 0.02, 85e3, 90e-6}; }

CaseSpec arcs(const char* rail, const char* wheel) {
  CaseSpec spec;
  spec.geometry.rail_profile = rail;
  spec.geometry.wheel_profile = wheel;
  spec.geometry.rail_shape = RailShape::block;
  spec.geometry.wheel_shape = WheelShape::disc;
  spec.geometry.cant = 0;
  return spec;
}

PatchSurroundings around(const CaseSpec& spec, const SolvedPatch& patch) {
  return patch_surroundings(spec, place(spec, {}), patch);
}

CaseSpec shifted(double shift) {
  CaseSpec spec;
  spec.geometry.wheel_profile = "S1002";
  spec.geometry.rail_profile = "UIC60";
  spec.geometry.lateral_shift = shift;
  return spec;
}

TEST(Surroundings, AnArcTurnsByItsChordOverItsRadiusAndOpensByTheRelativeRadius) {
  const PatchEdges on_flat = around(arcs("flat", "arc:R=100 mm"), patch_of(-5e-3, 5e-3)).edges;
  EXPECT_NEAR(on_flat.angle_spanned, 0.1, 1e-4);
  EXPECT_NEAR(on_flat.half_width_over_radius, 0.05, 1e-4);
  // conformal: a wheel hollow by 110 mm on a rail of 100 mm turns with it
  const PatchEdges hollow = around(arcs("arc:R=100 mm", "arc:R=-110 mm"), patch_of(-20e-3, 20e-3)).edges;
  EXPECT_NEAR(hollow.angle_spanned, 0.4, 1e-3);
  EXPECT_NEAR(hollow.half_width_over_radius, 20e-3 * (1 / 0.1 - 1 / 0.11), 1e-3);
}

TEST(Surroundings, TheNearestEdgeIsThatOfTheBlockOrOfANarrowerLayer) {
  CaseSpec spec = arcs("flat", "arc:R=400 mm");
  spec.geometry.block_width = 0.05;
  const PatchEdges block = around(spec, patch_of(-4e-3, 6e-3)).edges;
  EXPECT_NEAR(block.edge_share, 5.0 / 24, 1e-6) << "the patch's middle stands 1 mm beside the block's";
  EXPECT_EQ(block.edge, "the side of the block at y = 25.0 mm");
  spec.layers.push_back({});
  spec.layers[0].name = "pad";
  spec.layers[0].width = 0.02;
  const PatchEdges layer = around(spec, patch_of(-4e-3, 6e-3)).edges;
  EXPECT_NEAR(layer.edge_share, 5.0 / 9, 1e-6);
  EXPECT_EQ(layer.edge, "the edge of the rail's layer \"pad\" at y = 10.0 mm");
}

TEST(Surroundings, AProfilesSideIsWhereItHasTurnedBy45Degrees) {
  // UIC60's gauge corner has a radius of 13 mm, so that 45 degrees lie some 4 mm inside the head's side at 36 mm
  const CaseSpec spec = shifted(0);
  const Placement p = place(spec, {});
  const double y = p.rail.at(p.contact.rail_s).position.y, half = 5e-3;
  const PatchEdges edges = around(spec, patch_of(-half, half)).edges;
  EXPECT_NEAR(std::abs(y) + half / edges.edge_share, 32e-3, 1.5e-3);
  EXPECT_EQ(edges.edge.substr(0, 20), "the side of the rail");
}

TEST(Surroundings, TheFlangeStandsInsideTheGaugeUntilTheWheelLeavesIt) {
  const FlangePlace inside = *around(shifted(0), patch_of(-5e-3, 5e-3)).flange;
  EXPECT_NEAR(inside.height, 28e-3, 0.1e-3) << "S1002";
  EXPECT_LT(inside.beyond_gauge, -10e-3);
  EXPECT_LT(inside.contact_depth, 1e-3);
  const FlangePlace derailed = *around(shifted(50e-3), patch_of(-2e-3, 2e-3)).flange;
  EXPECT_GT(derailed.beyond_gauge, 0);
  EXPECT_GT(derailed.contact_depth, 26e-3);
  EXPECT_FALSE(around(arcs("flat", "arc:R=400 mm"), patch_of(-5e-3, 5e-3)).flange);
}

/// A rail with two crowns of R = 100 mm at y = -12 and 12 mm and a hollow between them, canted by 1 in 1000: one crown
/// stands 24 um higher. The wheel is flat.
Placement two_crowns() {
  constexpr double kR = 0.1, kC = 12e-3, kOuter = 22e-3;
  const double h = std::sqrt(4 * kR * kR - kC * kC) - kR,  // of the hollow's centre
      join = 0.5 * (h - kR), end = std::sqrt(kR * kR - (kOuter - kC) * (kOuter - kC)) - kR;
  Placement p{circular_profile(ProfileKind::wheel, HUGE_VAL),
              Profile::from_segments(ProfileKind::rail, "two crowns",
                                     {{{-kOuter, end}, {-kC / 2, join}, {-kC, -kR}, kR},
                                      {{-kC / 2, join}, {kC / 2, join}, {0, h}, kR},
                                      {{kC / 2, join}, {kOuter, end}, {kC, -kR}, kR}}),
              {},
              {},
              {}};
  p.track.cant = 1e-3;
  p.contact = place_wheel(p.wheel, p.rail, p.track);
  return p;
}

// The other crown overlaps by the descent less 24 um less the depression N/(pi E* r), 85 kN/(pi 115.4 GPa 24 mm).
TEST(Surroundings, TheOtherOfTwoCrownsIsASecondContact) {
  const Placement p = two_crowns();
  const SolvedPatch patch{-5e-3, 5e-3, -7e-3, 7e-3, 85e3, 90e-6};
  const auto second = second_contact(CaseSpec{}, p, patch);
  ASSERT_TRUE(second);
  const double first = p.rail.at(p.contact.rail_s).position.y;
  EXPECT_NEAR(std::abs(first), 12e-3, 0.2e-3);
  EXPECT_NEAR(second->rail_y, -first, 0.5e-3);
  EXPECT_NEAR(second->overlap, 90e-6 - 24e-6 - 85e3 / (std::numbers::pi * 115.385e9 * 24e-3), 1e-6);
}

TEST(Surroundings, ThereIsNoSecondContactUnderALightLoadOrInWhatTheEngineHasCovered) {
  const Placement p = two_crowns();
  EXPECT_FALSE(second_contact(CaseSpec{}, p, {-1e-3, 1e-3, -2e-3, 2e-3, 1e3, 5e-6}));
  EXPECT_FALSE(second_contact(CaseSpec{}, p, {-5e-3, 5e-3, -0.03, 0.03, 85e3, 90e-6}));
  for (const CaseSpec& spec : {shifted(0), arcs("flat", "arc:R=400 mm")})
    EXPECT_FALSE(second_contact(spec, place(spec, {}), patch_of(-5e-3, 5e-3)));
}

}  // namespace
}  // namespace railstrata
