#include "reader/case_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <utility>

#include "core/faults.hpp"
#include "options/option_table.hpp"
#include "rules/support.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

std::vector<Diagnostic> not_in_fem(const LoadedCase& loaded) { return refused_by(uses::kFiniteElements, loaded); }

/// The whole text of the error a case gives; fails the test when there is none.
std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_case(text, "a.toml", overrides);
  } catch (const CaseError& e) {
    return e.what();
  }
  ADD_FAILURE() << "accepted:\n" << text;
  return {};
}

TEST(CaseFile, AnEmptyCaseHasTheDefaultsOfCaseSpec) {
  const CaseSpec spec = parse_case("", "a.toml").spec, defaults;
  EXPECT_EQ(resolved_case(spec), resolved_case(defaults));
}

TEST(CaseFile, EveryTableIsReadInSiUnits) {
  const CaseSpec spec = parse_case(R"(
[case]
title = "all"
[geometry]
cant = "1:20"
lateral_shift = "+1.5 mm"
wheel_profile = "S1002"
[material.wheel]
young = "200 GPa"
[[layer]]
name = "clad"
thickness = "0.2 mm"
young_ratio = 2.0
[[layer]]
name = "tread"
on = "wheel"
young_ratio = 0.5
[vehicle]
suspension_damping = "12 kN·s/m"
[track]
preset = "delft"
pad_length = "180 mm"
bays = 6
[drive]
speed = "90 km/h"
traction_coefficient = "15 %"
[friction]
law = "falling_rational"
kinetic_coefficient = 0.2
half_velocity = "800 mm/s"
[mesh]
coarse_ratio = 2
element = "one_point"
[run]
positions = ["200 mm", "0.3 m"]
[output]
volume = false
)",
                                   "a.toml")
                            .spec;
  EXPECT_EQ(spec.title, "all");
  EXPECT_EQ(spec.geometry.cant, 0.05);
  EXPECT_EQ(spec.geometry.lateral_shift, 1.5e-3);
  EXPECT_EQ(spec.geometry.wheel_profile, "S1002");
  ASSERT_EQ(spec.layers.size(), 2u);
  EXPECT_EQ(spec.layers[0].thickness, 0.2e-3);
  EXPECT_EQ(spec.layers[0].material.young, 420e9);
  EXPECT_EQ(spec.layers[1].material.young, 100e9);
  EXPECT_EQ(spec.vehicle.suspension_damping, 12e3);
  EXPECT_EQ(spec.track.support.pad_stiffness, 1300e6);
  EXPECT_EQ(spec.track.support.ballast_damping, 32e3);
  EXPECT_EQ(spec.track.support.pad_length, 180e-3);
  EXPECT_EQ(spec.track.support.length(), 6 * 0.6);
  EXPECT_DOUBLE_EQ(spec.drive.speed, 25.0);
  EXPECT_EQ(spec.drive.traction_coefficient, 0.15);
  EXPECT_EQ(spec.friction.law, FrictionForm::falling_rational);
  EXPECT_EQ(spec.friction.kinetic_coefficient, 0.2);
  EXPECT_EQ(spec.friction.half_velocity, 0.8);
  EXPECT_EQ(spec.mesh.coarse_ratio, 2);
  EXPECT_EQ(spec.mesh.element, ElementFormulation::one_point);
  EXPECT_EQ(spec.run.positions, (std::vector<double>{0.2, 0.3}));
  EXPECT_FALSE(spec.run.output.volume);
}

TEST(CaseFile, AThirdBodyIsReadInSiUnits) {
  const LoadedCase loaded = parse_case(
      "[third_body]\nthickness = \"20 µm\"\nshear_modulus = \"106.3 MPa\"\nyield_shear = \"200 MPa\"\n"
      "hardening = \"400 N/mm^3\"\n",
      "a.toml");
  const ThirdBodySpec& t = loaded.spec.third_body;
  EXPECT_EQ(t.thickness, 20e-6);
  EXPECT_EQ(t.shear_modulus, 106.3e6);
  EXPECT_EQ(t.yield_shear, 200e6);
  EXPECT_EQ(t.hardening, 400e9);
  EXPECT_NE(loaded.resolved_toml.find("hardening = \"400 MPa/mm\""), std::string::npos) << loaded.resolved_toml;
}

TEST(CaseFile, TheRatioOfALayerUsesAModulusWrittenFurtherDown) {
  const CaseSpec spec = parse_case("[[layer]]\nyoung_ratio = 4\n[material.rail]\nyoung = \"200 GPa\"\n", "a.toml").spec;
  EXPECT_EQ(spec.layers[0].material.young, 800e9);
}

TEST(CaseFile, AGradedLayerHasAModulusByDepthAndItsTablesThicknessAndMean) {
  const std::string text =
      "[[layer]]\nyoung_table = [[\"0 mm\", \"400 GPa\"], [\"1 mm\", \"200 GPa\"],\n  [\"4 mm\", \"200000 "
      "MPa\"]]\n";
  const LoadedCase loaded = parse_case(text, "a.toml");
  const LayerSpec& layer = loaded.spec.layers.at(0);
  EXPECT_EQ(layer.young_table, (std::vector<ModulusPoint>{{0, 400e9}, {1e-3, 200e9}, {4e-3, 200e9}}));
  EXPECT_EQ(layer.thickness, 4e-3);
  EXPECT_DOUBLE_EQ(layer.material.young, (300e9 + 3 * 200e9) / 4);
  EXPECT_NE(loaded.resolved_toml.find(
                "young_table = [[\"0 mm\", \"400 GPa\"], [\"1 mm\", \"200 GPa\"], [\"4 mm\", \"200 GPa\"]]\n"),
            std::string::npos)
      << loaded.resolved_toml;
  const LoadedCase back = parse_case(loaded.resolved_toml, "a.toml");
  EXPECT_EQ(back.resolved_toml, loaded.resolved_toml);
  EXPECT_EQ(back.spec.layers.at(0).young_table, layer.young_table);
  EXPECT_EQ(back.spec.layers.at(0).thickness, layer.thickness);
  EXPECT_EQ(parse_case(text, "a.toml", {"layer.0.young_table=[[\"0 mm\", \"300 GPa\"], [\"2 mm\", \"100 GPa\"]]"})
                .spec.layers.at(0)
                .thickness,
            2e-3);
}

TEST(CaseFile, ALayerThatVariesAcrossHasItsTablesLargestThicknessAndEnds) {
  const LoadedCase loaded = parse_case(
      "[[layer]]\nyoung_ratio = 4\nthickness_table = [[\"-20 mm\", \"0 mm\"], [\"-10 mm\", \"3 mm\"], [\"35 mm\", \"2 "
      "mm\"]]\n",
      "a.toml");
  const LayerSpec& layer = loaded.spec.layers.at(0);
  EXPECT_EQ(layer.thickness, 3e-3);
  EXPECT_EQ(layer.low(), -20e-3);
  EXPECT_EQ(layer.high(), 35e-3);
  EXPECT_DOUBLE_EQ(layer.thickness_at(-15e-3), 1.5e-3);
  EXPECT_EQ(layer.thickness_at(-21e-3), 0);
  EXPECT_EQ(layer.thickness_at(35e-3), 2e-3);
  EXPECT_EQ(parse_case(loaded.resolved_toml, "a.toml").resolved_toml, loaded.resolved_toml);
  EXPECT_EQ(layers_across(loaded.spec.layers, -15e-3, 0)[0].thickness, layer.thickness_at(-15e-3));
  EXPECT_THROW(
      parse_case("[[layer]]\nyoung_ratio = 4\nthickness_table = [[\"0 mm\", \"0 mm\"], [\"9 mm\", \"0 mm\"]]\n",
                 "a.toml"),
      CaseError)
      << "a layer that is nowhere";
  EXPECT_THROW(parse_case("[[layer]]\nyoung_ratio = 4\nthickness_table = [[\"0 mm\", \"1 mm\"], [\"9 mm\", \"1 mm\"]]\n"
                          "[[layer]]\nyoung_ratio = 2\nfrom = \"100 mm\"\n",
                          "a.toml"),
               CaseError)
      << "beside a layer that begins along the rail";
}

