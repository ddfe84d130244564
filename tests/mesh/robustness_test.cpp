#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/faults.hpp"
#include "geometry/profile_names.hpp"
#include "mesh_checks.hpp"

namespace railstrata {
namespace {

using namespace mesh_checks;

constexpr double kSizes[] = {0.25e-3, 0.5e-3, 1e-3, 2e-3, 4e-3};
constexpr double kThickness[] = {0, 0.05e-3, 0.1e-3, 0.2e-3, 1e-3, 3e-3, 6e-3, 10e-3};

template <class Make>
WorstQuality scan(const Make& make) {
  WorstQuality worst;
  for (double h : kSizes)
    for (double t : kThickness)
      gather(worst, make(MeshSizes{h, 24e-3, 8e-3, 3, 12e-3}, t > 0 ? one_layer(t) : std::vector<LayerMesh>{}),
             fmt::format("h {:g} mm, layer {:g} mm", 1e3 * h, 1e3 * t));
  return worst;
}

class RailProfiles : public testing::TestWithParam<const char*> {};
class WheelProfiles : public testing::TestWithParam<const char*> {};

TEST_P(RailProfiles, GiveNoPoorElementForAnySizeAndLayer) {
  const Profile profile = builtin_profile(ProfileKind::rail, GetParam());
  for (double s : {-8e-3, 0.0, 3e-3, 12e-3}) {
    const WorstQuality worst = scan([&](const MeshSizes& sizes, const std::vector<LayerMesh>& layers) {
      return mesh_rail(profile, kTrack, rail_spec(s, layers), sizes);
    });
    EXPECT_GT(worst.scaled_jacobian, 0.1) << worst.where << ", contact at s = " << s;
    RecordProperty(fmt::format("scaled_jacobian_min_at_{:g}_mm", 1e3 * s),
                   fmt::format("{:.3f}: {}", worst.scaled_jacobian, worst.where));
  }
}

/// Sections under contacts from the field side over the crown down to the gauge face.
TEST_P(RailProfiles, GiveNoPoorElementWhereTheFineColumnsGoDownTheFlank) {
  const Profile profile = builtin_profile(ProfileKind::rail, GetParam());
  for (double s = -44e-3; s <= 44e-3; s += 4e-3)
    for (const double h : {0.5e-3, 2e-3})
      for (const double t : {0.0, 3e-3}) {
        const MeshSizes sizes{.element = h, .fine_width = 24e-3, .fine_depth = 8e-3, .to_sides = true};
        WorstQuality worst;
        gather(worst, mesh_rail(profile, kTrack, rail_spec(s, t > 0 ? one_layer(t) : std::vector<LayerMesh>{}), sizes),
               "");
        EXPECT_GT(worst.scaled_jacobian, 0.05) << s << " " << h << " " << t << " " << worst.where;
      }
}

TEST_P(WheelProfiles, GiveNoPoorElementForAnySizeAndLayer) {
  const Profile profile = builtin_profile(ProfileKind::wheel, GetParam());
  for (double s : {-12e-3, 0.0, 3e-3, 15e-3}) {
    const WorstQuality worst = scan([&](const MeshSizes& sizes, const std::vector<LayerMesh>& layers) {
      return mesh_wheel(profile, 0.430, {}, wheel_spec(s, layers), sizes);
    });
    EXPECT_GT(worst.scaled_jacobian, 0.1) << worst.where << ", contact at s = " << s;
    RecordProperty(fmt::format("scaled_jacobian_min_at_{:g}_mm", 1e3 * s),
                   fmt::format("{:.3f}: {}", worst.scaled_jacobian, worst.where));
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, RailProfiles, testing::Values("CN60", "UIC60", "UIC54"));
INSTANTIATE_TEST_SUITE_P(Shipped, WheelProfiles, testing::Values("LMA", "S1002"));

TEST(LmaWheel, GivesNoPoorElementForDeepLayersBesideTheChamfer) {
  const Profile lma = builtin_profile(ProfileKind::wheel, "LMA");
  WorstQuality worst;
  for (int ratio : {1, 3})
    gather(worst, mesh_wheel(lma, 0.430, {}, wheel_spec(20e-3, one_layer(8e-3)), {3e-3, 10e-3, 2e-3, ratio, 6e-3}),
           fmt::format("ratio {}", ratio));
  EXPECT_GT(worst.scaled_jacobian, 0.1) << worst.where;
}

TEST(SimpleShapes, GiveNoPoorElementForAnySizeAndLayer) {
  const Profile rail = builtin_profile(ProfileKind::rail, "CN60"), wheel = builtin_profile(ProfileKind::wheel, "LMA");
  const WorstQuality block = scan([&](const MeshSizes& sizes, const std::vector<LayerMesh>& layers) {
    RailMeshSpec spec = rail_spec(0, layers);
    spec.shape = RailShape::block;
    return mesh_rail(rail, kTrack, spec, sizes);
  });
  EXPECT_GT(block.scaled_jacobian, 0.1) << block.where;
  const WorstQuality disc = scan([&](const MeshSizes& sizes, const std::vector<LayerMesh>& layers) {
    WheelMeshSpec spec = wheel_spec(0, layers);
    spec.shape = WheelShape::disc;
    return mesh_wheel(wheel, 0.430, {}, spec, sizes);
  });
  EXPECT_GT(disc.scaled_jacobian, 0.1) << disc.where;
}

TEST(Primitives, ALayerIsNoWiderThanItsBlock) {
  RailMeshSpec rail = rail_spec();
  rail.shape = RailShape::block;
  rail.block_width = 0.03;
  rail.layers = {{"layer", 1e-3, 0.05}};
  try {
    mesh_rail(circular_profile(ProfileKind::rail, 0.1), {}, rail, {1e-3, 12e-3});
    FAIL() << "not refused";
  } catch (const CaseError& error) {
    EXPECT_NE(std::string(error.what()).find("50 mm, the block is 30.0 mm wide"), std::string::npos) << error.what();
  }
}

TEST(Primitives, ArcsAndPlanesGiveNearlyPerfectBlocksAndDiscs) {
  TrackGeometry flat;
  flat.cant = 0;
  for (double radius : {0.3, std::numeric_limits<double>::infinity()}) {
    RailMeshSpec rail = rail_spec();
    rail.shape = RailShape::block;
    rail.block_width = 0.05;
    WheelMeshSpec wheel = wheel_spec();
    wheel.shape = WheelShape::disc;
    wheel.section.rim_thickness = 0.05;
    for (const SweptBody& body : {mesh_rail(circular_profile(ProfileKind::rail, radius), flat, rail, {}),
                                  mesh_wheel(circular_profile(ProfileKind::wheel, radius), 0.43, {}, wheel, {})})
      for (const BlockQuality& q : measure_quality(body))
        EXPECT_GT(q.scaled_jacobian_min, 0.8) << body.name << " " << q.block;
  }
}

}  // namespace
}  // namespace railstrata
