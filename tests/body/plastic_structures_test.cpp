// Bodies of elements that yield against closed forms of perfect plasticity [Hill1950]. Strains are kept at 1e-5, so
// that finite strains do not matter.
#include <gtest/gtest.h>

#include "body/stress.hpp"
#include "core/parallel.hpp"
#include "tests/body/relaxation.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

constexpr double kYield = 5e6;

class PlasticStructures : public testing::Test {
 protected:
  PlasticStructures() { set_threads(1); }  // a dozen elements
  ~PlasticStructures() override { set_threads(threads_); }
  const int threads_ = max_threads();
};

double breathing_damping(double radius) {
  return 0.7 * std::sqrt(kYoung / 7800) / radius;  // a third of critical: what it holds while loads rise is not felt
}

/// Nodes of a ring sector, in rows from radius 2 to 1 (or 1 to 2), move radially; the inner ones are driven.
struct Sector {
  Sector(SweepKind kind, int rows, double half_width)
      : inner_first(kind == SweepKind::revolve),
        rows_(rows),
        body(structured_body(kind, 1, rows, {-half_width, half_width},
                             [=, this](int c, int r) {
                               const double radius = radius_of(r), angle = (2 * c - 1) * half_width;
                               const double up = kind == SweepKind::revolve ? -1 : 1;
                               return Vec2{radius * std::sin(angle), up * radius * std::cos(angle)};
                             }),
             {kSteel}, {}) {
    make_plastic(body, {perfectly_plastic(kSteel, kYield), {}});
  }
  double radius_of(int row) const {
    const double share = static_cast<double>(row) / rows_;
    return inner_first ? 1 + share : 2 - share;
  }
  int inner_row() const { return inner_first ? 0 : rows_; }
  int outer_row() const { return rows_ - inner_row(); }
  const bool inner_first;
  const int rows_;
  Body body;
};

/// Pressures at the inside of a driven sector, and the plastic radius that follows from its outer displacement.
struct Expansion {
  double pressure, outer;
};
std::vector<Expansion> expand(Sector& s, double half_width, double most, int points, int steps) {
  const bool sphere = s.inner_first;
  const auto outward = [sphere](Vec3 x) {
    Vec3 e = sphere ? x : Vec3{0, x.y, x.z};
    return (1 / norm(e)) * e;
  };
  Relaxation path(
      s.body,
      [&](int node, int, Vec3 x) {
        const Vec3 e = outward(x);
        if (node / 2 == s.inner_row()) return NodeMotion{{}, most * e};
        return NodeMotion{{e}, {}};
      },
      breathing_damping(1.5));
  const double area = sphere ? 4 * half_width * std::sin(half_width) : 4 * half_width * half_width;
  std::vector<Expansion> out;
  for (int k = 1; k <= points; ++k) {
    path.run(static_cast<double>(k) / points, steps / points, 500);
    const double force =
        path.sum([&](int node, int, Vec3 x, Vec3 f) { return node / 2 == s.inner_row() ? dot(f, outward(x)) : 0.0; });
    out.push_back({force / area, norm(path.displacement(2 * s.outer_row(), 0))});
  }
  return out;
}

TEST_F(PlasticStructures, HillsSphereHoldsThePressureOfItsPlasticRadiusWithinHalfAPercent) {
  const double w = 0.02, a = 1, b = 2;
  Sector s(SweepKind::revolve, 20, w);
  int between = 0;
  for (const Expansion& e : expand(s, w, 2e-4, 20, 30000)) {
    // u(b) = b (1 - nu) Y c^3/(E b^3)
    const double c = std::cbrt(e.outer * kYoung * b * b / ((1 - 0.3) * kYield));
    if (c < a) continue;
    if (c < 0.99 * b) {
      ++between;
      const double p = 2 * kYield * std::log(c / a) + 2 * kYield / 3 * (1 - std::pow(c / b, 3));
      EXPECT_NEAR(e.pressure / p, 1, 0.005) << "c = " << c;
    } else {
      EXPECT_NEAR(e.pressure / (2 * kYield * std::log(b / a)), 1, 0.005);
    }
  }
  EXPECT_GT(between, 3);
}