/// A value of every option that differs from its default and is allowed.
void disturb(const Option& option, CaseSpec& spec, std::size_t index) {
  struct Change {
    const Option& o;
    double inside(double v) const {
      const double other = v * 1.0123456789 + (v == 0 ? 1e-3 : 0.0);
      return o.range.holds(other) ? other : v * 0.9876543211;
    }
    void operator()(double* v) const { *v = inside(*v); }
    void operator()(std::optional<double>*) const {}  // has no value to disturb
    void operator()(int* v) const { *v += 1; }
    void operator()(bool* v) const { *v = !*v; }
    void operator()(std::string* v) const { *v += " \"2\"\n"; }
    void operator()(const ChoiceSlot& v) const { v.set(o.choices.back().value); }
    // strengths and initial stresses exclude other keys: strength_case_test.cpp
    void operator()(std::vector<double>* v) const {
      if (o.key != "initial_stress") *v = {0.2, 1.0 / 3};
    }
    void operator()(const RowsSlot& v) const {
      if (o.key == "young_table") v.set({{0, 1e11 / 3}, {0.7e-3, 3e11}, {1e-3, 1.1e11}});
    }
  };
  std::visit(Change{option}, option.slot(spec, index));
}

TEST(CaseFile, TheResolvedCaseReadsBackToTheSameBits) {
  CaseSpec spec = one_of_each();
  spec.collective.curve.bogies.clear();  // not beside loads
  spec.layers.resize(2);
  spec.layers[1].on = BodyId::wheel;
  spec.irregularities[0].at = 1e-3;
  Indentation hollow;
  hollow.length = 20e-3;
  hollow.depth = 1e-3;
  spec.irregularities[0].shape = hollow;
  spec.stretches[0].along = {{0.1, 1, 1}, {0.2, 1.5, 0.5}};
  spec.friction = {.law = FrictionForm::coulomb,
                   .kinetic_coefficient = 0.1,
                   .half_velocity = 0.7};  // for the law that `disturb` gives
  for (const OptionTable& table : case_tables())
    for (const Option& option : table.options)
      if (table.name != "bogie" && !option.derivation && !option.key.ends_with("_profile") &&
          (!option.applies || option.applies(spec, 0)) &&
          option.key != "plasticity" &&    // not with all that `disturb` gives: plasticity_case_test.cpp
          option.key != "device" &&        // likewise: device_case_test.cpp
          option.key != "grade" &&         // one of a few names: strength_case_test.cpp
          table.name != "irregularity" &&  // likewise: irregularity_case_file_test.cpp
          table.name != "crack" &&         // likewise: crack_case_file_test.cpp
          table.name != "curve" &&         // likewise: curve_case_file_test.cpp
          table.name != "transient" &&     // its keys exclude each other: transient_case_file_test.cpp
          option.key != "contact" && option.key != "line_length")  // and these others: line_case_file_test.cpp
        disturb(option, spec, 0);
  const std::string text = resolved_case(spec);
  const LoadedCase back = parse_case(text, "a.toml");
  EXPECT_EQ(back.resolved_toml, text);
  for (const OptionTable& table : case_tables())
    for (const Option& option : table.options) {
      if (table.name == "bogie") continue;
      CaseSpec copy = back.spec;
      const Slot a = option.slot(spec, 0), b = option.slot(copy, 0);
      std::visit([&](auto x) { EXPECT_EQ(*x, *std::get<decltype(x)>(b)) << table.name << "." << option.key; }, a);
    }
}

TEST(CaseFile, EveryDefaultLiesInItsRange) {
  CaseSpec spec = one_of_each();
  for (const OptionTable& table : case_tables())
    for (const Option& option : table.options) {
      const Slot slot = option.slot(spec, 0);
      double value = option.range.max;
      if (const auto* real = std::get_if<double*>(&slot)) value = option.derivation ? 1.0 : **real;
      if (const auto* whole = std::get_if<int*>(&slot)) value = **whole;
      EXPECT_TRUE(option.range.holds(value)) << table.name << "." << option.key;
    }
}

struct Bad {
  const char *text, *message;  ///< any text for "…"
};

bool fits(const std::string& text, std::string_view message) {
  constexpr std::string_view kAny = "…";
  std::size_t at = 0;
  for (bool begins = true;; begins = false) {
    const std::size_t end = message.find(kAny);
    const std::string_view part = message.substr(0, end);
    const std::size_t found = end == std::string_view::npos && !begins && text.ends_with(part)
                                  ? text.size() - part.size()
                                  : text.find(part, at);
    if (found == std::string::npos || found < at || (begins && found != 0)) return false;
    at = found + part.size();
    if (end == std::string_view::npos) return at == text.size();
    message.remove_prefix(end + kAny.size());
  }
}

