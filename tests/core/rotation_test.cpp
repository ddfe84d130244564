#include "core/rotation.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "core/simd.hpp"

namespace railstrata {
namespace {

template <class Real>
constexpr Real kEps = std::numeric_limits<Real>::epsilon();

// Angles and components of the size that occur; the same for every run.
class Samples {
 public:
  double angle() { return std::uniform_real_distribution<double>(-4, 4)(random_); }
  double length() { return std::uniform_real_distribution<double>(-2, 2)(random_); }

 private:
  std::mt19937_64 random_{7};
};

template <class Real>
class RotationOf : public testing::Test {};
using Numbers = testing::Types<float, double>;
TYPED_TEST_SUITE(RotationOf, Numbers);

TYPED_TEST(RotationOf, ForwardTurnsZTowardsXAndBackXTowardsZ) {
  using Real = TypeParam;
  const auto quarter = rotation_by(static_cast<Real>(0.5 * std::numbers::pi));
  const auto up = quarter.forward(Real(0), Real(1)), ahead = quarter.back(Real(1), Real(0));
  EXPECT_NEAR(up.x, 1, kEps<Real>);
  EXPECT_NEAR(up.z, 0, kEps<Real>);
  EXPECT_NEAR(ahead.x, 0, kEps<Real>);
  EXPECT_NEAR(ahead.z, 1, kEps<Real>);
}

TYPED_TEST(RotationOf, ForwardAndBackReturnToTheStart) {
  using Real = TypeParam;
  Samples samples;
  for (int n = 0; n < 100; ++n) {
    const auto r = rotation_by(static_cast<Real>(samples.angle()));
    const auto x = static_cast<Real>(samples.length()), z = static_cast<Real>(samples.length());
    const auto there = r.forward(x, z);
    const auto again = r.back(there.x, there.z), inverse = r.inverse().forward(there.x, there.z);
    EXPECT_NEAR(again.x, x, 10 * kEps<Real>);
    EXPECT_NEAR(again.z, z, 10 * kEps<Real>);
    EXPECT_NEAR(inverse.x, x, 10 * kEps<Real>);
    EXPECT_NEAR(inverse.z, z, 10 * kEps<Real>);
  }
}

TYPED_TEST(RotationOf, SumAndDifferenceOfAnglesCompose) {
  using Real = TypeParam;
  Samples samples;
  for (int n = 0; n < 100; ++n) {
    const auto a = static_cast<Real>(samples.angle()), b = static_cast<Real>(samples.angle());
    const auto sum = rotation_by(a + b), difference = rotation_by(a).minus(rotation_by(b));
    // the angle itself is rounded: up to 8 rad here
    EXPECT_NEAR(difference.c, std::cos(a - b), 10 * kEps<Real>);
    EXPECT_NEAR(difference.s, std::sin(a - b), 10 * kEps<Real>);
    const auto once = rotation_by(a).forward(Real(0.3), Real(-1.1)), twice = rotation_by(b).forward(once.x, once.z),
               together = sum.forward(Real(0.3), Real(-1.1));
    EXPECT_NEAR(twice.x, together.x, 20 * kEps<Real>);
    EXPECT_NEAR(twice.z, together.z, 20 * kEps<Real>);
  }
}

TYPED_TEST(RotationOf, PacksGiveWhatScalarsGive) {
  using Real = TypeParam;
  using P = PackOf<Real>;
  Samples samples;
  Rotation<P> r;
  P x, z;
  for (int l = 0; l < kLanesOf<Real>; ++l) {
    const auto one = rotation_by(static_cast<Real>(samples.angle()));
    r.c[l] = one.c;
    r.s[l] = one.s;
    x[l] = static_cast<Real>(samples.length());
    z[l] = static_cast<Real>(samples.length());
  }
  const Rotation<Real> first{r.c[0], r.s[0]};
  const auto forward = r.forward(x, z), back = r.back(x, z), uniform = first.forward(x, z);
  for (int l = 0; l < kLanesOf<Real>; ++l) {
    const Rotation<Real> one{r.c[l], r.s[l]};
    const auto there = one.forward(x[l], z[l]), here = one.back(x[l], z[l]), shared = first.forward(x[l], z[l]);
    const Real last_bits = 2 * kEps<Real> * (std::abs(x[l]) + std::abs(z[l]));
    EXPECT_NEAR(forward.x[l], there.x, last_bits);
    EXPECT_NEAR(forward.z[l], there.z, last_bits);
    EXPECT_NEAR(back.x[l], here.x, last_bits);
    EXPECT_NEAR(back.z[l], here.z, last_bits);
    EXPECT_NEAR(uniform.x[l], shared.x, last_bits);
    EXPECT_NEAR(uniform.z[l], shared.z, last_bits);
  }
}

TEST(Rotation, StartsAsTheIdentity) {
  const Rotation<Pack> none;
  for (int l = 0; l < kLanes; ++l) {
    EXPECT_EQ(none.c[l], 1);
    EXPECT_EQ(none.s[l], 0);
  }
}

TEST(Rotation, VectorsTurnAboutTheLateralAxisAndSectionsRoll) {
  const auto r = rotation_by(0.7);
  const Vec3 v{1.5, -0.2, 0.4}, there = rotate(r, v), again = rotate_back(r, there);
  EXPECT_EQ(there.y, v.y);
  EXPECT_NEAR(there.x, std::cos(0.7) * v.x + std::sin(0.7) * v.z, 4 * kEps<double>);
  EXPECT_NEAR(norm(again - v), 0, 4 * kEps<double>);
  const Vec2 section = roll(r, Vec2{1, 0});
  EXPECT_NEAR(section.y, std::cos(0.7), kEps<double>);
  EXPECT_NEAR(section.z, std::sin(0.7), kEps<double>);
}

TEST(Rotation, TensorsRollWithTheVectorsTheyAreMadeOf) {
  const auto dyad = [](Vec3 v) { return Sym3{v.x * v.x, v.y * v.y, v.z * v.z, v.x * v.y, v.y * v.z, v.x * v.z}; };
  const auto r = rotation_by(-0.4);
  const Vec3 v{0.3, -1.2, 0.7};
  const Vec2 section = roll(r, Vec2{v.y, v.z});
  const Sym3 expected = dyad({v.x, section.y, section.z}), s = roll(r, dyad(v));
  for (auto m : {&Sym3::xx, &Sym3::yy, &Sym3::zz, &Sym3::xy, &Sym3::yz, &Sym3::xz})
    EXPECT_NEAR(s.*m, expected.*m, 8 * kEps<double>);
}

TEST(Rotation, HalfAngleFormKeepsTheDigitsOfOneLessTheCosine) {
  for (double angle : {1e-9, 1e-5, 1e-2}) {
    const auto r = small_rotation_by(angle);
    // 1 - cos a = a^2/2 (1 - a^2/12 + a^4/360 - ...)
    const double a2 = angle * angle, series = 0.5 * a2 * (1 - a2 / 12 * (1 - a2 / 30));
    EXPECT_NEAR(-r.cosine_less_one() / series, 1, 1e-13) << angle;
    EXPECT_NEAR(r.chord_squared() / (2 * series), 1, 1e-13) << angle;
    EXPECT_NEAR(r.rotation().c, std::cos(angle), kEps<double>) << angle;
    EXPECT_EQ(r.rotation().s, std::sin(angle)) << angle;
  }
}

TEST(Rotation, RigidDisplacementTakesTheArmToItsTurnedPlace) {
  const auto r = rotation_by(-0.3);
  const PlaneVector<double> shift{0.1, -0.02}, arm{0.2, 0.4}, u = rigid_displacement(shift, r, arm),
                                                              turned = r.forward(arm.x, arm.z);
  EXPECT_NEAR(arm.x + u.x, shift.x + turned.x, 4 * kEps<double>);
  EXPECT_NEAR(arm.z + u.z, shift.z + turned.z, 4 * kEps<double>);
}

}  // namespace
}  // namespace railstrata
