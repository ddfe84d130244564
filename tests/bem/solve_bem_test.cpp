#include "bem/solve_bem.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bem/creep_curve.hpp"
#include "core/faults.hpp"

namespace railstrata {
namespace {

CaseSpec paper_base() {
  CaseSpec spec;
  spec.geometry.lateral_shift = 1.5e-3;
  return spec;
}

// Half-space solution of the exact profiles (project notes): 1074 MPa; slip area about 0.23–0.26 of the patch;
// creepage 1.3–1.6e-3.
TEST(SolveBem, PaperBaseCase) {
  const CaseSpec spec = paper_base();
  const BemResult r = solve_bem(spec, place(spec, {}));
  EXPECT_NEAR(r.patch.largest_pressure / 1074e6, 1, 0.007);
  EXPECT_NEAR(r.force.x / (-0.2 * spec.vehicle.load()), 1, 1e-5);
  EXPECT_NEAR(-r.force.z / spec.vehicle.load(), 1, 1e-5);
  EXPECT_GT(r.patch.slip_area / r.patch.area, 0.20);
  EXPECT_LT(r.patch.slip_area / r.patch.area, 0.30);
  EXPECT_LT(r.rigid_slip.x, -1.2e-3);
  EXPECT_GT(r.rigid_slip.x, -1.7e-3);
  double sum = 0;
  for (std::size_t k = 0; k < r.field.p.size(); ++k) sum += r.field.p[k] * r.field.area[k];
  EXPECT_NEAR(sum, r.force.normal, 1e-6 * sum);
}

// Towards the flange the contact plane stands steep and lateral friction carries part of the weight: the normal force
// gives way until both together bear it.
TEST(SolveBem, NormalAndLateralForceTogetherBearTheWeightAtSteepContactAngles) {
  BemOptions options;
  options.cell = 0.5e-3;
  for (double shift : {7.5e-3, 9.5e-3, 10e-3}) {
    CaseSpec spec;
    spec.geometry.lateral_shift = shift;
    spec.drive.friction_coefficient = 0.3;
    spec.drive.traction_coefficient = 0.05;
    const Placement placement = place(spec, {});
    const BemResult r = solve_bem(spec, placement, options);
    EXPECT_GT(r.contact.angle, 0.1);
    const double weight = spec.vehicle.load(), c = std::cos(r.contact.angle), s = std::sin(r.contact.angle);
    EXPECT_NEAR((r.force.normal * c - r.force.tangential * s) / weight, 1, 1e-5) << shift;
    EXPECT_NEAR(-r.force.z / weight, 1, 1e-5) << shift;
    EXPECT_NEAR(r.force.x, -0.05 * weight, 1e-5 * 0.3 * r.force.normal) << shift;
    double sum = 0;
    for (double p : r.field.p) sum += p * r.grid.cell_area();
    EXPECT_NEAR(sum / r.force.normal, 1, 1e-6) << shift;
  }
}

// Friction that carries most of the weight: the first secant would take the normal force below zero.
TEST(SolveBem, FrictionThatCarriesMostOfTheWeightLeavesAPositiveNormalForce) {
  BemOptions options;
  options.cell = 0.5e-3;
  double before = 200e3;
  for (double friction : {0.5, 0.65, 1.0}) {
    CaseSpec spec;
    spec.geometry.lateral_shift = 10e-3;
    spec.drive.friction_coefficient = friction;
    spec.drive.traction_coefficient = 0;
    const BemResult r = solve_bem(spec, place(spec, {}), options);
    EXPECT_NEAR(-r.force.z / spec.vehicle.load(), 1, 1e-5) << friction;
    EXPECT_LT(r.force.normal, before);
    EXPECT_GT(r.force.normal, 0);
    before = r.force.normal;
  }
}

// S1002 on UIC60 in the middle of the track: the surfaces' angle turns from 0.3 to 4.6 degrees over the patch, 1.4 at
// the rigid contact point. CONTACT with the slip of the actual surfaces (its conformal mode, commit d431cdb, cells of
// 0.25 mm, the profiles' files of the Manchester benchmark, F_x = 0): 2484 N of lateral friction along the curved patch
// (TILDE_FS; BAR_FS, 2405 N, has a share of the pressure). These profiles are the drawn ones, not the files' points.
TEST(SolveBem, SpinWithTheSurfacesOwnAnglesHasContactsLateralFriction) {
  CaseSpec spec;
  spec.geometry.wheel_profile = "S1002";
  spec.geometry.rail_profile = "UIC60";
  spec.geometry.wheel_radius = 0.46;
  spec.geometry.back_to_back = 1.36;
  spec.geometry.gauge_depth = 0.014;
  for (MaterialSpec* m : {&spec.rail_material, &spec.wheel_material}) {
    m->young = 2 * 82e9 * 1.28;
    m->poisson = 0.28;
  }
  spec.vehicle.set_load(85e3);
  spec.drive.traction_coefficient = 0;
  spec.drive.friction_coefficient = 0.3;
  const auto lateral_friction = [&](SpinAngle angle) {
    spec.bem.spin_angle = angle;
    return std::abs(solve_bem(spec, place(spec, {})).force.tangential);
  };
  EXPECT_NEAR(lateral_friction(SpinAngle::local) / 2484, 1, 0.015);
  EXPECT_LT(lateral_friction(SpinAngle::patch) / 2484, 0.975) << "one spin for the patch, of its plane";
}

TEST(SolveBem, StiffLayerRaisesThePeakPressureAndSoftLayerLowersIt) {
  CaseSpec spec = paper_base();
  const double bare = solve_bem(spec, place(spec, {})).patch.largest_pressure;
  spec.layers.push_back({});
  spec.layers[0].material.young = 4 * 210e9;
  const double stiff = solve_bem(spec, place(spec, {})).patch.largest_pressure;
  spec.layers[0].material.young = 0.25 * 210e9;
  const double soft = solve_bem(spec, place(spec, {})).patch.largest_pressure;
  EXPECT_GT(stiff, 1.05 * bare);
  EXPECT_LT(soft, 0.95 * bare);
  spec.layers[0].material.young = 210e9;
  EXPECT_NEAR(solve_bem(spec, place(spec, {})).patch.largest_pressure / bare, 1, 1e-9)
      << "a layer of the rail's own steel changes nothing";
}

LayerSpec layer_on(BodyId body, double thickness, double young) {
  LayerSpec layer;
  layer.on = body;
  layer.thickness = thickness;
  layer.material.young = young;
  return layer;
}

TEST(SolveBem, LayersOfEitherBodyGiveTheSamePressureWithoutFriction) {
  CaseSpec spec = paper_base();
  spec.drive.traction_coefficient = spec.drive.friction_coefficient = 0;
  BemOptions options;
  options.cell = 0.5e-3;
  spec.layers = {layer_on(BodyId::rail, 1e-3, 420e9), layer_on(BodyId::rail, 2e-3, 100e9)};
  const BemResult rail = solve_bem(spec, place(spec, {}), options);
  spec.layers = {layer_on(BodyId::wheel, 1e-3, 420e9), layer_on(BodyId::wheel, 2e-3, 100e9)};
  const BemResult wheel = solve_bem(spec, place(spec, {}), options);
  for (std::size_t k = 0; k < rail.field.p.size(); ++k)
    ASSERT_NEAR(rail.field.p[k], wheel.field.p[k], 1e-8 * rail.patch.largest_pressure);
  EXPECT_NEAR(rail_interior(rail).peaks({0.125e-3, 8e-3}).layers.at(1).von_mises.value /
                  wheel_interior(wheel).peaks({0.125e-3, 8e-3}).layers.at(1).von_mises.value,
              1, 1e-6);
  spec.layers.push_back(layer_on(BodyId::rail, 1e-3, 420e9));
  EXPECT_GT(solve_bem(spec, place(spec, {}), options).patch.largest_pressure, wheel.patch.largest_pressure);
}

TEST(SolveBem, AGradedLayerLiesBetweenItsEndsAndIsAStackOfThinLayers) {
  CaseSpec spec = paper_base();
  BemOptions options;
  options.cell = 0.5e-3;
  const auto pressure = [&](const std::vector<LayerSpec>& layers) {
    spec.layers = layers;
    return solve_bem(spec, place(spec, {}), options).patch.largest_pressure;
  };
  LayerSpec graded = layer_on(BodyId::rail, 3e-3, 420e9);
  graded.young_table = {{0, 630e9}, {3e-3, 210e9}};
  std::vector<LayerSpec> stack;
  for (const HalfSpaceLayer& cut : cut_into_layers({{0, {630e9, 0.3}}, {3e-3, {210e9, 0.3}}}, 0.01))
    stack.push_back(layer_on(BodyId::rail, cut.thickness, cut.material.young));
  const double exact = pressure(stack);
  EXPECT_GT(exact, pressure({layer_on(BodyId::rail, 3e-3, 210e9)}));
  EXPECT_LT(exact, pressure({layer_on(BodyId::rail, 3e-3, 630e9)}));
  EXPECT_NEAR(pressure({graded}) / exact, 1, 5e-5);
}

TEST(SolveBem, GrowsThePotentialContactAreaByItselfAndSaysSo) {
  CaseSpec spec;
  spec.vehicle.sprung_mass = 20000;
  BemOptions options;
  options.cell = 0.5e-3;
  const BemResult r = solve_bem(spec, place(spec, {}), options);
  ASSERT_EQ(r.notes.size(), 1u);
  EXPECT_NE(r.notes[0].find("grown"), std::string::npos);
  spec.vehicle.sprung_mass = 3e6;
  options.cell = 1e-3;
  EXPECT_THROW(solve_bem(spec, place(spec, {}), options), CaseError);
}

TEST(SolveBem, TractionAboveFrictionIsACaseError) {
  CaseSpec spec = paper_base();
  spec.drive.traction_coefficient = 0.51;
  EXPECT_THROW(solve_bem(spec, place(spec, {})), CaseError);
  spec.drive.friction_coefficient = 0;
  EXPECT_THROW(solve_bem(spec, place(spec, {})), CaseError);
  spec.drive.traction_coefficient = 0;
  EXPECT_EQ(solve_bem(spec, place(spec, {})).patch.largest_traction, 0);
}

/// The key of the case that an error is about.
template <class Work>
std::string blamed(Work&& work) {
  try {
    work();
  } catch (const CaseError& e) {
    return e.diagnostics.at(0).where;
  }
  return "nothing";
}

TEST(SolveBem, ErrorsNameTheKeyTheyAreAbout) {
  const auto of = [](auto&& change) {
    CaseSpec spec = paper_base();
    change(spec);
    BemOptions options;
    options.cell = 1e-3;
    return blamed([&] { solve_bem(spec, place(spec, {}), options); });
  };
  EXPECT_EQ(of([](CaseSpec&) {}), "nothing");
  EXPECT_EQ(of([](CaseSpec& s) { s.drive.traction_coefficient = 0.51; }), "drive.traction_coefficient");
  EXPECT_EQ(of([](CaseSpec& s) { s.drive.lateral_traction_coefficient = 0.5; }), "drive.lateral_traction_coefficient");
  EXPECT_EQ(of([](CaseSpec& s) {
              s.third_body = {
                  .thickness = 20e-6, .shear_modulus = 100e6, .yield_shear = 1e6, .hardening = 0, .residual_shear = {}};
            }),
            "third_body.yield_shear");
  EXPECT_EQ(of([](CaseSpec& s) {
              s.friction = {.law = FrictionForm::falling_rational, .kinetic_coefficient = 0.1, .half_velocity = 1e-3};
            }),
            "friction.half_velocity");
  EXPECT_EQ(of([](CaseSpec& s) {
              s.geometry.wheel_profile = "S1002";
              s.geometry.rail_profile = "UIC60";
              s.geometry.gauge_depth = 14e-3;
              s.geometry.cant = 0.05;
              s.geometry.lateral_shift = 9.65e-3;
              s.vehicle.approach = 0.1e-3;
            }),
            "vehicle.approach");
}

TEST(SolveBem, InteriorPeakOfTheBaseCaseIs062OfThePeakPressure3MillimetresDown) {
  BemOptions options;
  options.cell = 0.5e-3;
  const BemResult r = solve_bem(paper_base(), place(paper_base(), {}), options);
  const SubsurfacePeaks rail = rail_interior(r).peaks({0.125e-3, 8e-3}),
                        wheel = wheel_interior(r).peaks({0.125e-3, 8e-3});
  EXPECT_NEAR(rail.subsurface.von_mises.value / r.patch.largest_pressure, 0.62, 0.05 * 0.62);
  EXPECT_GT(rail.subsurface.von_mises.depth, 2e-3);
  EXPECT_LT(rail.subsurface.von_mises.depth, 3.5e-3);
  EXPECT_NEAR(wheel.subsurface.von_mises.value / r.patch.largest_pressure, 0.62, 0.05 * 0.62);
  // the driving wheel's trailing edge is in compression where the rail's is in tension
  EXPECT_LT(rail.surface.sigma1.x * wheel.surface.sigma1.x, 0);
}

TEST(CreepCurve, OfTheBaseCaseRisesToTheBound) {
  BemOptions options;
  options.cell = 0.5e-3;
  const auto curve = creep_curve(paper_base(), place(paper_base(), {}), VariedCreepage::longitudinal,
                                 {-2e-4, -1e-3, -3e-3, -2e-2}, options);
  for (std::size_t i = 1; i < curve.size(); ++i) {
    EXPECT_LT(curve[i].full, curve[i - 1].full);
    EXPECT_GT(curve[i].slip_fraction, curve[i - 1].slip_fraction);
  }
  EXPECT_NEAR(curve.back().full, -1, 0.01);
  for (const CreepCurvePoint& p : curve)
    for (double fast : {p.fastsim, p.polach, p.vermeulen_johnson}) {
      EXPECT_LT(fast, 0) << p.creepage;
      EXPECT_GE(fast, -1.01) << p.creepage;
    }
}

TEST(SolveBem, ConvergesForThinAndThickSoftAndStiffLayersOnEitherBody) {
  CaseSpec spec = paper_base();
  BemOptions options;
  options.cell = 1e-3;
  for (const BodyId on : kBodies)
    for (double nu : {0.3, 0.49})
      for (double ratio : {0.01, 0.1, 10.0, 100.0})
        for (double h : {50e-6, 1e-3, 10e-3}) {
          LayerSpec layer;
          layer.on = on;
          layer.thickness = h;
          layer.material = {ratio * 210e9, nu, 7800, {}};
          spec.layers = {layer};
          const BemResult r = solve_bem(spec, place(spec, {}), options);
          EXPECT_NEAR(r.force.x / (-0.2 * spec.vehicle.load()), 1, 1e-4)
              << body_word(on) << nu << ' ' << ratio << ' ' << h;
        }
}

TEST(SolveBem, CachedInfluenceGivesTheSameBits) {
  CaseSpec spec = paper_base();
  spec.layers.push_back({});
  InfluenceCache cache;
  BemOptions options;
  options.cache = &cache;
  const BemResult a = solve_bem(spec, place(spec, {}), options), b = solve_bem(spec, place(spec, {}), options),
                  c = solve_bem(spec, place(spec, {}));
  EXPECT_EQ(a.field.p, b.field.p);
  EXPECT_EQ(a.field.q_x, b.field.q_x);
  EXPECT_EQ(a.field.q_x, c.field.q_x);
}

}  // namespace
}  // namespace railstrata