TEST(CaseFile, EveryFaultIsToldWithItsPlaceRuleRemedyAndCaret) {
  const Bad all[] = {
      {"[geometry]\nguage = \"1.435 m\"\n",
       "a.toml:2:1: unknown key geometry.guage\n    2 | guage = \"1.435 m\"\n      | ^\n    remedy: did you mean "
       "gauge? keys of [geometry]: …, gauge, …"},
      {"[meshes]\n",
       "a.toml:1:2: unknown table or key meshes\n    1 | [meshes]\n      |  ^\n    remedy: did you mean mesh? tables: "
       "…, mesh, …"},
      {"[mesh]\nelement_size = \"1 MPa\"\n",
       "a.toml:2:16: mesh.element_size = \"1 MPa\": \"MPa\" is not the unit of a length\n    2 | element_size = \"1 "
       "MPa\"\n      |                ^\n    remedy: write a length, e.g. "
       "\"0.2 mm\" (units: mm, m, µm, cm)"},
      {"[mesh]\nelement_size = 0.001\n",
       "a.toml:2:16: mesh.element_size = 0.001: a bare number has no unit\n    2 | element_size = 0.001\n      |       "
       "         ^\n    remedy: write a length, e.g. \"0.2 mm\", in quotes"},
      {"[mesh]\nelement_size = \"1\"\n",
       "a.toml:2:16: mesh.element_size = \"1\": has no unit\n    2 | element_size = \"1\"\n      |                ^\n  "
       "  remedy: write a length, e.g. \"0.2 mm\""},
      {"[material.rail]\nyoung = \"210 MPa\"\n",
       "a.toml:2:9: material.rail.young = \"210 MPa\": must be between 1 GPa and 100000 GPa\n    2 | young = \"210 "
       "MPa\"\n      |         ^\n    remedy: did you mean \"210 GPa\"?"},
      {"[material.rail]\npoisson = 0.6\n",
       "a.toml:2:11: material.rail.poisson = 0.6: must be between 0 and 0.499\n    2 | poisson = 0.6\n      |          "
       " ^\n    remedy: 0.5 is incompressible: take 0.499 for it"},
      {"[mesh]\nelement = \"fill\"\n",
       "a.toml:2:11: mesh.element = \"fill\": must be one of \"full\", \"one_point\"\n    2 | element = \"fill\"\n  "
       "    |           ^\n    remedy: did you mean \"full\"?"},
      {"[mesh]\ncoarse_ratio = 2.5\n",
       "a.toml:2:16: mesh.coarse_ratio = 2.5: is a number, must be a whole number\n    2 | coarse_ratio = 2.5\n      | "
       "               ^\n    remedy: write a whole number"},
      {"[run]\nrolling = \"yes\"\n",
       "a.toml:2:11: run.rolling = \"yes\": is a text, must be true or false\n    2 | rolling = \"yes\"\n      |       "
       "    ^\n    remedy: write true or false"},
      {"[run]\npositions = \"0.3 m\"\n",
       "a.toml:2:13: run.positions = \"0.3 m\": is a text, must be a list, e.g. [\"0.1 m\", \"0.3 m\"]\n    2 | "
       "positions = \"0.3 m\"\n      |             ^\n    remedy: write a list, e.g. "
       "[\"0.1 m\", \"0.3 m\"]"},
      {"[run]\npositions = [\"0.3 m\", \"0.4 kg\"]\n",
       "a.toml:2:23: run.positions.1 = \"0.4 kg\": \"kg\" is not the unit of a length\n    2 | positions = [\"0.3 m\", "
       "\"0.4 kg\"]\n      |                       ^\n    remedy: write a "
       "length, e.g. \"0.2 mm\" (units: mm, m, µm, cm)"},
      {"[run]\npositions = [\"0.3 m\", \"0.2 m\"]\n",
       "a.toml:2:13: run.positions must increase\n    2 | positions = [\"0.3 m\", \"0.2 m\"]\n      |             ^\n  "
       "  remedy: list each wheel position once, the smallest first"},
      {"[run]\npositions = []\n",
       "a.toml:2:13: run.positions = []: needs at least one value\n    2 | positions = []\n      |             ^\n    "
       "remedy: write a list, e.g. [\"0.1 m\", \"0.3 m\"]"},
      {"[run]\nstart = \"rest\"\npositions = [\"0.05 m\"]\n",
       "a.toml:3:13: run.positions: 50 mm is not yet beyond the run-up (120 mm) and half the window (5 mm)\n    3 | "
       "positions = [\"0.05 m\"]\n      |             ^\n    remedy: start at 125 mm or "
       "later, or shorten run.run_up or run.window"},
      {"[drive]\ntraction_coefficient = 0.5\n",
       "a.toml:2:24: drive.traction_coefficient = 0.5: must be below drive.friction_coefficient = 0.5\n    2 | "
       "traction_coefficient = 0.5\n      |                        ^\n    remedy: the wheel "
       "would slide: lower the traction or raise the friction"},
      {"[drive]\ntraction_coefficient = -0.1\nfriction_coefficient = 0\n",
       "a.toml:2:24: drive.traction_coefficient = -0.1: its magnitude must be below drive.friction_coefficient = 0\n   "
       " "
       "2 | traction_coefficient = -0.1\n      |                        ^\n    remedy: the wheel would slide: lower "
       "the "
       "traction or raise the friction"},
      {"[passes]\ntraction_coefficients = [0.1, -0.6]\n",
       "a.toml:2:25: passes.traction_coefficients: -0.6 must be below drive.friction_coefficient = 0.5 in magnitude\n"
       "    2 | traction_coefficients = [0.1, -0.6]\n      |                         ^\n    remedy: the wheel would "
       "slide: lower the traction or raise the friction"},
      {"[friction]\nlaw = \"falling_exponential\"\nkinetic_coefficient = 0.6\n",
       "a.toml:2:7: friction.law needs friction.half_velocity…\n    2 | law = \"falling_exponential\"\n      |      "
       " "
       "^\n    remedy: …e.g. \"1 m/s\"\n"
       "a.toml:3:23: friction.kinetic_coefficient = 0.6: must be at most drive.friction_coefficient = 0.5…\n    3 | "
       "kinetic_coefficient = 0.6\n      |                       ^\n    remedy: …exchange the two"},
      {"[friction]\nhalf_velocity = \"1 m/s\"\n",
       "a.toml:2:17: friction.half_velocity needs …friction.law…\n    remedy: take it out…\"falling_exponential\" …"},
      {"[third_body]\nthickness = \"20 µm\"\nhardening = \"1 MPa/mm\"\n",
       "a.toml:2:13: third_body.thickness needs third_body.shear_modulus…\n    remedy: …\"100 MPa\"\n"
       "a.toml:3:13: third_body.hardening needs third_body.yield_shear\n…\n    remedy: give the stress…"},
      {"[third_body]\nthickness = \"20 µm\"\nshear_modulus = \"0.1 GPa\"\nyield_shear = \"0.2 GPa\"\nhardening = "
       "\"-1 MPa/mm\"\n",
       "a.toml:5:13: …(third_body.hardening) needs third_body.residual_shear…\n    remedy: give the strength…"},
      {"[third_body]\nthickness = \"20 µm\"\nshear_modulus = \"0.1 GPa\"\nyield_shear = \"0.2 GPa\"\nhardening = "
       "\"-6 GPa/mm\"\nresidual_shear = \"20 MPa\"\n",
       "a.toml:5:13: third_body.hardening = -6000 MPa/mm: must be above -shear_modulus / thickness = -5000 MPa/mm\n    "
       "5 | hardening = \"-6 GPa/mm\"\n      |             ^\n    remedy: a film that softens faster springs back and "
       "slips all at once: take a slower softening"},
      {"[third_body]\nthickness = \"20 µm\"\nshear_modulus = \"0.1 GPa\"\nyield_shear = \"0.2 GPa\"\nhardening = "
       "\"6 GPa/mm\"\n",
       "a.toml:5:13: third_body.hardening = 6000 MPa/mm: must be at most shear_modulus / thickness = 5000 MPa/mm\n    "
       "5 | "
       "hardening = \"6 GPa/mm\"\n      |             ^\n    remedy: a film that yields is softer than an elastic "
       "one: lower the hardening"},
      {"[[layer]]\nthickness = \"1 mm\"\n",
       "a.toml:1:1: layer.0 has no modulus\n    1 | [[layer]]\n      | ^\n    remedy: add young = \"420 GPa\", or "
       "young_ratio = 2.0 for twice the body's"},
      {"[[layer]]\nyoung = \"420 GPa\"\nyoung_ratio = 2\n",
       "a.toml:3:15: layer.0 has both young and young_ratio\n    3 | young_ratio = 2\n      |               ^\n    "
       "remedy: keep one of them"},
      {"[[layer]]\nyoung_ratio = 2\nyoung_table = [[\"0 mm\", \"420 GPa\"], [\"3 mm\", \"210 GPa\"]]\n",
       "a.toml:2:15: layer.0.young_ratio cannot be combined with layer.0.young_table…\n    remedy: keep one of them"},
      {"[[layer]]\nthickness = \"3 mm\"\nyoung_table = [[\"0 mm\", \"420 GPa\"], [\"3 mm\", \"210 GPa\"]]\n",
       "a.toml:2:13: layer.0.thickness cannot be combined with layer.0.young_table…\n    remedy: leave thickness out"},
      {"[[layer]]\nyoung_table = \"420 GPa\"\n",
       "a.toml:2:15: layer.0.young_table = \"420 GPa\": is a text, must be a table whose rows have a depth and a "
       "modulus, e.g. [[\"0 "
       "mm\", \"420 GPa\"], [\"3 mm\", \"210 GPa\"]]\n    2 | young_table = \"420 GPa\"\n      |               ^\n"
       "    remedy: write a table whose rows have a depth and a modulus, e.g. [[\"0 mm\", \"420 GPa\"], [\"3 mm\", "
       "\"210 GPa\"]]"},
      {"[[layer]]\nyoung_table = [[\"0 mm\", \"420 GPa\"], [\"3 mm\"]]\n",
       "a.toml:2:37: layer.0.young_table.1: must be a depth and a modulus\n    2 | young_table = [[\"0 mm\", \"420 "
       "GPa\"], [\"3 mm\"]]\n      |                                     ^\n    remedy: write a table whose rows have "
       "a depth and a modulus, e.g. [[\"0 mm\", \"420 GPa\"], [\"3 mm\", "
       "\"210 GPa\"]]"},
      {"[[layer]]\nyoung_table = [[\"0 mm\", 420], [\"3 mm\", \"210 mm\"]]\n",
       "a.toml:2:25: layer.0.young_table.0.1 = 420: a bare number has no unit\n    2 | young_table = [[\"0 mm\", 420], "
       "[\"3 mm\", \"210 mm\"]]\n      |                         ^\n    remedy: write a pressure or modulus, e.g. "
       "\"210 GPa\", in quotes\n"
       "a.toml:2:40: layer.0.young_table.1.1 = \"210 mm\": \"mm\" is not the unit of a pressure or modulus\n    2 | "
       "young_table = [[\"0 mm\", 420], [\"3 mm\", \"210 mm\"]]\n      |                                        ^\n    "
       "remedy: write a pressure or modulus, e.g. "
       "\"210 GPa\" (units: GPa, MPa, Pa)"},
      {"[[layer]]\nyoung_table = [[\"1 mm\", \"420 GPa\"], [\"3 mm\", \"210 GPa\"]]\n",
       "a.toml:2:16: layer.0.young_table: the first depth must be 0 mm, the layer's top\n    2 | young_table = [[\"1 "
       "mm\", \"420 GPa\"], [\"3 mm\", \"210 GPa\"]]\n      |                ^\n    remedy: begin with the modulus at "
       "the top"},
      {"[[layer]]\nyoung_table = [[\"0 mm\", \"420 GPa\"], [\"0 mm\", \"210 GPa\"]]\n",
       "a.toml:2:37: layer.0.young_table: the depth must increase from row to row, by 0.001 mm at least\n    2 | "
       "young_table = [[\"0 "
       "mm\", \"420 GPa\"], [\"0 mm\", \"210 GPa\"]]\n      |                                     ^\n    remedy: sort "
       "the rows by depth; for a jump write two layers"},
      {"[[layer]]\nyoung_table = [[\"0 mm\", \"420 GPa\"]]\n",
       "a.toml:2:15: layer.0.young_table: needs at least two rows\n    2 | young_table = [[\"0 mm\", \"420 GPa\"]]\n   "
       "   |               ^\n    remedy: write a table whose rows have a depth and a modulus, e.g. [[\"0 mm\", \"420 "
       "GPa\"], [\"3 mm\", "
       "\"210 GPa\"]]"},
      {"[[layer]]\nyoung_table = [[\"0 mm\", \"420 GPa\"], [\"5 µm\", \"210 GPa\"]]\n",
       "a.toml:2:37: layer.0.young_table: the last depth, the layer's thickness, must be between 0.01 mm and 50 mm\n   "
       " 2 | young_table = [[\"0 mm\", \"420 GPa\"], [\"5 µm\", \"210 GPa\"]]\n      |                              "
       "       ^\n    remedy: "
       "leave a thinner layer out; give a thicker one's modulus to the body that carries it"},
      {"[[layer]]\nyoung_ratio = 2\nthickness = \"80 mm\"\n",
       "a.toml:3:13: layer.0.thickness = \"80 mm\": must be between 0.01 mm and 50 mm\n    3 | thickness = \"80 mm\"\n "
       "     |             ^\n    remedy: leave a thinner layer out; give a thicker one's modulus to the body that "
       "carries "
       "it"},
      {"[[layer]]\nyoung_ratio = 2\nthickness = \"0.008 mm\"\n",
       "a.toml:3:13: layer.0.thickness = \"0.008 mm\": must be between 0.01 mm and 50 mm\n    3 | thickness = \"0.008 "
       "mm\"\n      |             ^\n    remedy: leave a thinner layer out; give a thicker one's modulus to the body "
       "that carries it"},
      {"[[layer]]\nyoung_ratio = 2\nthickness = \"2 m\"\n",
       "a.toml:3:13: layer.0.thickness = \"2 m\": must be between 0.01 mm and 50 mm\n    3 | thickness = \"2 m\"\n     "
       " "
       "|             ^\n    remedy: did you mean \"2 mm\"? If not: leave a thinner layer out; give a thicker one's "
       "modulus to the body that carries it"},
      {"[layer]\nyoung_ratio = 2\n",
       "a.toml:1:2: layer must be a list of tables\n    1 | [layer]\n      |  ^\n    remedy: write [[layer]] with two "
       "brackets"},
      {"[[layer]]\nyoung_ratio = 2\nname = \"a\"\n[[layer]]\nyoung_ratio = 2\nname = \"a\"\n",
       "a.toml:6:8: layer.1.name = \"a\": another layer of the rail has this name\n    6 | name = \"a\"\n      |       "
       " ^"
       "\n    remedy: give every layer a name of its own"},
      {"[mesh]\nfine_width = \"2 mm\"\n",
       "a.toml:2:14: mesh.fine_width = 2 mm: must be at least 4 mm (four elements)\n    2 | fine_width = \"2 mm\"\n    "
       "  |              ^\n    remedy: make it larger, or mesh.element_size smaller"},
      {"[geometry]\nhub_radius = \"0.38 m\"\n",
       "a.toml:2:14: geometry.hub_radius = 380 mm: must be below wheel_radius - rim_thickness = 370 mm\n    2 | "
       "hub_radius = \"0.38 m\"\n      |              ^\n    remedy: make the hub or the rim "
       "smaller"},
      {"[geometry]\nbore_radius = \"0.2 m\"\n",
       "a.toml:2:15: geometry.bore_radius = 200 mm: must be below hub_radius = 135 mm\n    2 | bore_radius = \"0.2 "
       "m\"\n      |               ^\n    remedy: make the bore smaller or the hub larger"},
      {"[mesh]\nelement_size = 1 mm\n", "a.toml:2:18: this is not TOML: …"},
      {"mesh = 3\n",
       "a.toml:1:8: mesh = 3: must be a table\n    1 | mesh = 3\n      |        ^\n    remedy: write [mesh] above its "
       "keys"},
      {"[material]\nyoung = \"210 GPa\"\n",
       "a.toml:2:9: unknown table or key material.young\n    2 | young = \"210 GPa\"\n      |         ^\n    remedy: "
       "tables: …, material.rail, material.wheel, …"},
  };
  for (const Bad& bad : all) EXPECT_TRUE(fits(error_of(bad.text), bad.message)) << error_of(bad.text) << bad.message;
}

