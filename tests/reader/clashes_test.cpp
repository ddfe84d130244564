// The table of what excludes what, row by row: an example that breaks the rule, and what the message must name.
#include "rules/clashes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "core/faults.hpp"
#include "reader/case_file.hpp"
#include "rules/support.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

using Overrides = std::vector<std::string>;

std::string text_of(const char* file) {
  std::ifstream in(source_dir() / file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Settings by which a case has a feature, by its first key; by its words where one key has several features.
const std::map<std::string, Overrides>& examples() {
  const Overrides film{"third_body.thickness=20 um", "third_body.shear_modulus=100 MPa"},
      fall{"friction.law=falling_rational", "friction.kinetic_coefficient=0.2", "friction.half_velocity=1 m/s"},
      warm{"friction.rail_temperature=20 K", "friction.wheel_temperature=20 K"},
      history{"transient.kind=rolling", "transient.distance=5 mm"};
  const auto with = [](Overrides all, const Overrides& more) {
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  static const std::map<std::string, Overrides> all{
      {"geometry.contact",
       {"geometry.contact=line", "geometry.line_length=20 mm", "geometry.wheel_profile=flat",
        "geometry.rail_profile=flat", "geometry.cant=0"}},
      {"geometry.line_length", {"geometry.line_length=20 mm"}},
      {"bem.bodies", {"bem.bodies=sections"}},
      {"bem.normals", {"bem.normals=local"}},
      {"geometry.wheel_profile", {"geometry.wheel_profile=LMA"}},
      {"geometry.rail_profile", {"geometry.rail_profile=CN60"}},
      {"an arc or a plane below a wheel with a flange", {"geometry.rail_profile=\"arc:R=300 mm\""}},
      {"geometry.cant", {"geometry.cant=0.05"}},
      {"geometry.roll", {"geometry.roll=5 mrad"}},
      {"geometry.yaw", {"geometry.yaw=5 mrad"}},
      {"geometry.lateral_shift", {"geometry.lateral_shift=1 mm"}},
      {"geometry.curve_radius", {"geometry.curve_radius=300 m"}},
      {"geometry.rail_radius", {"geometry.rail_radius=300 mm"}},
      {"a hollow rail", {"geometry.rail_radius=-600 mm"}},
      {"geometry.rail_shape", {"geometry.rail_shape=rail"}},
      {"geometry.block_width", {"geometry.block_width=70 mm"}},
      {"geometry.block_height", {"geometry.block_height=70 mm"}},
      {"track.preset", {"track.preset=delft"}},
      {"a track without bem.bodies = \"sections\"", {"track.preset=delft"}},
      {"track.phase | track.pad_damping | track.pad_length | track.sleeper_mass | track.ballast_damping | track.bays",
       {"track.preset=delft", "track.phase=0.2"}},
      {"track", {"track.spacing=650 mm"}},
      {"irregularity", {"irregularity=[{at=\"200 mm\", length=\"20 mm\", depth=\"0.2 mm\"}]"}},
      {"a dip or a step", {"irregularity=[{kind=\"dip\", at=\"2 m\", angle=\"10 mrad\"}]"}},
      {"layer", {"layer.0.young_ratio=2"}},
      {"bogie", {"bogie=[{type=\"coach\", mgt=10}]"}},
      {"curve.radius | curve.superelevation | curve.rail", {"curve.radius=800 m"}},
      {"crack.top | crack.angle | crack.place | crack.fluid | crack.aspect | crack.law | crack.threshold | "
       "crack.detectable | crack.allowable",
       {"crack.top=2 mm"}},
      {"crack.azimuth | crack.lateral | crack.face_friction", {"crack.azimuth=0 deg"}},
      {"crack.layer", {"crack.layer=2"}},
      {"crack.length", {"layer.0.young_ratio=2", "crack.length=4 mm"}},
      {"crack.depth", {"crack.depth=4 mm"}},
      {"crack.top", {"crack.top=2 mm"}},
      {"crack.place", {"crack.place=5 mm"}},
      {"crack.fluid", {"crack.fluid=mouth"}},
      {"layer.from", {"layer.0.young_ratio=2", "layer.0.from=150 mm"}},
      {"layer.width", {"layer.0.young_ratio=2", "layer.0.width=50 mm"}},
      {"layer.thickness_table",
       {"layer.0.young_ratio=2", "layer.0.thickness_table=[[\"-20 mm\", \"0 mm\"], [\"20 mm\", \"3 mm\"]]"}},
      {"layer.unbonded", {"layer.0.young_ratio=2", "layer.0.unbonded=[[\"180 mm\", \"192 mm\"]]"}},
      {"layer.interface_normal_stiffness", {"layer.0.young_ratio=2", "layer.0.interface_normal_stiffness=1e4 MPa/mm"}},
      {"layer.interface_shear_limit", {"layer.0.young_ratio=2", "layer.0.interface_shear_limit=60 MPa"}},
      {"a shear stiffness of 0",
       {"layer.0.young_ratio=2", "layer.0.interface_friction=0.3", "layer.0.interface_shear_stiffness=0 MPa/mm"}},
      {"stretch", {"stretch=[{along=[[\"190 mm\", 1.0, 1.0], [\"200 mm\", 1.0, 0.8]]}]"}},
      {"a layer thinner than 0.05 mm", {"layer.0.young_ratio=2", "layer.0.thickness=0.02 mm"}},
      {"layer.thickness", {"layer.0.thickness=3 mm"}},
      {"layer.young_ratio", {"layer.0.young_ratio=2"}},
      {"layer.young_table", {"layer.0.young_table=[[\"0 mm\", \"420 GPa\"], [\"3 mm\", \"210 GPa\"]]"}},
      {"*.poisson", {"material.rail.poisson=0.498"}},
      {"*.hardening", {"material.rail.hardening=R260"}},
      {"material.rail.initial_stress",
       {"material.rail.initial_stress=[\"-100 MPa\", \"0 MPa\"]", "material.rail.hardening=R260",
        "run.plasticity=true"}},
      {"vehicle.sprung_mass", {"vehicle.wheel_load=1 N"}},
      {"vehicle.approach", {"vehicle.approach=0.1 mm"}},
      {"drive.tractive_force", {"drive.tractive_force=5 kN"}},
      {"drive.creepage_of", {"drive.creepage_of=wheel"}},
      {"creepages of the wheel", {"drive.creepage_of=wheel", "drive.creepage=-0.001"}},
      {"drive.friction_coefficient",
       {"friction.lateral_table=[[\"0 mm\", 0.2], [\"9 mm\", 0.4]]", "drive.friction_coefficient=0.3"}},
      {"drive.creepage", {"drive.creepage=-0.001"}},
      {"a creepage beyond 0.1", {"drive.creepage=-0.5", "drive.lateral_creepage=0.5"}},
      {"a creepage in a history", with(history, {"drive.creepage=-0.001"})},
      {"drive.traction_coefficient", {"drive.traction_coefficient=0.1"}},
      {"drive.lateral_creepage", {"drive.lateral_creepage=0.001"}},
      {"drive.lateral_traction_coefficient", {"drive.lateral_traction_coefficient=0.1"}},
      {"drive.spin", {"drive.spin=0.1 1/m"}},
      {"load", {"load=[{passages=100}]"}},
      {"load.wheel_load", {"load=[{wheel_load=\"80 kN\"}]"}},
      {"friction.law", fall},
      {"friction.kinetic_coefficient", {"friction.kinetic_coefficient=0.2"}},
      {"friction.half_velocity", {"friction.half_velocity=1 m/s"}},
      {"friction.lateral_table", {"friction.lateral_table=[[\"0 mm\", 0.2], [\"9 mm\", 0.4]]"}},
      {"friction.lateral_coefficient", {"friction.lateral_coefficient=0.3"}},
      {"friction.temperature_table", with(warm, {"friction.temperature_table=[[\"20 K\", 1], [\"400 K\", 0.6]]"})},
      {"friction.rail_temperature", {"friction.rail_temperature=20 K"}},
      {"friction.wheel_temperature", {"friction.wheel_temperature=20 K"}},
      {"third_body.thickness", film},
      {"third_body.shear_modulus", {"third_body.shear_modulus=100 MPa"}},
      {"third_body.yield_shear", {"third_body.yield_shear=50 MPa"}},
      {"third_body.hardening", {"third_body.hardening=1 MPa/mm"}},
      {"a film that softens", with(film, {"third_body.yield_shear=50 MPa", "third_body.hardening=-1 MPa/mm",
                                          "third_body.residual_shear=5 MPa"})},
      {"third_body.residual_shear", {"third_body.residual_shear=20 MPa"}},
      {"third_body.yield_by_pressure",
       with(film, {"third_body.yield_by_pressure=0.1", "third_body.yield_shear=50 MPa"})},
      {"third_body.modulus_by_pressure", with(film, {"third_body.modulus_by_pressure=1"})},
      {"third_body.temperature_table", with(warm, {"third_body.temperature_table=[[\"20 K\", 1], [\"400 K\", 0.6]]"})},
      {"run.rolling", {"run.rolling=false"}},
      {"run.window", {"run.window=10 mm"}},
      {"run.plasticity = true", {"run.plasticity=true"}},
      {"run.plasticity = false", {"run.plasticity=false"}},
      {"mesh.element", {"mesh.element=one_point"}},
      {"run.device", {"run.device=gpu"}},
      {"transient.kind", history},
      {"transient.kind = \"rolling\"", history},
      {"transient.kind = \"shift\"", {"transient.kind=shift", "transient.lateral_force=[\"5 kN\", \"2 kN\"]"}},
      {"transient", {"transient.tractive_force=[\"5 kN\"]"}},
      {"transient.increments", with(history, {"transient.increments=20"})},
      {"transient.creepage", {"transient.creepage=[0.001, 0.002]"}},
      {"transient.displacement", {"transient.displacement=[\"1 um\", \"2 um\"]"}},
      {"transient.lateral_force", {"transient.kind=shift", "transient.lateral_force=[\"5 kN\", \"2 kN\"]"}},
      {"passes.lateral_positions", {"passes.lateral_positions=[\"1 mm\"]"}},
      {"passes.lateral_deviation", {"passes.lateral_deviation=1 mm"}},
      {"passes.traction_coefficients", {"passes.traction_coefficients=[0.1]"}},
      {"passes.jump", {"passes.jump=auto"}},
      {"passes.patch_cells", {"passes.patch_cells=8"}},
      {"life.until", {"life.until=1 Mt"}},
      {"life.first_cracks", {"life.first_cracks=30 Mt"}},
      {"grinding.every", {"grinding.every=15 Mt"}},
      {"grinding.depth", {"grinding.depth=0.2 mm"}}};
  return all;
}

/// A case lacks what a default case has.
const std::map<std::string, Overrides> kWithout{
    {"drive.friction_coefficient", {"drive.friction_coefficient=0", "drive.traction_coefficient=0"}}};

std::string first_key(const Feature& f) { return std::string(f.key.substr(0, f.key.find_first_of(" "))); }

Overrides example(const Feature& f) {
  for (const std::string& name : {std::string(f.name), std::string(f.key), first_key(f)})
    if (const auto found = examples().find(name); found != examples().end()) return found->second;
  ADD_FAILURE() << "no example of " << f.key;
  return {};
}

/// Of a key as it stands in a case: layer.0.from of layer.from, material.rail.poisson of *.poisson.
std::string last_part(const Feature& f) {
  const std::string key = first_key(f);
  return key.substr(key.rfind('.') + 1);
}

Overrides breaking(const Clash& c) {
  Overrides out;
  const auto add = [&](const Overrides& more) { out.insert(out.end(), more.begin(), more.end()); };
  const bool lacking = c.rule == ClashRule::needs || c.rule == ClashRule::idle_without;
  if (!c.b.use && !lacking) add(example(c.b));
  if (!c.a.use) add(example(c.a));
  if (lacking && c.b.key.find(" = ") == std::string_view::npos)
    std::erase_if(out, [&](const std::string& one) { return one.starts_with(first_key(c.b) + "="); });
  if (const auto without = kWithout.find(first_key(c.b)); lacking && without != kWithout.end()) add(without->second);
  return out;
}

std::string all_of(const Overrides& overrides) {
  std::string out;
  for (const std::string& one : overrides) out += " --set " + one;
  return out;
}

/// Every message of a case for a use, each with its remedy.
std::vector<Diagnostic> said(const Clash& c, const Overrides& overrides) {
  const Use* const use = c.of();
  std::vector<Diagnostic> out;
  try {
    const LoadedCase loaded = parse_case("", "a.toml", overrides);
    for (const std::string& note : notes_for(use ? *use : uses::kAny, loaded)) out.push_back({"", note, note});
    if (use)
      for (const Diagnostic& r : refused_by(*use, loaded.spec)) out.push_back(r);
  } catch (const CaseError& e) {
    for (const Diagnostic& d : e.diagnostics) out.push_back({d.where, d.message, d.remedy});
  }
  return out;
}

TEST(Clashes, EveryRowIsSaidWithBothKeysTheReasonAndTheRemedy) {
  for (const Clash& c : clash_table()) {
    if (c.rule == ClashRule::overlooked) continue;
    const Overrides overrides = breaking(c);
    std::string heard;
    const auto says = [&](const Diagnostic& r) {
      heard += "\n  " + r.message;
      const bool both = (c.a.use || r.message.find(last_part(c.a)) != std::string::npos) &&
                        (c.b.use ? r.message.find(c.b.name) : r.message.find(last_part(c.b))) != std::string::npos;
      return both && r.message.find(c.why) != std::string::npos &&
             r.remedy.find(c.b.use && !*c.why ? "" : c.remedy) != std::string::npos;
    };
    const std::vector<Diagnostic> all = said(c, overrides);
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), says))
        << c.a.key << " and " << c.b.key << c.b.name << all_of(overrides) << heard;
  }
}

