// Forces of single patches and profiles from arrays, in the C interface.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "tests/capi/contact_handle.hpp"

namespace railstrata {
namespace {

rs_patch patch_of(const Handle& contact, int patch, const double* about = nullptr) {
  rs_patch out{};
  out.size = sizeof(out);
  rs_error error{};
  EXPECT_EQ(rs_patch_forces(contact.handle, patch, about, &out, &error), RS_OK) << error.message;
  return out;
}

rs_state pulling(double shift) {
  rs_state out = state_of(RS_LATERAL_SHIFT | RS_CREEPAGE_X | RS_YAW);
  out.lateral_shift = shift;
  out.creepage_x = -1e-3;
  out.yaw = 2e-3;
  return out;
}

struct CPatchForcesOf : OfBothPairs {};
INSTANTIATE_TEST_SUITE_P(Pairs, CPatchForcesOf, testing::ValuesIn(kBothPairs), OfBothPairs::name);

TEST_P(CPatchForcesOf, AddUpAndTurnAboutAnyPoint) {
  Handle contact(GetParam());
  ASSERT_EQ(contact.solve(pulling(2e-3)), RS_OK) << contact.error.message;
  double sum[3] = {0, 0, 0};
  for (int k = 0; k < contact.forces.patches; ++k)
    for (int i : {0, 1, 2}) sum[i] += patch_of(contact, k).force[i];
  const double load = contact.forces.force_z;
  EXPECT_NEAR(sum[0], contact.forces.force_x, 1e-12 * load);
  EXPECT_NEAR(sum[1], contact.forces.force_y, 1e-12 * load);
  EXPECT_NEAR(sum[2], contact.forces.force_z, 1e-12 * load);

  const rs_patch about_origin = patch_of(contact, 0), about_point = patch_of(contact, 0, about_origin.point);
  const double *r = about_origin.point, *f = about_origin.force;
  const double moved[] = {r[1] * f[2] - r[2] * f[1], r[2] * f[0] - r[0] * f[2], r[0] * f[1] - r[1] * f[0]};
  for (int i : {0, 1, 2}) EXPECT_NEAR(about_origin.moment[i], about_point.moment[i] + moved[i], 1e-9 * load);
  // across the normal only the tractions turn about the contact point
  const double c = std::cos(about_point.contact_angle), s = std::sin(about_point.contact_angle);
  EXPECT_NEAR(-s * about_point.moment[1] + c * about_point.moment[2], about_point.spin_moment,
              1e-6 * std::abs(about_point.spin_moment));
}

TEST_P(CPatchForcesOf, NameThePlacesOnBothProfiles) {
  std::vector<const char*> upright = GetParam();
  upright.push_back("geometry.cant=0");
  Handle contact(upright);
  ASSERT_EQ(contact.solve(pulling(1e-3)), RS_OK) << contact.error.message;
  const rs_patch p = patch_of(contact, 0);
  EXPECT_NEAR(p.on_rail[0], p.point[1], 1e-15);
  EXPECT_GT(p.point[2], p.on_rail[1]) << "half way to the wheel that just touches";
  EXPECT_NEAR(p.on_rail[1], p.point[2], 2e-6);
  double radius = 0;
  ASSERT_EQ(rs_contact_number(contact.handle, "geometry.wheel_radius", &radius, nullptr), RS_OK);
  EXPECT_NEAR(p.rolling_radius, radius - p.on_wheel[1], 1e-5);  // less by the yaw
  EXPECT_EQ(p.contact_angle, contact.forces.contact_angle);
  EXPECT_EQ(p.cells, contact.forces.cells);
  EXPECT_EQ(p.p_max, contact.forces.p_max);
}

// S1002 on UIC60 on tread and gauge corner, 4 mm apart and solved in one plane.
TEST(CPatchForces, OfTreadAndGaugeCornerAreApart) {
  Handle contact(
      {"geometry.wheel_profile=\"S1002\"", "geometry.rail_profile=\"UIC60\"", "geometry.wheel_radius=\"460 mm\""});
  rs_set_cell(contact.handle, 1e-3, nullptr);
  ASSERT_EQ(contact.solve(pulling(5.3e-3)), RS_OK) << contact.error.message;
  ASSERT_EQ(contact.forces.patches, 2);
  const rs_patch one = patch_of(contact, 0), other = patch_of(contact, 1);
  EXPECT_GT(std::abs(one.contact_angle - other.contact_angle), 0.15);
  EXPECT_GT(std::abs(one.on_rail[0] - other.on_rail[0]), 9e-3);
  double sum = 0;
  for (const rs_patch& p : {one, other}) {
    EXPECT_GT(p.normal_force, 0.1 * contact.forces.force_z);
    sum += p.force[2];
  }
  EXPECT_NEAR(sum, contact.forces.force_z, 1e-12 * sum);
}

TEST_P(CPatchForcesOf, RefuseWhatIsNotThere) {
  Handle contact(GetParam());
  rs_patch out{};
  out.size = sizeof(out);
  EXPECT_EQ(rs_patch_forces(contact.handle, 0, nullptr, &out, &contact.error), RS_CASE);
  ASSERT_EQ(contact.solve(pulling(0)), RS_OK);
  EXPECT_EQ(rs_patch_forces(contact.handle, contact.forces.patches, nullptr, &out, &contact.error), RS_CASE);
  const double about[] = {0, NAN, 0};
  EXPECT_EQ(rs_patch_forces(contact.handle, 0, about, &out, &contact.error), RS_CASE);
  out.size = 8;
  EXPECT_EQ(rs_patch_forces(contact.handle, 0, nullptr, &out, &contact.error), RS_CASE);
}

/// Rails from arrays under the wheels of both pairs.
struct CProfiles : OfBothPairs {
  std::vector<const char*> with(const std::string& rail) const {
    std::vector<const char*> out = GetParam();
    out.push_back(rail.c_str());
    return out;
  }
};
INSTANTIATE_TEST_SUITE_P(Pairs, CProfiles, testing::ValuesIn(kBothPairs), OfBothPairs::name);

/// A rail head of the radius R with steep flanks, every 0.3 mm.
std::vector<double> round_head(double radius) {
  constexpr double kHalfWidth = 36e-3, kFlank = 20e-3;
  std::vector<double> out;
  for (int k = -121; k <= 121; ++k) {
    const double y = 0.3e-3 * k;
    out.push_back(y);
    out.push_back(-y * y / (2 * radius) - kFlank * std::pow(y / kHalfWidth, 16));
  }
  return out;
}

TEST_P(CProfiles, FromAnArrayAreThoseOfAFile) {
  const std::string file = testing::TempDir() + "round_head.csv";
  const std::vector<double> head = round_head(0.2);
  {
    std::ofstream out(file);
    out.precision(17);
    for (std::size_t k = 0; k < head.size(); k += 2) out << head[k] << ' ' << head[k + 1] << '\n';
  }
  const std::string from_file = "geometry.rail_profile=" + file;
  Handle wanted(with(from_file)), contact(GetParam());
  ASSERT_EQ(contact.solve(pulling(0)), RS_OK);
  const double before = contact.forces.p_max;
  ASSERT_EQ(rs_set_profile(contact.handle, RS_RAIL, head.data(), head.size() / 2, &contact.error), RS_OK)
      << contact.error.message;
  int nx = 0;
  EXPECT_EQ(rs_points(contact.handle, 0, &nx, nullptr, nullptr), RS_CASE);  // the last solution is gone
  rs_forget(contact.handle);
  ASSERT_EQ(contact.solve(pulling(0)), RS_OK) << contact.error.message;
  ASSERT_EQ(wanted.solve(pulling(0)), RS_OK) << wanted.error.message;
  EXPECT_EQ(contact.forces.p_max, wanted.forces.p_max);
  EXPECT_EQ(contact.forces.force_x, wanted.forces.force_x);
  EXPECT_NE(contact.forces.p_max, before);
  std::remove(file.c_str());
}

// A height that is given counts from the profile's point at y = 0: 94 um are most of an approach.
TEST_P(CProfiles, ThatAreMovedToZeroHaveARemarkWithTheirName) {
  std::vector<double> head = round_head(0.2);
  for (std::size_t k = 1; k < head.size(); k += 2) head[k] += 94e-6;
  const std::string file = testing::TempDir() + "high_head.csv";
  {
    std::ofstream out(file);
    out.precision(17);
    for (std::size_t k = 0; k < head.size(); k += 2) out << head[k] << ' ' << head[k + 1] << '\n';
  }
  const std::string from_file = "geometry.rail_profile=" + file;
  Handle contact(with(from_file));
  ASSERT_EQ(contact.solve(pulling(0)), RS_OK) << contact.error.message;
  const std::string moved = "z was shifted by -94.0 um";
  EXPECT_NE(std::string(rs_remarks(contact.handle)).find("high_head.csv: " + moved), std::string::npos);
  for (int times : {1, 2}) {
    ASSERT_EQ(rs_set_profile(contact.handle, RS_RAIL, head.data(), head.size() / 2, &contact.error), RS_OK);
    ASSERT_EQ(contact.solve(pulling(0)), RS_OK) << contact.error.message;
    const std::string remarks = rs_remarks(contact.handle);
    EXPECT_EQ(remarks.find("high_head.csv"), std::string::npos) << times;
    EXPECT_NE(remarks.find("rail: " + moved), std::string::npos) << times;
    EXPECT_EQ(remarks.find(moved), remarks.rfind(moved)) << times;
  }
  std::remove(file.c_str());
}

TEST_P(CProfiles, RefuseAnArrayThatIsNone) {
  Handle contact(GetParam());
  const double points[] = {0, 0, 1e-3, 0};
  EXPECT_EQ(rs_set_profile(contact.handle, RS_RAIL, points, 2, &contact.error), RS_CASE);
  EXPECT_NE(std::string(contact.error.message).find("too few"), std::string::npos) << contact.error.message;
  EXPECT_EQ(rs_set_profile(contact.handle, 7, points, 2, &contact.error), RS_CASE);
  EXPECT_EQ(rs_set_profile(contact.handle, RS_WHEEL, nullptr, 2, &contact.error), RS_CASE);
  EXPECT_EQ(contact.solve(pulling(0)), RS_OK) << contact.error.message;
}

}  // namespace
}  // namespace railstrata