TEST(CaseFile, AMissingProfileIsToldWithThePlaceLookedAtAndTheBuiltInNames) {
  const std::string message = error_of("[geometry]\nrail_profile = \"CN6\"\n");
  EXPECT_TRUE(message.starts_with(
      "a.toml:2:16: geometry.rail_profile = \"CN6\": neither a built-in profile nor a file (looked for /"))
      << message;
  EXPECT_NE(message.find("remedy: did you mean \"CN60\"? built in: CN60, UIC54, UIC60, flat, arc:R=300 mm"),
            std::string::npos)
      << message;
}

TEST(CaseFile, AllErrorsOfAFileComeAtOnceInItsOrder) {
  try {
    parse_case(
        "[run]\nrun_up = 3\n[mesh]\nelement = \"fulll\"\n[drive]\nspeed = \"3 kg\"\nfriction_coefficient = 0.1\n",
        "a.toml");
    FAIL();
  } catch (const CaseError& e) {
    ASSERT_EQ(e.diagnostics.size(), 4u) << e.what();
    EXPECT_EQ(e.diagnostics[0].where, "a.toml:2:10");
    EXPECT_EQ(e.diagnostics[1].where, "a.toml:4:11");
    EXPECT_EQ(e.diagnostics[2].where, "a.toml:5:2");  // the traction is a default: its table
    EXPECT_TRUE(e.diagnostics[2].message.starts_with("drive.traction_coefficient = 0.2: must be below"))
        << e.diagnostics[2].message;
    EXPECT_EQ(e.diagnostics[3].where, "a.toml:6:9");
  }
}

std::vector<std::string> layer_names(const std::string& text, const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> out;
  for (const LayerSpec& layer : parse_case(text, "a.toml", overrides).spec.layers) out.push_back(layer.name);
  return out;
}

