// A wheel rolls over a rail whose layers begin and end, and over stretches of other materials.
#include <gtest/gtest.h>

#include <cstring>

#include "model/stretches.hpp"
#include "small_rolling.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

CaseSpec short_way(double way) {
  CaseSpec spec = small_case();
  spec.run.window = 0;
  spec.run.positions = {way};
  return spec;
}

CaseSpec layered(std::optional<double> from, std::optional<double> to, BodyId on = BodyId::rail) {
  CaseSpec spec = short_way(3e-3);
  spec.layers.emplace_back();
  LayerSpec& layer = spec.layers.back();
  layer.on = on;
  layer.thickness = 4e-3;
  layer.width = 0.04;
  layer.material.young = 420e9;
  layer.from = from;
  layer.to = to;
  return spec;
}

RunResult roll(const CaseSpec& spec) { return run_rolling(small_system(spec), {}); }

void expect_same_samples(const RunResult& a, const RunResult& b) {
  ASSERT_EQ(a.positions.size(), b.positions.size());
  const RollingSample &x = a.positions[0].samples.at(0), &y = b.positions[0].samples.at(0);
  EXPECT_EQ(x.forces.z, y.forces.z);
  ASSERT_EQ(x.rail.stress.size(), y.rail.stress.size());
  EXPECT_EQ(std::memcmp(x.rail.stress.data(), y.rail.stress.data(), x.rail.stress.size() * sizeof(Sym3)), 0);
  EXPECT_EQ(std::memcmp(x.wheel.stress.data(), y.wheel.stress.data(), x.wheel.stress.size() * sizeof(Sym3)), 0);
}

TEST(SlowLayerEnds, BeyondTheModelTheyAreTheEndlessLayerToTheLastBit) {
  for (const BodyId on : kBodies) {
    const RunResult endless = roll(layered({}, {}, on)), far = roll(layered(-5, 5, on));
    expect_same_samples(endless, far);
    EXPECT_TRUE(
        (on == BodyId::rail ? far.positions[0].samples[0].rail : far.positions[0].samples[0].wheel).element.empty());
  }
}

TEST(LayerEnds, AStretchThatChangesNothingKeepsTheBits) {
  CaseSpec spec = layered({}, {});
  const RunResult without = roll(spec);
  spec.stretches.push_back({BodyId::rail, {{0.0, 1, 1}, {0.02, 1, 1}}, {}});
  expect_same_samples(without, roll(spec));
}

TEST(LayerEnds, AStretchOfTwiceTheModulusIsTheLayerThatHasIt) {
  CaseSpec layer = layered({}, {}), stretched = layer;
  for (CaseSpec* spec : {&layer, &stretched}) spec->layers[0].width = 0.06;
  stretched.layers[0].material.young = 210e9;
  stretched.stretches.push_back({BodyId::rail, {{-1.0, 2, 1}, {1.0, 2, 1}}, 4e-3});
  const RunResult a = roll(layer), b = roll(stretched);
  const std::vector<Sym3>&of_layer = a.positions[0].samples[0].rail.stress,
        &of_stretch = b.positions[0].samples[0].rail.stress;
  ASSERT_EQ(of_layer.size(), of_stretch.size());
  for (std::size_t i = 0; i < of_layer.size(); ++i) ASSERT_NEAR(of_layer[i].zz, of_stretch[i].zz, 1.0) << i << ", Pa";
}

TEST(LayerEnds, SamplesKnowTheMaterialsOfTheirStations) {
  const double end = 0.002;
  const RollingSystem system = small_system(layered({}, end));
  const RunResult run = run_rolling(system, {});
  const RollingSample& sample = run.positions[0].samples[0];
  const SweptBody& rail = system.model.rail;
  const Block& cap = rail.blocks[static_cast<std::size_t>(rail.contact.block)];
  const int middle = rail.contact.columns / 2, lowest = (rail.contact.rows - 1) * rail.contact.columns + middle;
  bool before = false, behind = false;
  ASSERT_EQ(sample.rail.element.size(), static_cast<std::size_t>(sample.rail.stations));
  for (int k = 0; k < sample.rail.stations; ++k) {
    const bool on_layer = sample.position + 0.5 * (sample.rail.along[k] + sample.rail.along[k + 1]) < end;
    (on_layer ? before : behind) = true;
    const int element = sample.rail.element[static_cast<std::size_t>(k)];
    EXPECT_EQ(rail.layer_of(cap.material(middle, element)), on_layer ? 1 : 0) << k;
    EXPECT_EQ(rail.layer_of(cap.material(lowest, element)), 0) << k;
  }
  EXPECT_TRUE(before && behind);
  EXPECT_GT(run.history.back().way.patches, 0) << "the history has the patch on its way";
}

