// Stress that a process has left in a layer, and what the body makes of it.
#include <gtest/gtest.h>

#include "body/stress.hpp"
#include "core/parallel.hpp"
#include "tests/body/relaxation.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

constexpr double kThickness = 1, kHeight = 4, kHalfLength = 24, kStress = 200e6;
constexpr int kRowsOfLayer = 2;

/// Half of a long block, held in its plane of symmetry x = 0 and in the width (plane strain); its bottom may slide,
/// which keeps it from bending. Its topmost rows are the layer.
class LayeredBlock {
 public:
  LayeredBlock() : body_(mesh(), {kSteel}, {}) {}
  Body& body() { return body_; }
  BodyState& relax() {
    const double wave = std::sqrt(kYoung / kSteel.density);
    path_.emplace(body_, motion, std::numbers::pi / 2 * wave / kHalfLength);
    path_->run(1, 1, 2500);
    return path_->state();
  }
  Sym3 stress(double x, int row) {
    return element_stress(body_, path_->state().u, path_->state().history, 0, row, static_cast<int>(x / cell()));
  }
  double energy() { return path_->elements().energy(path_->state().u, 0, path_->state().history).strain; }
  static InitialStress::Stress in_layer(int quad) {
    return quad < kRowsOfLayer ? InitialStress::Stress{kStress, kStress, 0, 0, 0, 0} : InitialStress::Stress{};
  }

 private:
  static double cell() { return kThickness / kRowsOfLayer; }
  static NodeMotion motion(int, int, Vec3 at) {
    NodeMotion out;
    if (at.x > 1e-9) out.free.push_back({1, 0, 0});
    if (at.z > -kHeight + 1e-9) out.free.push_back({0, 0, 1});
    return out;
  }
  static SweptBody mesh() {
    std::vector<double> stations;
    for (double x = 0; x < kHalfLength + 1e-9; x += cell()) stations.push_back(x);
    return structured_body(SweepKind::extrude, 1, static_cast<int>(kHeight / cell()), stations, [](int c, int r) {
      return Vec2{c * cell(), -r * cell()};
    });
  }
  Body body_;
  std::optional<Relaxation> path_;
};

class InitialStressOfALayer : public testing::Test {
 protected:
  InitialStressOfALayer() { set_threads(1); }  // some hundred elements
  ~InitialStressOfALayer() override { set_threads(threads_); }
  const int threads_ = max_threads();
};

// With the strain e of the whole section along x: sigma_0 h + E/(1 - nu^2) e H = 0.
TEST_F(InitialStressOfALayer, IsBalancedByTheBlockBelow) {
  LayeredBlock block;
  block.body().initial_stress =
      InitialStress(block.body().mesh, [](int, int quad) { return LayeredBlock::in_layer(quad); });
  block.relax();
  const double taken = kStress * kThickness / kHeight;
  for (int row = 0; row < static_cast<int>(2 * kHeight); ++row) {
    const Sym3 s = block.stress(0.1, row);
    const double own = row < kRowsOfLayer ? kStress : 0;
    EXPECT_NEAR(s.xx, own - taken, 2e-3 * kStress) << row;
    EXPECT_NEAR(s.yy, own - 0.3 * taken, 2e-3 * kStress) << row;
    EXPECT_NEAR(s.zz, 0, 2e-3 * kStress) << row;
  }
  EXPECT_LT(std::abs(block.stress(kHalfLength - 0.1, 0).xx), 0.25 * kStress);  // the free edge
}

TEST_F(InitialStressOfALayer, IsTheSameInElementsThatMayYield) {
  LayeredBlock cold, hot;
  for (LayeredBlock* block : {&cold, &hot})
    block->body().initial_stress =
        InitialStress(block->body().mesh, [](int, int quad) { return LayeredBlock::in_layer(quad); });
  hot.body().plastic = PlasticElements(
      hot.body(),
      [](int, int quad, int) {
        return YieldingMaterial{perfectly_plastic(kSteel, 1e30), LayeredBlock::in_layer(quad)};
      },
      [](int, int, const Tile&) { return true; });
  const Field &a = cold.relax().u, &b = hot.relax().u;
  EXPECT_GT(*std::max_element(a.begin(), a.end()), 0);
  EXPECT_TRUE(a == b);
  EXPECT_EQ(cold.stress(3, 1).xx, hot.stress(3, 1).xx);
  EXPECT_NEAR(cold.energy(), hot.energy(), 1e-12 * std::abs(cold.energy()));
}

// Half of it strains the block as the layer gives way: the energy that the relaxation has set free.
TEST_F(InitialStressOfALayer, SetsTheEnergyFreeThatTheClosedFormSays) {
  LayeredBlock block;
  block.body().initial_stress =
      InitialStress(block.body().mesh, [](int, int) { return InitialStress::Stress{kStress, 0, 0, 0, 0, 0}; });
  block.relax();  // the whole block: it relaxes without a rest
  const double volume = kHalfLength * kHeight * 0.5, plane = kYoung / (1 - 0.09);
  EXPECT_NEAR(block.energy(), -0.5 * kStress * kStress / plane * volume,
              0.01 * 0.5 * kStress * kStress / plane * volume);
  EXPECT_NEAR(block.stress(5, 7).xx, 0, 0.005 * kStress);
}

TEST_F(InitialStressOfALayer, BringsALayerToYieldByItself) {
  LayeredBlock block;
  block.body().plastic = PlasticElements(
      block.body(),
      [](int, int quad, int) {
        return YieldingMaterial{perfectly_plastic(kSteel, 0.6 * kStress), LayeredBlock::in_layer(quad)};
      },
      [](int, int, const Tile&) { return false; });
  BodyState cold(block.body());
  EXPECT_EQ(extend_plastic_elements(block.body(), cold.u, 0, cold.history), kRowsOfLayer);
  EXPECT_EQ(extend_plastic_elements(block.body(), cold.u, 0, cold.history), 0);
}

}  // namespace
}  // namespace railstrata