TEST(CaseFile, LayersWithoutANameGetOneEach) {
  using Names = std::vector<std::string>;
  const std::string plain = "[[layer]]\nyoung_ratio = 2\n", wheel = plain + "on = \"wheel\"\n";
  EXPECT_EQ(layer_names(plain), Names{"layer"});
  EXPECT_EQ(layer_names(plain + wheel), (Names{"layer", "layer"})) << "one of each body, as always";
  EXPECT_EQ(layer_names(plain + plain), (Names{"layer 1", "layer 2"}));
  EXPECT_EQ(layer_names(plain + wheel + plain), (Names{"layer 1", "layer", "layer 2"}));
  EXPECT_EQ(layer_names(plain + plain + "name = \"layer 1\"\n" + plain), (Names{"layer 2", "layer 1", "layer 3"}));
  EXPECT_EQ(layer_names(plain + "name = \"layer\"\n" + plain), (Names{"layer", "layer 1"}));
  EXPECT_EQ(layer_names(plain + "name = \"top\"\n" + plain), (Names{"top", "layer"}));
  EXPECT_EQ(layer_names(plain, {"layer.1.young_ratio=3"}), (Names{"layer 1", "layer 2"}));
  const std::string resolved = parse_case(plain + plain, "a.toml").resolved_toml;
  EXPECT_EQ(parse_case(resolved, "b.toml").resolved_toml, resolved);
}

TEST(CaseFile, ANameThatManyLayersHaveIsToldOnce) {
  std::string text;
  for (int i = 0; i < 10; ++i) text += "[[layer]]\nyoung_ratio = 2\nname = \"a\"\nthickness = \"1 mm\"\n";
  const std::string error = error_of(text);
  EXPECT_TRUE(error.starts_with("a.toml:7:8: layer.1.name = \"a\": 9 other layers of the rail have this name\n"))
      << error;
  EXPECT_EQ(error.find("layer.2"), std::string::npos) << error;
}

TEST(Overrides, AreReadLikeTheFileAndQuotesMayBeLeftOut) {
  const std::string text = "[[layer]]\nyoung_ratio = 2\n[run]\npositions = [\"0.3 m\"]\n";
  const CaseSpec spec = parse_case(text, "a.toml",
                                   {"mesh.element_size=2 mm", "layer.0.thickness=\"0.5 mm\"",
                                    "run.positions=[\"0.2 m\"]", "geometry.cant=1:20", "mesh.coarse_ratio=4",
                                    "output.volume=false", "mesh.element=one_point", "material.rail.young=200 GPa"})
                            .spec;
  EXPECT_EQ(spec.mesh.element_size, 2e-3);
  EXPECT_EQ(spec.layers[0].thickness, 0.5e-3);
  EXPECT_EQ(spec.layers[0].material.young, 400e9);
  EXPECT_EQ(spec.run.positions, std::vector<double>{0.2});
  EXPECT_EQ(spec.geometry.cant, 0.05);
  EXPECT_EQ(spec.mesh.coarse_ratio, 4);
  EXPECT_FALSE(spec.run.output.volume);
  EXPECT_EQ(spec.mesh.element, ElementFormulation::one_point);
}

TEST(Overrides, FaultsAreLocatedAtTheCommandLine) {
  const std::string remedy =
      "\n    remedy: write --set table.key=value, e.g. --set mesh.element_size=\"2 mm\" or --set "
      "layer.0.thickness=\"0.5 mm\"";
  EXPECT_EQ(error_of("[mesh]\nelement_size = \"1 mm\"\n", {"mesh.element_size=2"}),
            "--set mesh.element_size=2: mesh.element_size = 2: a bare number has no unit\n    remedy: write a length, "
            "e.g. \"0.2 mm\", in quotes");
  EXPECT_TRUE(error_of("", {"mesh.size=2 mm"}).starts_with("--set mesh.size=2 mm: unknown key mesh.size\n"));
  EXPECT_NE(error_of("", {"vehicle.speed=20 m/s"}).find("remedy: [drive] has speed. keys of [vehicle]: "),
            std::string::npos);
  EXPECT_NE(error_of("", {"friction.coefficient=0.3"}).find("remedy: [drive] has friction_coefficient. "),
            std::string::npos);
  EXPECT_NE(error_of("title = \"mine\"\n").find("remedy: [case] has title. tables: "), std::string::npos);
  EXPECT_EQ(error_of("", {"mesh"}), "--set mesh: is not key=value" + remedy);
  EXPECT_EQ(error_of("", {"mesh=3"}), "--set mesh=3: names no table" + remedy);
  EXPECT_EQ(error_of("[[layer]]\nyoung_ratio=2\n", {"layer.2.thickness=1 mm"}),
            "--set layer.2.thickness=1 mm: layer has 1 entry, counted from 0; layer.1 adds one" + remedy);
  EXPECT_EQ(error_of("[mesh]\nelement_size=\"1 mm\"\n", {"mesh.element_size.x=1"}),
            "--set mesh.element_size.x=1: mesh.element_size is not a table" + remedy);
  EXPECT_EQ(error_of("", {"mesh.element_size.x=1"}),
            "--set mesh.element_size.x=1: mesh.element_size is not a table" + remedy);
}

TEST(Overrides, OfOneEntryOfAListAreAnsweredByTheWholeList) {
  for (const char* text : {"", "[run]\npositions = [\"0.3 m\"]\n"})
    EXPECT_EQ(
        error_of(text, {"run.positions.0=0.3 m"}),
        "--set run.positions.0=0.3 m: run.positions is one list, its values have no keys of their own\n    remedy: "
        "give the whole list, e.g. --set run.positions='[\"0.1 m\", \"0.3 m\"]'");
  EXPECT_EQ(error_of("", {"layer.0.young_table.0.1=3 GPa"}),
            "--set layer.0.young_table.0.1=3 GPa: layer.0.young_table is one list, its values have no keys of their "
            "own\n    remedy: give the whole list, e.g. --set layer.0.young_table='[[\"0 mm\", \"420 GPa\"], [\"3 "
            "mm\", \"210 GPa\"]]'");
}

TEST(Overrides, OfATextAreItsWordsEvenIfTheyCouldBeANumber) {
  EXPECT_EQ(parse_case("", "a.toml", {"case.title=2026"}).spec.title, "2026");
  EXPECT_EQ(parse_case("", "a.toml", {"case.title=true"}).spec.title, "true");
  EXPECT_EQ(parse_case("", "a.toml", {"case.title=\"60E1\""}).spec.title, "60E1");
  EXPECT_EQ(parse_case("", "a.toml", {"case.title='60E1'"}).spec.title, "60E1");
  EXPECT_EQ(parse_case("", "a.toml", {"layer.0.young_ratio=2", "layer.0.name=3"}).spec.layers[0].name, "3");
  for (const auto& [name, meant] : {std::pair{"60E1", "UIC60"}, {"54E1", "UIC54"}, {"UIC60E1", "UIC60"}}) {
    const std::string error = error_of("", {fmt::format("geometry.rail_profile={}", name)});
    EXPECT_NE(error.find(fmt::format("geometry.rail_profile = \"{}\": neither a built-in profile nor a file", name)),
              std::string::npos)
        << error;
    EXPECT_NE(error.find(fmt::format("did you mean \"{}\"?", meant)), std::string::npos) << error;
  }
  EXPECT_NE(error_of("", {"mesh.element=3"}).find("mesh.element = \"3\": must be one of"), std::string::npos);
}

TEST(CaseFile, SettingsWithoutEffectAreNoted) {
  const LoadedCase loaded = parse_case("[geometry]\nblock_width = \"70 mm\"\n", "a.toml");
  EXPECT_EQ(loaded.notes,
            std::vector<std::string>{"geometry.block_width has no effect without geometry.rail_shape = \"block\""});
}