TEST(LayerEnds, ATaperIsAStairOfTheLayersRows) {
  CaseSpec spec = layered(-0.03, 0.03);
  spec.layers[0].elements = 4;
  spec.layers[0].taper_length = 0.016;
  spec.mesh.element_size = 4e-3;
  const Model model = build_model(spec, {});
  const Block& cap = model.rail.blocks[static_cast<std::size_t>(model.rail.contact.block)];
  const int columns = model.rail.contact.columns;
  const auto rows_at = [&](double x) {
    int rows = 0;
    for (int e = 0; e < cap.stations.elements(); ++e)
      if (cap.stations.at[e] < x && x < cap.stations.at[e + 1])
        for (int r = 0; r < model.rail.contact.rows; ++r)
          rows += model.rail.layer_of(cap.material(r * columns + columns / 2, e)) == 1;
    return rows;
  };
  EXPECT_EQ(rows_at(0), 4);
  EXPECT_EQ(rows_at(0.0311), 0);
  int before = 4;
  for (double x = 0.001; x < 0.031; x += 0.002) {
    EXPECT_LE(rows_at(x), before) << x;
    EXPECT_GE(rows_at(x), before - 1) << x;
    before = rows_at(x);
  }
  EXPECT_EQ(rows_at(0.03 - 0.008 - 1e-4), 2) << "half the thickness in the middle of the taper";
}

TEST(LayerEnds, WhereALayerIsNotTheNextOneReachesUp) {
  CaseSpec spec = layered({}, 0.01);
  LayerSpec lower = spec.layers[0];
  lower.name = "lower";
  lower.to.reset();
  spec.layers.push_back(lower);
  EXPECT_EQ(layer_tops(spec.layers), (std::vector<double>{0, 4e-3}));
  const std::vector<LayerSpec> here = layers_at(spec.layers, 0.02);
  ASSERT_EQ(here.size(), 1u);
  EXPECT_EQ(here[0].name, "lower");
  EXPECT_NEAR(here[0].thickness, 8e-3, 1e-12);
  EXPECT_EQ(layers_at(spec.layers, 0).size(), 2u);
}

// The mixed packs of a body that yields: with a factor of 1 + 1e-12 every element has a material of its own.
TEST(SlowLayerEnds, ElementsOfManyMaterialsYieldAsThoseOfOne) {
  CaseSpec spec = short_way(8e-3);
  spec.run.plasticity = true;
  spec.rail_material.strength.yield_strength = 300e6;
  spec.rail_material.strength.kinematic_hardening = {{20e9, 100}};
  const RunResult one = roll(spec);
  const double almost = 1 + 1e-9;
  spec.stretches.push_back({BodyId::rail, {{-0.05, 1, 1}, {0.1, almost, almost}}, {}});
  const RunResult many = roll(spec);
  EXPECT_GT(one.plastic.accumulated, 1e-4);
  EXPECT_NEAR(many.plastic.accumulated, one.plastic.accumulated, 1e-5 * one.plastic.accumulated);
  EXPECT_NEAR(many.remains.work, one.remains.work, 1e-6 * one.remains.work);
  EXPECT_NEAR(many.closure, one.closure, 1e-6);
}

TEST(SlowLayerEnds, ASofterStretchYieldsMore) {
  CaseSpec spec = short_way(12e-3);
  spec.run.plasticity = true;
  spec.rail_material.strength.yield_strength = 400e6;
  const RunResult whole = roll(spec);
  spec.stretches.push_back({BodyId::rail, {{0.002, 1, 0.7}, {0.03, 1, 0.7}}, {}});
  const RunResult soft = roll(spec);
  spec.stretches.clear();
  spec.rail_material.strength.yield_strength = 280e6;
  const RunResult all_soft = roll(spec);
  EXPECT_GT(soft.plastic.accumulated, 1.2 * whole.plastic.accumulated);
  EXPECT_LT(soft.remains.work, all_soft.remains.work);
  EXPECT_LT(soft.closure, 1.2 * all_soft.closure) << all_soft.closure;
}

}  // namespace
}  // namespace railstrata
