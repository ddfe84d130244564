#include <gtest/gtest.h>

#include <cmath>

#include "core/faults.hpp"
#include "geometry/profile_names.hpp"
#include "geometry/rail_outline.hpp"
#include "tests/geometry/rail_section.hpp"

namespace railstrata {
namespace {

constexpr double mm = 1e-3;

Profile rail(const std::string& name) { return builtin_profile(ProfileKind::rail, name); }

TEST(SectionProperties, of_a_rectangle_are_the_textbooks) {
  const SectionProperties p = section_properties({{1, 2}, {4, 2}, {4, 7}, {1, 7}});
  EXPECT_NEAR(p.area, 15, 1e-12);
  EXPECT_NEAR(p.centroid_height, 2.5, 1e-12);
  EXPECT_NEAR(p.i_horizontal, 3 * 125 / 12.0, 1e-12);
  EXPECT_NEAR(p.i_vertical, 5 * 27 / 12.0, 1e-12);
}

TEST(RailOutline, CN60_has_the_section_properties_of_its_drawing) {  // data/profiles/profiles_arcs.json; GB 2585: 77.45
                                                                     // cm2, 3217 and 524 cm4
  const Profile head = rail("CN60");
  const SectionProperties p = section_properties(outline_polygon(head, rail_outline(head)));
  EXPECT_NEAR(p.area, 77.40e-4, 0.01e-4);
  EXPECT_NEAR(p.i_horizontal, 3215.7e-8, 0.1e-8);
  EXPECT_NEAR(p.i_vertical, 523.9e-8, 0.1e-8);
  EXPECT_NEAR(p.centroid_height, 81.20 * mm, 0.01 * mm);
}

TEST(RailOutline, CN60_is_73_mm_wide_at_the_head_150_at_the_base_and_176_high) {
  const RailOutline o = rail_outline(rail("CN60"));
  // The head's width is measured where the 1:20 face and the 1:3 underside would meet without their fillet.
  const Vec2 face{o.flank_y, o.flank_z}, on_underside{34.345212928689655 * mm, -37.051595690436784 * mm};
  const double drop = ((face.y - on_underside.y) - (on_underside.z - face.z) * -3.0) / (1.0 / 20 - 3.0);
  EXPECT_NEAR(2 * (face.y + drop / 20), 73 * mm, 0.05 * mm);
  EXPECT_NEAR(o.foot_top.back().y, 75 * mm, 1e-12);
  EXPECT_NEAR(o.base_z, -176 * mm, 1e-12);
  double thinnest = 1;
  for (const Vec2 p : o.web) thinnest = std::min(thinnest, p.y);
  EXPECT_NEAR(2 * thinnest, 16.5 * mm, 1e-3 * mm);
}

// EN 13674-1: areas, moments about both axes; heights and widths
TEST(RailOutline, European_rails_have_the_section_properties_of_their_standard) {
  const auto properties = [](const char* name) {
    const Profile head = rail(name);
    const RailOutline o = rail_outline(head, rail_section(name, TrackKind::CN));
    EXPECT_NEAR(o.base_z, name == std::string("UIC60") ? -172 * mm : -159 * mm, 1e-12);
    EXPECT_NEAR(o.foot_top.back().y, name == std::string("UIC60") ? 75 * mm : 70 * mm, 1e-12);
    return section_properties(outline_polygon(head, o));
  };
  const SectionProperties uic60 = properties("UIC60"), uic54 = properties("UIC54");
  EXPECT_NEAR(uic60.area, 76.70e-4, 0.02e-4);
  EXPECT_NEAR(uic60.i_horizontal, 3038.3e-8, 0.003 * 3038.3e-8);
  EXPECT_NEAR(uic60.i_vertical, 512.3e-8, 0.003 * 512.3e-8);
  EXPECT_NEAR(uic60.centroid_height, 80.92 * mm, 0.02 * mm);
  EXPECT_NEAR(uic54.area, 69.77e-4, 0.02e-4);
  EXPECT_NEAR(uic54.i_horizontal, 2337.9e-8, 0.003 * 2337.9e-8);
  EXPECT_NEAR(uic54.i_vertical, 419.2e-8, 0.012 * 419.2e-8);
}

TEST(RailOutline, a_head_of_a_file_has_the_section_of_its_track) {
  EXPECT_EQ(rail_section("mine.csv", TrackKind::EN), RailSection::UIC60);
  EXPECT_EQ(rail_section("mine.csv", TrackKind::CN), RailSection::CN60);
  EXPECT_EQ(rail_section("CN60", TrackKind::EN), RailSection::CN60);
}

TEST(RailOutline, parts_join_and_run_without_steps) {
  for (const char* name : {"CN60", "UIC60", "UIC54"}) {
    const Profile head = rail(name);
    const RailOutline o = rail_outline(head, rail_section(name, TrackKind::CN));
    EXPECT_NEAR(norm(o.underside.front() - Vec2{o.flank_y, o.flank_z}), 0, 1e-12);
    EXPECT_NEAR(norm(o.underside.back() - o.web.front()), 0, 1e-12);
    EXPECT_NEAR(norm(o.web.back() - o.foot_top.front()), 0, 1e-12);
    EXPECT_NEAR(norm(o.foot_top.back() - o.toe.front()), 0, 1e-12);
    EXPECT_NEAR(o.toe.back().z, o.base_z, 1e-12);
    for (const auto* part : {&o.underside, &o.web, &o.foot_top, &o.toe})
      for (std::size_t i = 1; i < part->size(); ++i) EXPECT_LT((*part)[i].z, (*part)[i - 1].z + 1e-12) << name;
    const ProfilePoint end = head.at(head.s_max());  // the flank goes on straight to where the underside begins
    EXPECT_LT(std::abs(cross(end.tangent, Vec2{o.flank_y, o.flank_z} - end.position)), 1e-9) << name;
  }
}

TEST(RailOutline, parts_meet_at_the_45_degree_points_of_the_web_fillets) {
  const RailOutline o = rail_outline(rail("CN60"));
  for (const auto* part : {&o.underside, &o.web}) {
    const Vec2 chord = (*part)[part->size() - 1] - (*part)[part->size() - 2];
    EXPECT_NEAR(std::abs(chord.y / chord.z), 1, 0.05);
  }
}

TEST(RailOutline, heads_without_flanks_are_refused) {
  try {
    rail_outline(rail("arc:R=300 mm"));
    FAIL() << "accepted an arc";
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("the rail profile arc:R=300 mm has no flanks: it ends 1.5 mm below the crown"),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace railstrata