TEST_F(PlasticStructures, ThickCylinderInPlaneStrainHoldsThePressureOfItsPlasticRadiusWithinOnePercent) {
  const double w = 0.02, a = 1, b = 2, k = kYield / std::sqrt(3.0);
  Sector s(SweepKind::extrude, 20, w);
  int between = 0;
  for (const Expansion& e : expand(s, w, 2e-4, 20, 30000)) {
    // u(b) = 2 (1 - nu^2) k c^2/(E b)
    const double c = std::sqrt(e.outer * kYoung * b / (2 * (1 - 0.09) * k));
    if (c < a) continue;
    if (c < 0.99 * b) {
      ++between;
      EXPECT_NEAR(e.pressure / (k * (2 * std::log(c / a) + 1 - c * c / (b * b))), 1, 0.01) << "c = " << c;
    } else {
      EXPECT_NEAR(e.pressure / (2 * k * std::log(b / a)), 1, 0.01);
    }
  }
  EXPECT_GT(between, 3);
}

// M/M_y at curvature `bend` times that of first yield; the bar is one element long and as many wide.
double bending_moment(int rows, double bend) {
  const double height = 0.1, length = height / rows;
  Body body(structured_body(SweepKind::extrude, 1, rows, {0, length},
                            [&](int c, int r) {
                              return Vec2{c * length, (0.5 - double(r) / rows) * height};
                            }),
            {kSteel}, {});
  make_plastic(body, {perfectly_plastic(kSteel, kYield), {}});
  const double curvature = bend * 2 * kYield / (kYoung * height);
  Relaxation path(
      body,
      [&](int, int station, Vec3 x) {
        return NodeMotion{{{0, 1, 0}, {0, 0, 1}}, station == 0 ? Vec3{} : Vec3{-curvature * length * x.z, 0, 0}};
      },
      breathing_damping(height));
  path.run(1, 4000, 2000);
  const double moment = path.sum([](int, int station, Vec3 x, Vec3 f) { return station == 1 ? -f.x * x.z : 0; });
  return moment / (kYield * length * height * height / 6);
}

TEST_F(PlasticStructures, BeamInBendingWithEightRowsHoldsHillsMomentWithinOnePercent) {
  for (double bend : {0.5, 2.0, 4.0}) {
    const double truth = bend < 1 ? bend : 1.5 - 0.5 / (bend * bend);
    EXPECT_NEAR(bending_moment(8, bend) / truth, 1, bend < 1 ? 1e-4 : 0.01) << bend;
  }
}

TEST_F(PlasticStructures, OneRowHoldsTheMomentOfItsTwoRowsOfPointsAndIsNotStiffBeyondThem) {
  // fully plastic: points at +- h/(2 sqrt 3) with weights of half the height, M/M_y = sqrt 3; elastic hourglass forces
  // would grow with the curvature for ever
  EXPECT_NEAR(bending_moment(1, 4), std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(bending_moment(1, 8), std::sqrt(3.0), 1e-3);
}

TEST_F(PlasticStructures, RoundBarInTorsionHoldsTheClosedFormsTorqueWithinOnePercent) {
  const int rows = 8;
  const double w = 0.02, radius = 0.1, hole = 0.001, length = radius / rows;
  const double shear = kYield / std::sqrt(3.0), first = shear / (kSteel.mu * radius);  // angle per length
  for (double twist : {0.5, 2.0, 4.0}) {
    Body body(structured_body(SweepKind::revolve, 1, rows, {-w, w},
                              [&](int c, int r) {
                                return Vec2{c * length, -hole - (radius - hole) * r / rows};
                              }),
              {kSteel}, {});
    make_plastic(body, {perfectly_plastic(kSteel, kYield), {}});
    const auto around = [](Vec3 x) {
      const double r = std::hypot(x.x, x.z);
      return Vec3{-x.z / r, 0, x.x / r};
    };
    Relaxation path(
        body,
        [&](int, int, Vec3 x) {
          return NodeMotion{{}, twist * first * x.y * std::hypot(x.x, x.z) * around(x)};
        },
        0);
    path.run(1, 200, 20);
    const double torque = path.sum(
        [&](int node, int, Vec3 x, Vec3 f) { return node % 2 == 1 ? dot(f, around(x)) * std::hypot(x.x, x.z) : 0; });
    const double at_yield = 2 * w * shear * std::pow(radius, 3) / 4;
    const double truth = twist < 1 ? twist : 4.0 / 3 * (1 - 0.25 / std::pow(twist, 3));
    EXPECT_NEAR(torque / at_yield / truth, 1, twist < 1 ? 1e-3 : 0.01) << twist;
  }
}

}  // namespace
}  // namespace railstrata