TEST(Clashes, EveryRefusalHasSomethingToDo) {
  for (const Clash& c : clash_table())
    EXPECT_TRUE(*c.remedy || (c.rule != ClashRule::excludes && c.rule != ClashRule::needs)) << c.a.key;
}

TEST(Clashes, ADefaultCaseBreaksNone) {
  const LoadedCase usual = parse_case("", "a.toml");
  EXPECT_TRUE(idle_settings(usual.spec).empty());
  for (const Use* use : {&uses::kFiniteElements, &uses::kHalfSpaces, &uses::kPasses, &uses::kCreepCurve,
                         &uses::kExplorer, &uses::kRanks, &uses::kDeck, &uses::kContactInput})
    EXPECT_TRUE(refused_by(*use, usual.spec).empty()) << use->name;
}

TEST(Clashes, SayWhichKeysHaveNoPlaceInACase) {
  const auto excluded = [](const std::string& text) {
    return excluded_keys(uses::kExplorer, parse_case(text, "a.toml").spec);
  };
  EXPECT_FALSE(excluded("").contains("geometry.lateral_shift"));
  const auto line = excluded(
      "[geometry]\ncontact = \"line\"\nline_length = \"20 mm\"\nrail_profile = \"flat\"\n"
      "wheel_profile = \"flat\"\ncant = 0.0\n");
  EXPECT_NE(line.at("geometry.lateral_shift").find("geometry.contact"), std::string::npos);
  EXPECT_TRUE(excluded("[run]\nrolling = false\n").contains("drive.traction_coefficient"));
  EXPECT_TRUE(excluded("[friction]\nlateral_table = [[\"0 mm\", 0.2], [\"9 mm\", 0.4]]\n")
                  .contains("drive.friction_coefficient"));
  const auto graded = excluded(
      "[[layer]]\nyoung_ratio = 2\n[[layer]]\nyoung_table = [[\"0 mm\", \"420 GPa\"], [\"3 mm\", \"210 GPa\"]]\n");
  EXPECT_TRUE(graded.contains("layer.1.thickness") && graded.contains("layer.1.young_ratio"));
  EXPECT_FALSE(graded.contains("layer.0.thickness"));
}

TEST(Clashes, ThePageInDocsIsTheOneTheProgramWrites) {
  EXPECT_EQ(text_of("docs/exclusions.md"), exclusions_markdown())
      << "write it again: ./railstrata info --schema --exclusions > docs/exclusions.md";
}

// Where a reader looks: one grep finds what keeps a track from half-spaces.
TEST(Clashes, ATrackAndHalfSpacesMeetInOneLineOfTheTable) {
  std::istringstream lines(text_of("src/case/rules/clashes.cpp"));
  int found = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.find("kTrackOfHalfSpaces") != std::string::npos && line.find("uses::kHalfSpaces") != std::string::npos)
      ++found;
  EXPECT_EQ(found, 1);
}

}  // namespace
}  // namespace railstrata
