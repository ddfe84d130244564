#include "clock/contact_mark.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

constexpr MarkLimits kLimits{.change = 0.2, .moved = 1e-3};

double change(const ContactMark& one, const ContactMark& other) { return change_between(one, other, kLimits); }

TEST(ContactMark, PressureCountsByTheLargerOne) {
  EXPECT_DOUBLE_EQ(change({1000e6, {0}}, {800e6, {0}}), 1);
  EXPECT_DOUBLE_EQ(change({800e6, {0}}, {1000e6, {0}}), 1);
}

TEST(ContactMark, PatchesAreComparedByPlaceAndNotByTheirOrder) {
  EXPECT_EQ(change({1e9, {-0.025, 0.001}}, {1e9, {0.001, -0.025}}), 0) << "they have changed places in pressure";
  EXPECT_NEAR(change({1e9, {-0.025, 0.001}}, {1e9, {0.0015, -0.025}}), 0.5, 1e-9);
}

TEST(ContactMark, APatchThatComesOrGoesIsAChangeOfOne) {
  EXPECT_DOUBLE_EQ(change({1e9, {0.001}}, {1e9, {-0.025, 0.001}}), 1);
  EXPECT_DOUBLE_EQ(change({1e9, {-0.025, 0.001}}, {1e9, {0.001}}), 1);
}

TEST(ContactMark, ALoadThatGoesFromTreadToFlangeIsFourAndNoMore) {
  EXPECT_DOUBLE_EQ(change({1e9, {0.001}}, {1e9, {-0.025}}), 4);
  EXPECT_DOUBLE_EQ(change({0, {}}, {1e9, {0.001}}), 4) << "it can be solved now";
  EXPECT_EQ(change({0, {}}, {0, {}}), 0);
}

}  // namespace
}  // namespace railstrata
