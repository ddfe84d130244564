// Friction by place, direction and temperature, and films by pressure and temperature, as cases have them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bem/solve_bem.hpp"
#include "bem/transient.hpp"
#include "core/faults.hpp"
#include "damage/flash_temperature.hpp"
#include "friction/friction_conditions.hpp"
#include "reader/case_file.hpp"

namespace railstrata {
namespace {

using Overrides = std::vector<std::string>;

LoadedCase loaded(const Overrides& overrides) {
  return parse_case(
      "[geometry]\nrail_profile = \"arc:R=300 mm\"\nwheel_profile = \"flat\"\nrail_shape = \"block\"\nwheel_shape = "
      "\"disc\"\nbore_radius = \"20 mm\"\nwheel_radius = \"430 mm\"\ncant = 0.0\n[vehicle]\nwheel_load = \"80 "
      "kN\"\n[drive]\nspeed = \"20 m/s\"\ncreepage = -0.001\n",
      "a.toml", overrides);
}

BemResult solved(const Overrides& overrides, const BemOptions& options = {}) {
  const LoadedCase c = loaded(overrides);
  return solve_bem(c.spec, place(c.spec, {}), options);
}

Overrides with(Overrides a, const Overrides& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// ---- across the rail
const char* const kTable = "friction.lateral_table=[[\"-3 mm\", 0.1], [\"1 mm\", 0.4]]";

TEST(FrictionAcross, FullSlidingCarriesTheCoefficientOfEachPlace) {
  const BemResult r = solved({kTable, "drive.creepage=-0.1"});
  double expected = 0;
  for (std::size_t k = 0; k < r.field.p.size(); ++k)
    expected += r.field.area[k] * r.field.p[k] * std::clamp(0.1 + 0.3 * (r.field.y[k] + 3e-3) / 4e-3, 0.1, 0.4);
  EXPECT_NEAR(-r.force.x / expected, 1, 2e-3);  // lateral slip of the pressed, unlike heights: none; slip turns by spin
  EXPECT_NEAR(r.motion_power / r.dissipation, 1, 1e-4);
}

TEST(FrictionAcross, OneCoefficientEverywhereIsTheUniformOne) {
  const BemResult a = solved({"friction.lateral_table=[[\"-3 mm\", 0.3], [\"1 mm\", 0.3]]"}),
                  b = solved({"drive.friction_coefficient=0.3"});
  EXPECT_EQ(a.force.x, b.force.x);
  EXPECT_EQ(a.field.q_x, b.field.q_x);
}

// ---- along and across rolling
const Overrides kEllipse{"drive.friction_coefficient=0.3", "friction.lateral_coefficient=0.15"};

TEST(FrictionAlongAndAcross, FullSlidingIsOnTheEllipseWithSlipAlongItsNormal) {
  const BemResult r =
      solved(with(kEllipse, {"drive.creepage=-0.06", "drive.lateral_creepage=0.08", "drive.spin=\"0 1/m\""}));
  // q ~ (f_x² s_x, f_y² s_y) on (q_x/f_x)² + (q_y/f_y)² = p²
  const double length = std::hypot(0.3 * 0.06, 0.15 * 0.08), load = 80e3;
  EXPECT_NEAR(r.force.x, -0.09 * 0.06 / length * load, 1e-2 * load * 0.3);
  EXPECT_NEAR(r.force.y, 0.0225 * 0.08 / length * load, 1e-2 * load * 0.3);
  EXPECT_NEAR(r.motion_power / r.dissipation, 1, 1e-4);
}

TEST(FrictionAlongAndAcross, EqualCoefficientsAreCoulombs) {
  const Overrides motion{"drive.friction_coefficient=0.3", "drive.lateral_creepage=0.0015", "drive.spin=\"0.3 1/m\""};
  const BemResult a = solved(motion), b = solved(with(motion, {"friction.lateral_coefficient=0.3"}));
  EXPECT_EQ(a.force.x, b.force.x);
  EXPECT_EQ(a.force.y, b.force.y);
}

// Rolling sideways alone knows the coefficient across alone, and along alone that along.
TEST(FrictionAlongAndAcross, EachDirectionByItselfHasItsOwnCoefficient) {
  const Overrides across{"drive.creepage=0", "drive.lateral_creepage=0.001", "drive.spin=\"0 1/m\""};
  const double both = solved(with(kEllipse, across)).force.y,
               alone = solved(with(across, {"drive.friction_coefficient=0.15"})).force.y;
  EXPECT_NEAR(both / alone, 1, 2e-3);  // tractions along rolling are small and not bounded alike
  const Overrides along{"drive.creepage=-0.001", "drive.lateral_creepage=0", "drive.spin=\"0 1/m\""};
  EXPECT_NEAR(solved(with(kEllipse, along)).force.x / solved(with(along, {"drive.friction_coefficient=0.3"})).force.x,
              1, 2e-3);
}

TEST(FrictionAlongAndAcross, EnergyClosesAndForcesAreCarriedInAnyState) {
  for (const char* motion :
       {"drive.lateral_creepage=0.0008", "drive.spin=\"0.6 1/m\"", "drive.lateral_force=\"9 kN\""}) {
    const BemResult r = solved(with(kEllipse, {motion, "drive.creepage=-0.0006"}));
    EXPECT_NEAR(r.motion_power / r.dissipation, 1, 1e-3) << motion;
    for (std::size_t k = 0; k < r.field.p.size(); ++k)
      EXPECT_LE(std::hypot(r.field.q_x[k] / 0.3, r.field.q_y[k] / 0.15), r.field.p[k] * (1 + 1e-6) + 1) << motion;
  }
}

// ---- by temperature
const Overrides kFalling{"drive.friction_coefficient=0.4",
                         "friction.temperature_table=[[\"0 K\", 1], [\"500 K\", 0.4]]",
                         "friction.rail_temperature=\"20 K\"", "friction.wheel_temperature=\"60 K\""};
const Overrides kRising{"drive.friction_coefficient=0.4", "friction.temperature_table=[[\"0 K\", 1], [\"500 K\", 1.6]]",
                        "friction.rail_temperature=\"20 K\"", "friction.wheel_temperature=\"60 K\""};

/// The temperature in the middle of each cell's step, by the flash temperature of the result's own rows.
std::vector<double> temperatures(const BemResult& r, double ambient) {
  const ThermalMaterial steel{50, 7800, 460};
  std::vector<double> out(r.field.p.size());
  const ContactField& f = r.field;
  for (int c = 0; c < f.columns; ++c) {
    std::vector<double> flux;
    for (int s = f.stations - 1; s >= 0; --s) {
      const auto k = static_cast<std::size_t>(s * f.columns + c);
      flux.push_back(f.q_x[k] * f.slip_x[k] + f.q_y[k] * f.slip_y[k]);
    }
    const FlashTemperature t =
        flash_temperature({flux, r.grid.dx, 20}, {.base = steel, .layer = {}}, {.base = steel, .layer = {}});
    for (int s = 0; s < f.stations; ++s) {
      const auto at = static_cast<std::size_t>(f.stations - 1 - s);
      out[static_cast<std::size_t>(s * f.columns + c)] = ambient + 0.5 * (t.rise[at] + (at > 0 ? t.rise[at - 1] : 0));
    }
  }
  return out;
}

TEST(FrictionByTemperature, EveryCellHasTheCoefficientOfTheHeatThatItMakesItself) {
  for (const auto& [law, slope] : {std::pair(kFalling, -0.6 / 500), std::pair(kRising, 0.6 / 500)})
    for (const char* creepage : {"drive.creepage=-0.003", "drive.creepage=-0.05"}) {
      const BemResult r = solved(with(law, {creepage}));
      const LoadedCase c = loaded(law);
      ASSERT_EQ(c.spec.rail_material.strength.heat.conductivity, 50);
      ASSERT_EQ(c.spec.rail_material.strength.heat.capacity, 460);
      const std::vector<double> t = temperatures(r, 40);
      double hottest = 0;
      for (std::size_t k = 0; k < t.size(); ++k) {
        if (!(r.field.p[k] > 0) || r.field.state[k] != ContactState::slip) continue;
        const double expected = 0.4 * std::clamp(1 + slope * t[k], 0.4, 1.6) * r.field.p[k];
        EXPECT_NEAR(std::hypot(r.field.q_x[k], r.field.q_y[k]), expected, 2e-3 * expected) << creepage;
        hottest = std::max(hottest, t[k]);
      }
      EXPECT_GT(hottest, 55);
      EXPECT_NEAR(r.motion_power / r.dissipation, 1, 1e-3) << creepage;
    }
}

TEST(FrictionByTemperature, FromRestItBecomesThatOfSteadyRolling) {
  BemOptions coarse;
  coarse.cell = 1e-3;
  for (const Overrides& law : {kFalling, kRising}) {
    const Overrides motion = with(law, {"drive.creepage=-0.004", "transient.kind=rolling"});
    const double steady = solved(with(law, {"drive.creepage=-0.004"}), coarse).force.x;
    for (const auto& [start, distance] : {std::pair("rest", "36 mm"), std::pair("steady", "4 mm")}) {
      const LoadedCase c = loaded(
          with(motion, {fmt::format("transient.start={}", start), fmt::format("transient.distance=\"{}\"", distance)}));
      EXPECT_NEAR(solve_transient(c.spec, place(c.spec, {}), coarse).result.force.x / steady, 1, 2e-3) << start;
    }
  }
}

TEST(FrictionByTemperature, SettlesHoweverSteeplyItFalls) {
  const BemResult r =
      solved({"drive.creepage=-0.3", "drive.speed=\"80 m/s\"", "friction.rail_temperature=\"0 K\"",
              "friction.wheel_temperature=\"0 K\"", "friction.temperature_table=[[\"0 K\", 1], [\"100 K\", 0.01]]"});
  EXPECT_LT(-r.force.x, 0.05 * 0.5 * 80e3);
  EXPECT_GT(-r.force.x, 0.01 * 0.5 * 80e3);
}

TEST(FrictionByTemperature, OneFactorEverywhereIsAnotherCoefficient) {
  const BemResult a = solved({"drive.friction_coefficient=0.4", "friction.rail_temperature=\"20 K\"",
                              "friction.wheel_temperature=\"20 K\"",
                              "friction.temperature_table=[[\"0 K\", 0.75], [\"500 K\", 0.75]]"}),
                  b = solved({"drive.friction_coefficient=0.3"});
  EXPECT_NEAR(a.force.x / b.force.x, 1, 1e-9);
}

// ---- films
const Overrides kFilm{"third_body.thickness=\"20 um\"", "third_body.shear_modulus=\"200 MPa\""};

TEST(FilmByPressureAndTemperature, OneFactorEverywhereIsAnotherFilm) {
  const Overrides warm{"friction.rail_temperature=\"20 K\"", "friction.wheel_temperature=\"20 K\"",
                       "third_body.temperature_table=[[\"0 K\", 0.5], [\"500 K\", 0.5]]"};
  for (const Overrides& yields :
       {Overrides{}, Overrides{"third_body.yield_shear=\"200 MPa\"", "third_body.hardening=\"100 MPa/mm\""}}) {
    Overrides half = yields;
    for (std::string& key : half)
      if (key.starts_with("third_body.yield_shear")) key = "third_body.yield_shear=\"100 MPa\"";
    const BemResult a = solved(with(with(kFilm, yields), warm)),
                    b = solved(with(half, {"third_body.thickness=\"20 um\"", "third_body.shear_modulus=\"100 MPa\""}));
    EXPECT_NEAR(a.force.x / b.force.x, 1, 1e-4);
    EXPECT_NEAR(a.patch.largest_traction / b.patch.largest_traction, 1, 1e-3);
  }
}

// Rigid bodies apart from the film, no slip: q = xi s G(p)/h at the distance s from the leading edge.
TEST(FilmByPressureAndTemperature, UnderPressureItIsStiffer) {
  const Overrides soft{"third_body.thickness=\"1 mm\"",
                       "third_body.shear_modulus=\"50 MPa\"",
                       "third_body.modulus_by_pressure=0.1",
                       "drive.friction_coefficient=1",
                       "drive.spin=\"0 1/m\"",
                       "drive.lateral_creepage=0"};
  const BemResult r = solved(soft);
  // far softer than the bodies: their share is some per cent and is left in the tolerance
  double expected = 0;
  for (int j = 0; j < r.grid.ny; ++j)
    for (int i = 0; i < r.grid.nx; ++i) {
      const double p = r.field.p[r.grid.index(i, j)];
      double way = 0;
      for (int ahead = i; ahead < r.grid.nx && r.field.p[r.grid.index(ahead, j)] > 0; ++ahead) way += r.grid.dx;
      if (p > 0) expected += 0.001 * (way - 0.5 * r.grid.dx) * (50e6 + 0.1 * p) / 1e-3 * r.grid.cell_area();
    }
  EXPECT_NEAR(-r.force.x / expected, 1, 0.03);
}

TEST(FilmByPressureAndTemperature, ItsStrengthRisesWithThePressure) {
  const BemResult r = solved(with(kFilm, {"third_body.yield_shear=\"20 MPa\"", "third_body.yield_by_pressure=0.1",
                                          "drive.creepage=-0.1", "drive.friction_coefficient=0.6"}));
  int compared = 0;
  for (std::size_t k = 0; k < r.field.p.size(); ++k) {
    if (r.field.state[k] != ContactState::slip) continue;
    const double p = r.field.p[k], expected = std::min(20e6 + 0.1 * p, 0.6 * p);
    EXPECT_NEAR(std::hypot(r.field.q_x[k], r.field.q_y[k]) / expected, 1, 1e-3);
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

// ---- conditions by name
TEST(FrictionConditions, AreTheDefaultsOfTheKeysBesideThem) {
  const CaseSpec dry = loaded({"friction.condition=dry"}).spec;
  EXPECT_EQ(dry.drive.friction_coefficient, 0.55);
  EXPECT_NEAR(dry.friction.kinetic_coefficient.value(), 0.22, 1e-12);
  EXPECT_EQ(loaded({"friction.condition=dry", "drive.friction_coefficient=0.4"}).spec.drive.friction_coefficient, 0.4);
  for (const FrictionCondition& c : friction_conditions()) {
    EXPECT_NE(c.certainty, Certainty::absent) << c.name;
    EXPECT_FALSE(c.source.empty()) << c.name;
    const CaseSpec spec = loaded({fmt::format("friction.condition={}", c.name)}).spec;
    EXPECT_EQ(spec.drive.friction_coefficient, c.coefficient) << c.name;
    EXPECT_EQ(third_body(spec).yield_shear, c.film.yield_shear) << c.name;
    EXPECT_EQ(parse_case(resolved_case(spec), "b.toml", {}).spec.third_body.hardening, c.film.hardening) << c.name;
    for (const char* creepage : {"drive.creepage=-0.0008", "drive.creepage=-0.01"}) {
      const BemResult r = solved({fmt::format("friction.condition={}", c.name), creepage});
      EXPECT_NEAR(r.motion_power / r.dissipation, 1, 2e-3) << c.name << creepage;
    }
  }
  EXPECT_THROW(loaded({"friction.condition=dri"}), CaseError);
}

}  // namespace
}  // namespace railstrata
