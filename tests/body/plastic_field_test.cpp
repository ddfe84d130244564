// What has become of elements that yield, as pictures and sums have it.
#include "body/plastic_field.hpp"

#include <gtest/gtest.h>

#include "core/rotation.hpp"
#include "tests/body/plastic_state.hpp"
#include "tests/body/relaxation.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

// A bar of 1 x 1 x 2 m is pulled to five times its strain of first yield; linear kinematic hardening C:
//   eps_p = (E eps - Y)/(E + C),  alpha_11 = (2/3) C eps_p,  stored V C eps_p^2/2, heat V Y eps_p
TEST(PlasticField, APulledBarHasTheBackstressAndTheEnergiesOfLinearKinematicHardening) {
  constexpr double kYield = 5e6, kHardening = 20e9, kStrain = 5 * kYield / kYoung;
  Body body(structured_body(SweepKind::extrude, 1, 1, {0, 1, 2},
                            [](int c, int r) {
                              return Vec2{static_cast<double>(c), -static_cast<double>(r)};
                            }),
            {kSteel}, {});
  YieldingMaterial material{perfectly_plastic(kSteel, kYield), {}};
  material.law.modulus[0] = kHardening;
  make_plastic(body, material);
  Relaxation path(
      body,
      [](int, int station, Vec3 x) {
        const std::vector<Vec3> across{{0, 1, 0}, {0, 0, 1}}, all{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        return station == 1 ? NodeMotion{all, {}} : NodeMotion{across, {kStrain * x.x, 0, 0}};
      },
      0.7 * std::sqrt(kYoung / 7800) / 2);
  path.run(1, 16000, 2000);
  const PlasticHistory& history = path.state().history;
  const double plastic = (kYoung * kStrain - kYield) / (kYoung + kHardening);
  for (int station : {0, 1}) {
    const ElementPlasticity at = element_plasticity(body, 0, history, 0, 0, station);
    EXPECT_NEAR(at.strain.xx / plastic, 1, 1e-3);
    EXPECT_NEAR(at.strain.yy / plastic, -0.5, 1e-3);
    EXPECT_NEAR(at.accumulated / plastic, 1, 1e-3);
    EXPECT_NEAR(at.backstress.xx / (kHardening * plastic), 2.0 / 3, 1e-3);
    EXPECT_NEAR(at.backstress.zz / (kHardening * plastic), -1.0 / 3, 1e-3);
  }
  const double volume = 2, stored = backstress_energy(body, history);
  EXPECT_NEAR(stored / (0.5 * volume * kHardening * plastic * plastic), 1, 2e-3);
  EXPECT_NEAR((plastic_work(body, history) - stored) / (volume * kYield * plastic), 1, 2e-3);
  EXPECT_NEAR(plastic_peak(body, history).accumulated / plastic, 1, 1e-3);
}

/// A piece of a ring around 0.42 rad that has yielded somehow.
struct YieldedRing {
  YieldedRing()
      : body(structured_body(SweepKind::revolve, 2, 2, {0.40, 0.42, 0.44},
                             [](int c, int r) {
                               return Vec2{0.01 * c, -1 - 0.01 * r};
                             }),
             {kSteel}, {}) {
    make_plastic(body, {perfectly_plastic(kSteel, 5e6), {}});
    history = initial_history(body);
    advance_plastic_elements(body, scattered_field(body, 1e-5), 0, history);
  }
  Body body;
  PlasticHistory history;
};

TEST(PlasticField, AnElementThatItsWheelHasTurnedToTheBottomHasTheTensorsOfItsOwnFrame) {
  const YieldedRing ring;
  for (int station : {0, 1}) {
    const double angle = 0.41 + 0.02 * station;
    const auto own = plastic_state(ring.body, ring.history, 0, 1, station);
    ASSERT_TRUE(own && own->accumulated > 0);
    const ElementPlasticity there = element_plasticity(ring.body, angle, ring.history, 0, 1, station);
    const double tensor[] = {there.strain.xx, there.strain.yy, there.strain.zz,
                             there.strain.xy, there.strain.yz, there.strain.xz};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(tensor[i], own->mean[i], 1e-12) << i;
    EXPECT_DOUBLE_EQ(there.accumulated, own->accumulated);
    // elsewhere: turned with the body, invariants stay
    const ElementPlasticity here = element_plasticity(ring.body, 0, ring.history, 0, 1, station);
    const Rotation<double> turn = rotation_by(-angle);
    const Vec3 normal{turn.c, 0, -turn.s};  // the element's first axis
    const Sym3& e = here.strain;
    EXPECT_NEAR(e.xx * normal.x * normal.x + 2 * e.xz * normal.x * normal.z + e.zz * normal.z * normal.z, own->mean[0],
                1e-12);
    EXPECT_NEAR(e.xx + e.yy + e.zz, 0, 1e-12);
  }
}

TEST(PlasticField, ThePeakIsTheElementWithTheLargestPoint) {
  const YieldedRing ring;
  const PlasticPeak peak = plastic_peak(ring.body, ring.history);
  double most = 0;
  for (int quad = 0; quad < 4; ++quad)
    for (int station : {0, 1}) most = std::max(most, plastic_state(ring.body, ring.history, 0, quad, station)->most);
  EXPECT_EQ(peak.accumulated, most);
  EXPECT_EQ(plastic_state(ring.body, ring.history, peak.block, peak.quad, peak.station)->most, most);
}

}  // namespace
}  // namespace railstrata