// The resolved case of an old result has every key: with the value that holds now they are read over.
TEST(CaseFile, KeysThatAreGoneAreTakenWithTheirFixedValueAndElseAnsweredByWhatTakesTheirPlace) {
  const char* const old =
      "[vehicle]\nsuspension_groups = 8\ngravity = \"9.81 m/s^2\"\n[contact]\nmethod = \"mortar\"\npenalty_scale = "
      "0.1\n"
      "[mesh]\nhourglass_coefficient = 0.05\nelements_through_layer_one = false\n[run]\ntime_step_method = \"auto\"\n"
      "[passes]\nwindow_tolerance = 0.001\n";
  const LoadedCase loaded = parse_case(old, "a.toml");
  EXPECT_EQ(loaded.resolved_toml, parse_case("", "a.toml").resolved_toml);
  EXPECT_TRUE(loaded.notes.empty());
  for (const auto& [text, at, remedy] :
       {std::tuple{"[run]\ntime_step_method = \"local\"\n", "a.toml:2:20: ", "use run.mass_scaling_step"},
        {"[contact]\npenalty_scale = 0.2\n", "a.toml:2:17: ", "without penetration"},
        {"[geometry]\ninclination = \"1:20\"\n", "a.toml:2:15: ", "write geometry.cant"},
        {"[mesh]\nelements_through_layer_one = true\n", "a.toml:2:30: ", "give elements = 1 in every [[layer]]"},
        {"[run]\nplasticity = true\nplastic_depth = \"12 mm\"\n", "a.toml:3:17: ", "with the same results"},
        {"[vehicle]\ngravity = \"9.8 m/s^2\"\n", "a.toml:2:11: ", "give loads as forces"}}) {
    const std::string error = error_of(text);
    EXPECT_TRUE(error.starts_with(at)) << error;
    for (const char* words : {"this key is gone", remedy}) EXPECT_NE(error.find(words), std::string::npos) << error;
  }
  EXPECT_NE(error_of("[contact]\npenalty = 0.2\n").find("unknown table or key contact"), std::string::npos);
}

TEST(CaseFile, ADriveThatAStaticCaseMakesVoidIsNoted) {
  const std::string still = "[run]\nrolling = false\n";
  const auto noted = [&](const std::string& more, const std::vector<std::string>& overrides = {}) {
    return notes_at_rest(parse_case(still + more, "a.toml", overrides));
  };
  for (const std::string key : {"creepage = 0.001", "traction_coefficient = 0.1", "tractive_force = \"5 kN\"",
                                "lateral_creepage = 0.001", "lateral_traction_coefficient = 0.1", "spin = \"1 1/m\""}) {
    const std::vector<std::string> notes = noted("[drive]\n" + key + "\n");
    ASSERT_EQ(notes.size(), 1u) << key;
    EXPECT_EQ(notes[0].find("drive." + key.substr(0, key.find(' ')) + " has no effect with run.rolling = false"), 0u)
        << notes[0];
  }
  EXPECT_EQ(noted("[passes]\ntraction_coefficients = [0.0, 0.1]\n").size(), 1u);
  EXPECT_EQ(noted("", {"drive.traction_coefficient=0.2"}).size(), 1u) << "the default's value, but asked for";
  EXPECT_TRUE(noted("").empty());
  EXPECT_TRUE(noted("[drive]\ntraction_coefficient = 0.0\n").empty());
  EXPECT_TRUE(notes_at_rest(parse_case(resolved_case(parse_case(still, "a.toml").spec), "b.toml")).empty());
  EXPECT_TRUE(notes_at_rest(parse_case("[drive]\ncreepage = 0.001\n", "a.toml")).empty());
}

TEST(CaseFile, AFileWithoutAKeyIsRefused) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.toml";
  const auto load = [&](const char* text) {
    std::ofstream(file) << text;
    return load_case(file, {"mesh.element_size=2 mm"});
  };
  for (const char* text : {"", "\n \t\r\n", "# [mesh]\n  # a = 1\n", "[mesh]\n[drive]\n"})
    EXPECT_THROW(load(text), CaseError) << text;
  EXPECT_NO_THROW(load("# mine\n[drive]\nspeed = \"20 m/s\"\n"));
}

TEST(CaseFile, AMissingFileIsToldByName) {
  try {
    load_case("no/such/case.toml");
    FAIL();
  } catch (const CaseError& e) {
    EXPECT_TRUE(std::string(e.what()).starts_with("cannot read no/such/case.toml: No such file or directory\n"))
        << e.what();
  }
}

// Steel's modulus times either end of the ratio's range.
TEST(CaseFile, EveryRatioThatThePageAllowsIsTakenForSteel) {
  for (const double ratio : {0.01, 100.0}) {
    const CaseSpec spec = parse_case(fmt::format("[[layer]]\nyoung_ratio = {}\n", ratio), "a.toml").spec;
    EXPECT_DOUBLE_EQ(spec.layers.at(0).material.young, ratio * 210e9);
  }
}

TEST(CaseFile, ARatioMayNotTakeTheModulusOutOfItsRange) {
  const std::string error = error_of("[material.rail]\nyoung = \"10000 GPa\"\n[[layer]]\nyoung_ratio = 100\n");
  EXPECT_NE(error.find("a.toml:4:15: layer.0.young_ratio = 100: must be between 0.01 and 10 here: it makes young "
                       "1000000 GPa, which must be between 1 GPa "
                       "and 100000 GPa"),
            std::string::npos)
      << error;
}

TEST(CaseFile, AWholeNumberThatNoDoubleHoldsIsANumber) {
  EXPECT_NE(error_of("[drive]\nfriction_coefficient = 9007199254740993\n").find("must be between 0 and 2"),
            std::string::npos);
}

TEST(CaseFile, NamesThatNoFileCanHaveAreNoProfiles) {
  for (const std::string& name : {std::string(), std::string(100'000, 'x'), std::string("a.csv\\u0000b"),
                                  std::string("/proc/1/fd/0/x"), std::string("a/../..")})
    EXPECT_NE(error_of("[geometry]\nrail_profile = \"" + name + "\"\n").find("neither a built-in profile nor a file"),
              std::string::npos)
        << name.substr(0, 20);
}

TEST(CaseFile, ControlCharactersOfATextReadBack) {
  const LoadedCase loaded = parse_case("[case]\ntitle = \"a\\u007F\\n\\\\ \\\"b\\\" \\t µ\"\n", "a.toml");
  EXPECT_EQ(loaded.spec.title, "a\x7F\n\\ \"b\" \t µ");
  EXPECT_EQ(parse_case(loaded.resolved_toml, "a.toml").spec.title, loaded.spec.title);
}

TEST(CaseFile, KeysNestedBeyondTheStackAreRefused) {
  std::string key = "a";
  for (int i = 0; i < 200'000; ++i) key += ".a";
  for (const std::string& text : {key + " = 1\n", "[" + key + "]\n", "[case]\ntitle = {" + key + " = 1}\n"})
    EXPECT_NE(error_of(text).find("a key on this line has more than 100 dots"), std::string::npos);
  EXPECT_NE(error_of("", {key + "=1"}).find("has a key of more than 100 parts"), std::string::npos);
  EXPECT_NE(error_of("", {"case.title={" + key + "=1}"}).find("has a key of more than 100 parts"), std::string::npos);
  EXPECT_NO_THROW(parse_case("# " + std::string(300, '.') + "\n", "a.toml"));
}

TEST(CaseFile, KeysNestedInBracketsCountTogether) {
  std::string text = "[case]\ntitle = ";
  for (int i = 0; i < 60; ++i) text += "[{a.b.c = ";
  EXPECT_NE(error_of(text).find("a key on this line has more than 100 dots"), std::string::npos);
  std::string key = "a";
  for (int i = 0; i < 200'000; ++i) key += ".a";
  for (const char* quotes : {"\"\"\"", "'''"})
    for (std::size_t own = 0; own < 3; ++own) {  // a text may end with two quotes of its own
      const std::string end = quotes + std::string(quotes).substr(0, own),
                        before = std::string("[case]\ntitle = [") + quotes + "x\ny" + end + ", {";
      EXPECT_NE(error_of(before + key + " = 1}]\n").find("more than 100 dots"), std::string::npos) << before;
    }
}

TEST(CaseFile, DotsOfNumbersAndTextsAreNotThoseOfKeys) {
  std::string rows;
  for (int i = 0; i <= 60; ++i)
    rows += "[\"" + std::to_string(0.05 * i) + " mm\", \"" + std::to_string(210.5 + i) + " GPa\"], ";
  const LoadedCase loaded = parse_case("[[layer]]\nyoung_table = [" + rows + "]\n", "a.toml");
  EXPECT_EQ(loaded.spec.layers.at(0).young_table.size(), 61u);
  EXPECT_EQ(
      parse_case("[[layer]]\nyoung_ratio = 1", "a.toml", {"layer.0.thickness=\"1.0 mm\""}).spec.layers[0].thickness,
      1e-3);
  std::string positions = "0.20";
  for (int i = 1; i < 150; ++i) positions += " m\", \"" + std::to_string(0.2 + 0.001 * i);
  EXPECT_EQ(parse_case("[run]\npositions = [\"" + positions + " m\"]\n", "a.toml").spec.run.positions.size(), 150u);
  EXPECT_EQ(parse_case("", "a.toml", {"run.positions=[\"" + positions + " m\"]"}).spec.run.positions.size(), 150u);
  EXPECT_EQ(parse_case("[case]\ntitle = \"" + std::string(300, '.') + "\"\n", "a.toml").spec.title.size(), 300u);
}

TEST(Overrides, OneIndexBeyondTheLastAddsALayer) {
  const CaseSpec one = parse_case("", "a.toml", {"layer.0.thickness=2 mm", "layer.0.young_ratio=2"}).spec;
  ASSERT_EQ(one.layers.size(), 1u);
  EXPECT_EQ(one.layers[0].thickness, 2e-3);
  EXPECT_EQ(one.layers[0].material.young, 2 * one.rail_material.young);
  const CaseSpec two =
      parse_case("[[layer]]\nyoung_ratio = 2\n", "a.toml", {"layer.1.on=wheel", "layer.1.young=100 GPa"}).spec;
  ASSERT_EQ(two.layers.size(), 2u);
  EXPECT_EQ(two.layers[1].on, BodyId::wheel);
  EXPECT_TRUE(
      error_of("", {"layer.0.thickness=1 mm"}).starts_with("--set layer.0.thickness=1 mm: layer.0 has no modulus\n"))
      << error_of("", {"layer.0.thickness=1 mm"});
  EXPECT_TRUE(
      error_of("", {"layer.1.thickness=1 mm"})
          .starts_with("--set layer.1.thickness=1 mm: layer has 0 entries, counted from 0; layer.0 adds one\n"));
  EXPECT_TRUE(error_of("", {"layer.thickness=1 mm"}).starts_with("--set layer.thickness=1 mm: layer has 0 entries"));
}

TEST(Overrides, GiveAllLayersAsAList) {
  const CaseSpec spec = parse_case("[[layer]]\nyoung_ratio = 9\n", "a.toml",
                                   {"layer=[{thickness = \"1 mm\", young_ratio = 2}, {young_ratio = 3, name = \"b\"}]"})
                            .spec;
  ASSERT_EQ(spec.layers.size(), 2u);
  EXPECT_EQ(spec.layers[1].material.young, 3 * spec.rail_material.young);
  const std::string error = error_of("", {"layer=[{thickness = \"1 m\", young_ratio = 2}]"});
  EXPECT_TRUE(
      error.starts_with("--set layer=[{thickness = \"1 m\", young_ratio = 2}]: layer.0.thickness = \"1 m\": must be"))
      << error;
  EXPECT_TRUE(error_of("[run]\nwindow = \"1 mm\"\n", {"run.positions=[\"0.2 m\", \"99 m\"]"})
                  .starts_with("--set run.positions=[\"0.2 m\", \"99 m\"]: run.positions.1 = \"99 m\": must be"));
  EXPECT_TRUE(error_of("", {"layer=3"}).starts_with("--set layer=3: layer must be a list of tables\n"));
}

double load_of(const CaseSpec& spec) { return spec.vehicle.load(); }

TEST(CaseFile, ALoadIsAForceOrAMassAndSetsTheSprungMass) {
  const auto spec = [](const std::string& text) { return parse_case("[vehicle]\n" + text, "a.toml").spec; };
  EXPECT_NEAR(load_of(spec("wheel_load = \"110 kN\"\n")), 110e3, 1e-6);
  EXPECT_NEAR(load_of(spec("axle_load = \"220 kN\"\nwheel_mass = \"700 kg\"\n")), 110e3, 1e-6);
  EXPECT_NEAR(spec("wheel_load = \"11.25 t\"\n").vehicle.sprung_mass, 11250 - 660, 1e-8);
  EXPECT_NEAR(load_of(spec("axle_load = \"22.5 t\"\n")), 110362.5, 1e-6);
  const LoadedCase loaded = parse_case("[vehicle]\nwheel_load = \"110 kN\"\n", "a.toml");
  EXPECT_EQ(parse_case(loaded.resolved_toml, "a.toml").spec.vehicle.sprung_mass, loaded.spec.vehicle.sprung_mass);
  const LoadedCase light = parse_case("[vehicle]\nwheel_load = \"1 N\"\n", "a.toml");
  EXPECT_NEAR(load_of(light.spec), 1, 1e-11) << "less than the wheel weighs";
  EXPECT_EQ(load_of(parse_case(light.resolved_toml, "a.toml").spec), load_of(light.spec));
  EXPECT_TRUE(refused_by(uses::kHalfSpaces, light.spec).empty());
  EXPECT_FALSE(refused_by(uses::kRollingElements, light.spec).empty());
  EXPECT_NE(error_of("[vehicle]\nwheel_load = \"5 mm\"\n").find("\"mm\" is not the unit of a force"),
            std::string::npos);
  EXPECT_NE(error_of("[vehicle]\nwheel_load = \"2e6 t\"\n").find("must be above 0 kN and at most 10000 kN"),
            std::string::npos);
}

TEST(CaseFile, ADriveIsGivenByForcesOrByCreepages) {
  const DriveSpec given =
      parse_case("[drive]\ncreepage = -0.001\nlateral_force = \"8.49546 kN\"\nspin = \"0.2 rad/m\"\n", "a.toml")
          .spec.drive;
  EXPECT_EQ(given.creepage, -0.001);
  EXPECT_FALSE(given.traction());
  EXPECT_NEAR(given.lateral_traction_coefficient.value(), 0.1, 1e-12);
  EXPECT_EQ(given.spin, 0.2);
  const DriveSpec forces =
      parse_case("[drive]\ntractive_force = \"11 kN\"\n[vehicle]\nwheel_load = \"110 kN\"\n", "a.toml").spec.drive;
  EXPECT_NEAR(forces.traction().value(), 0.1, 1e-12);
  EXPECT_FALSE(forces.lateral_creepage || forces.lateral_traction_coefficient || forces.spin);
}

TEST(CaseFile, ADriveReadsBackToTheSameBits) {
  for (const char* lateral : {"lateral_force = \"3.3 kN\"\n", "lateral_creepage = 0.0033\n", ""}) {
    const LoadedCase loaded = parse_case(
        std::string("[geometry]\nyaw = \"3.3 mrad\"\ncurve_radius = \"-333.3 m\"\n[drive]\ncreepage = -1.1e-3\nspin = "
                    "\"0.33 1/m\"\n") +
            lateral,
        "a.toml");
    const LoadedCase back = parse_case(loaded.resolved_toml, "a.toml");
    EXPECT_EQ(back.resolved_toml, loaded.resolved_toml);
    EXPECT_EQ(back.spec.drive.creepage, loaded.spec.drive.creepage);
    EXPECT_EQ(back.spec.drive.lateral_creepage, loaded.spec.drive.lateral_creepage);
    EXPECT_EQ(back.spec.drive.lateral_traction_coefficient, loaded.spec.drive.lateral_traction_coefficient);
    EXPECT_EQ(back.spec.drive.spin, loaded.spec.drive.spin);
    EXPECT_EQ(back.spec.geometry.yaw, loaded.spec.geometry.yaw);
    EXPECT_EQ(back.spec.geometry.curve_radius, loaded.spec.geometry.curve_radius);
    EXPECT_EQ(loaded.resolved_toml.find("\ntraction_coefficient"), std::string::npos);
  }
}

TEST(CaseFile, OfTwoWaysOfSayingOneThingTheFileHasOneAndTheCommandLineGoesFirst) {
  EXPECT_TRUE(error_of("[drive]\ntraction_coefficient = 0.1\ncreepage = -0.001\n")
                  .starts_with("a.toml:3:12: [drive] has traction_coefficient and creepage: a case has one of them"));
  EXPECT_NE(error_of("[drive]\nlateral_creepage = 0.1\nlateral_force = \"1 kN\"\n").find("a case has one of them"),
            std::string::npos);
  EXPECT_NE(error_of("[vehicle]\nwheel_load = \"100 kN\"\nsprung_mass = \"8 t\"\n").find("a case has one of them"),
            std::string::npos);
  const CaseSpec spec = parse_case("[drive]\ntraction_coefficient = 0.1\n[vehicle]\nsprung_mass = \"8 t\"\n", "a.toml",
                                   {"drive.creepage=-0.001", "vehicle.axle_load=20 t"})
                            .spec;
  EXPECT_EQ(spec.drive.creepage, -0.001);
  EXPECT_NEAR(spec.vehicle.sprung_mass, 10e3 - 660, 1e-8);
  EXPECT_NE(error_of("", {"drive.creepage=-0.001", "drive.traction_coefficient=0.1"}).find("a case has one of them"),
            std::string::npos);
}

TEST(CaseFile, ForcesBeyondFrictionAndTooTightCurvesAreRefused) {
  EXPECT_NE(error_of("[drive]\ntraction_coefficient = 0.4\nlateral_traction_coefficient = 0.4\n")
                .find("0.5657 together: must be below drive.friction_coefficient = 0.5"),
            std::string::npos);
  EXPECT_EQ(parse_case("[drive]\ncreepage = 1\nfriction_coefficient = 0.1\n", "a.toml").spec.drive.creepage, 1.0)
      << "full sliding is a creepage";
  EXPECT_NE(error_of("[geometry]\ncurve_radius = \"2 m\"\n").find("must be at least 5000 mm to either side"),
            std::string::npos);
}

TEST(CaseFile, TellsWhatTheFiniteElementsDoNotDoWithItsPlace) {
  EXPECT_TRUE(not_in_fem(parse_case("[vehicle]\naxle_load = \"22.5 t\"\n[geometry]\nyaw = \"5 mrad\"\n"
                                    "[drive]\nlateral_force = \"1 kN\"\ncreepage = -0.001\n",
                                    "a.toml"))
                  .empty());
  const LoadedCase loaded = parse_case("[geometry]\ncurve_radius = \"300 m\"\n[drive]\nlateral_creepage = 0.2\n",
                                       "a.toml", {"drive.creepage=-0.5"});
  ASSERT_EQ(not_in_fem(loaded).size(), 3u);
  EXPECT_EQ(not_in_fem(loaded)[0].where, "a.toml:2:16");
  EXPECT_TRUE(not_in_fem(loaded)[0].message.starts_with("geometry.curve_radius is not supported by"));
  EXPECT_EQ(not_in_fem(loaded)[1].where, "--set drive.creepage=-0.5");
  EXPECT_EQ(not_in_fem(loaded)[2].where, "a.toml:4:20");
  EXPECT_EQ(not_in_fem(loaded)[0].remedy, "take it out, or solve the case with `railstrata bem`");
  EXPECT_TRUE(not_in_fem(parse_case("[drive]\ncreepage = 0.5\n[run]\nrolling = false\n", "a.toml")).empty());
  const LoadedCase laws = parse_case(
      "[friction]\nlaw = \"falling_rational\"\nkinetic_coefficient = 0.2\nhalf_velocity = \"1 m/s\"\n", "a.toml");
  ASSERT_EQ(not_in_fem(laws).size(), 1u);
  EXPECT_EQ(not_in_fem(laws)[0].where, "a.toml:2:7");
  EXPECT_NE(not_in_fem(laws)[0].message.find("(friction.law)"), std::string::npos);
  const LoadedCase remembering = parse_case(
      "[friction]\nlaw = \"falling_rational\"\nkinetic_coefficient = 0.2\nhalf_velocity = \"1 m/s\"\n"
      "memory_distance = \"20 um\"\n",
      "a.toml");
  EXPECT_TRUE(not_in_fem(remembering).empty());
  EXPECT_EQ(remembering.spec.friction.memory_distance, 20e-6);
  EXPECT_EQ(remembering.spec.friction.memory_velocity, 1e-3);
  const LoadedCase film = parse_case("[third_body]\nthickness = \"20 µm\"\nshear_modulus = \"100 MPa\"\n", "a.toml");
  EXPECT_TRUE(not_in_fem(film).empty());
  const LoadedCase ring =
      parse_case("[geometry]\nrail_radius = \"300 mm\"\ncant = 0.01\n[run]\nplasticity = true\n", "a.toml");
  ASSERT_EQ(not_in_fem(ring).size(), 4u);  // rail_shape and cant are defaults, and count; nothing can yield
  EXPECT_EQ(not_in_fem(ring)[2].where, "a.toml:3:8");
  EXPECT_EQ(not_in_fem(ring)[3].where, "a.toml:5:14");
  EXPECT_TRUE(not_in_fem(ring)[1].message.starts_with("geometry.rail_shape = \"rail\" cannot be combined with"));
  EXPECT_EQ(
      not_in_fem(parse_case("[geometry]\nrail_radius = \"-600 mm\"\nrail_shape = \"block\"\ncant = 0.0\n", "a.toml"))
          .size(),
      1u);
  EXPECT_TRUE(
      not_in_fem(parse_case("[geometry]\nrail_radius = \"300 mm\"\nrail_shape = \"block\"\ncant = 0.0\n", "a.toml"))
          .empty());
  EXPECT_THROW(require_support(uses::kFiniteElements, loaded.spec), CaseError);
  EXPECT_NO_THROW(require_support(uses::kFiniteElements, CaseSpec()));
}

TEST(CaseFile, WhatNoCaseHasIsAnsweredByWhatToDoInstead) {
  const auto remedy = [](const std::string& text) {
    const std::string error = error_of(text);
    return error.substr(error.find("remedy: ") + 8);
  };
  EXPECT_TRUE(
      remedy("[run]\ncreepage = 0.01\n").starts_with("set drive.creepage, drive.lateral_creepage or drive.spin"));
  EXPECT_TRUE(remedy("[drive]\nangle_of_attack = \"5 mrad\"\n").starts_with("geometry.yaw is the angle of attack"));
  EXPECT_TRUE(remedy("[drive]\naxle_load = \"22.5 t\"\n").starts_with("set vehicle.wheel_load or vehicle.axle_load"));
  EXPECT_TRUE(
      remedy("[track]\ngauge = \"1435 mm\"\n").starts_with("gauge, cant and lateral_shift are keys of [geometry]"));
  EXPECT_EQ(remedy("[drive]\nspeed = \"0 km/h\"\n"), "choose a value in this range");
}

TEST(Overrides, AreOneValueInUtf8) {
  EXPECT_NE(error_of("", {"case.title=\xFF"}).find("is not one value in UTF-8"), std::string::npos);
  EXPECT_NE(error_of("", {"case.title=\"a\"\nother=1"}).find("is not one value in UTF-8"), std::string::npos);
  EXPECT_EQ(parse_case("", "a.toml", {"case.title=a \"b\" \\c"}).spec.title, "a \"b\" \\c");
}

}  // namespace
}  // namespace railstrata
