// Transients as a case file asks for them: against CONTACT, closed forms of shifts, and steady rolling.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ask/answer.hpp"
#include "core/faults.hpp"
#include "reader/case_file.hpp"
#include "tests/bem/reference_table.hpp"
#include "tests/halfspace/classical_rolling.hpp"

namespace railstrata {
namespace {

constexpr double kLoad = 84954.6, kFriction = 0.5;

/// A circular contact: wheel and rail with the gap (x² + y²)/840 mm to the fourth order. The materials are the case's.
std::string circle(double load = kLoad, double friction = kFriction, const std::string& materials = "") {
  return fmt::format(
      "[geometry]\nrail_profile = \"arc:R=840 mm\"\nwheel_profile = \"arc:R=840 mm\"\nwheel_radius = \"420 mm\"\n"
      "wheel_shape = \"disc\"\nbore_radius = \"20 mm\"\ncant = 0.0\n{}[vehicle]\nwheel_mass = \"1 kg\"\nwheel_load = "
      "\"{:.12g} N\"\n[drive]\nfriction_coefficient = {}\n",
      materials, load, friction);
}

struct Followed {
  CaseSpec spec;
  Placement placement;
  Answer solution;
  std::vector<ContactField> fields;
  double shift = 0;  ///< m, at the start
  const std::vector<TransientRow>& rows() const { return solution.history; }
};

Followed follow(const std::string& text, double cell, const std::vector<std::string>& overrides = {}) {
  const LoadedCase loaded = parse_case(text, "a.toml", overrides);
  Followed out{loaded.spec, place(loaded.spec, {}), {}, {}, 0};
  BemOptions options;
  options.cell = cell;
  const auto observer = [&](const TransientState& state) {
    out.fields.push_back(state.result.field);
    if (state.step == 0) out.shift = state.displacement_x;
  };
  out.solution = ask(out.spec, out.placement, kContactAlone, {.bem = options, .observer = observer});
  return out;
}

/// A row of cells through the origin, along x.
std::vector<double> middle_row(const ContactField& f, const std::vector<double>& values) {
  std::vector<double> out;
  for (int s = 0; s < f.stations; ++s) out.push_back(values[s * f.columns + f.columns / 2]);
  return out;
}

void expect_row_of_contact(const ContactField& f, int step) {
  const auto table = reference_table(fmt::format("circ_cattaneo_to_carter_dx0.5_step{}_y0.csv", step));
  const std::vector<double> x = middle_row(f, f.x), q = middle_row(f, f.q_x), p = middle_row(f, f.p);
  int compared = 0;
  for (const ReferenceRow& r : table)
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (std::abs(x[i] - 1e-3 * r.at("x_mm")) > 1e-9) continue;
      // arcs are no parabolas: x⁴/(8 R³) is felt in the cells at the edge, of which this is one
      EXPECT_NEAR(p[i], 1e6 * r.at("pn_MPa"), (std::abs(x[i]) < 5.9e-3 ? 0.5e-4 : 1.5e-4) * 1075e6)
          << step << " at " << r.at("x_mm");
      EXPECT_NEAR(-q[i], 1e6 * r.at("px_MPa"), 1e-4 * 1075e6) << step << " at " << r.at("x_mm");
      ++compared;
    }
  EXPECT_GE(compared, 25);
}

// Cattaneo's shift at F_x/(f N) = 0.4, then rolling at that force in steps of one cell, whole cells as CONTACT has
// them.
TEST(TransientCase, FromRestToRollingAsContactHasIt) {
  const double force = 0.4 * kFriction * kLoad;
  const Followed run = follow(circle() + fmt::format("tractive_force = \"{:.12g} N\"\n[transient]\nkind = \"rolling\"\n"
                                                     "distance = \"24.5 mm\"\n[bem]\nleading_edge = \"whole_cell\"\n",
                                                     force),
                              0.5e-3);
  const auto table = reference_table("circ_cattaneo_to_carter_dx0.5.csv");
  ASSERT_EQ(run.rows().size(), table.size());
  for (std::size_t k = 0; k < table.size(); ++k) {
    const TransientRow& row = run.rows()[k];
    EXPECT_EQ(row.step, static_cast<int>(k));
    EXPECT_NEAR(row.distance, 1e-3 * table[k].at("rolled_distance_mm"), 1e-12);
    EXPECT_NEAR(row.F_x / kLoad, force / kLoad, 1e-4);
    EXPECT_NEAR(row.normal_force / kLoad, 1, 1e-4);
    if (k == 0) {
      EXPECT_NEAR(run.shift / (1e-3 * table[k].at("creep_x_or_shift_mm")), 1, 1e-4);
    } else {
      EXPECT_NEAR(row.creepage_x / table[k].at("creep_x_or_shift_mm"), 1, 1e-4) << k;
    }
    const double cell_area = 0.25e-6;
    EXPECT_EQ(std::lround(row.contact_area / cell_area), std::lround(table[k].at("contact_cells"))) << k;
    EXPECT_EQ(std::lround(row.slip_area / cell_area), std::lround(table[k].at("slip_cells"))) << k;
  }
  for (const int step : {0, 24, 49}) expect_row_of_contact(run.fields[static_cast<std::size_t>(step)], step);
  EXPECT_EQ(run.solution.summary.state, "after 24.5 mm of rolling from rest");
  EXPECT_EQ(run.solution.summary.run.steps, 49);
  EXPECT_DOUBLE_EQ(run.solution.summary.position, 24.5e-3);
}

/// Equal bodies without Poisson's effect, for which Cattaneo's solution is exact.
const std::string kNoPoisson =
    "[material.rail]\nyoung = \"200 GPa\"\npoisson = 0.0\n[material.wheel]\nyoung = \"200 GPa\"\n"
    "poisson = 0.0\n";
const HalfSpaceMaterial kBody{200e9, 0.0};

// [Johnson1985 sec. 7.2d]
TEST(TransientCase, AShiftIsCattaneosInForceDisplacementAndStick) {
  const double f = 0.3, force = 0.5 * f * kLoad;
  const std::string pressed = circle(kLoad, f, kNoPoisson) + "[transient]\nkind = \"shift\"\nincrements = 1\n";
  const Followed by_force = follow(pressed + fmt::format("lateral_force = [\"{:.12g} N\"]\n", -force), 0.15e-3);
  const HertzContact hertz = hertz_estimate(by_force.spec, by_force.placement.contact);
  const CattaneoShift exact = cattaneo_shift(hertz, f, force, kBody, kBody);
  ASSERT_EQ(by_force.rows().size(), 2u);
  const TransientRow &begin = by_force.rows()[0], &end = by_force.rows()[1];
  EXPECT_EQ(begin.friction_work, 0);
  EXPECT_NEAR(begin.lateral_force, 0, 1e-6 * kLoad);
  EXPECT_NEAR(end.lateral_force, -force, 1e-5 * kLoad);
  EXPECT_NEAR(end.displacement_y / exact.shift, 1, 2e-3);
  EXPECT_NEAR(std::sqrt(end.stick_area / std::numbers::pi) / exact.stick_radius, 1, 5e-3);
  EXPECT_EQ(end.displacement_x, 0);
  // the displacement found for the force gives the force back
  const Followed by_shift =
      follow(pressed + fmt::format("lateral_displacement = [\"{:.17g} m\"]\n", end.displacement_y), 0.15e-3);
  EXPECT_NEAR(by_shift.rows()[1].lateral_force / end.lateral_force, 1, 1e-4);
  EXPECT_DOUBLE_EQ(by_shift.rows()[1].displacement_y, end.displacement_y);
}

/// Energy lost in a cycle between forces ±Q: 0.9 (f P)²/a S (1 - (1 - r)^(5/3) - (5 r/6)(1 + (1 - r)^(2/3))), r = Q/(f
/// P), S = sum of (2 - nu)/G of the bodies. [Johnson1985 eq. 7.57]
double energy_of_a_cycle(double f, double load, double ratio, double a) {
  const double s = 2 * 2 / (0.5 * kBody.young);
  return 0.9 * std::pow(f * load, 2) / a * s *
         (1 - std::pow(1 - ratio, 5.0 / 3) - 5 * ratio / 6 * (1 + std::pow(1 - ratio, 2.0 / 3)));
}

// [Johnson1985 sec. 7.4]
TEST(TransientCase, FrettingFollowsMindlinsAndDeresiewiczsLoopAndLosesItsEnergy) {
  const double f = 0.3, ratio = 0.8, top = ratio * f * kLoad;
  const int increments = 16;
  const Followed run = follow(
      circle(kLoad, f, kNoPoisson) + fmt::format("[transient]\nkind = \"shift\"\nincrements = {0}\ntractive_force = "
                                                 "[\"{1:.12g} N\", \"-{1:.12g} N\", \"{1:.12g} N\"]\n",
                                                 increments, top),
      0.2e-3);
  ASSERT_EQ(run.rows().size(), 3u * increments + 1);
  const HertzContact hertz = hertz_estimate(run.spec, run.placement.contact);
  const double there = cattaneo_shift(hertz, f, top, kBody, kBody).shift;
  const auto back = [&](double force) { return cattaneo_shift(hertz, f, 0.5 * (top - force), kBody, kBody).shift; };
  for (int k = 1; k <= 3 * increments; ++k) {
    const TransientRow& row = run.rows()[static_cast<std::size_t>(k)];
    // a force that drives the wheel comes of the wheel's surface slipping backwards
    const double exact = k <= increments       ? -cattaneo_shift(hertz, f, row.F_x, kBody, kBody).shift
                         : k <= 2 * increments ? -(there - 2 * back(row.F_x))
                                               : there - 2 * back(-row.F_x);
    EXPECT_NEAR(row.displacement_x, exact, 2e-3 * there) << k;
  }
  const double cycle = run.rows().back().friction_work - run.rows()[increments].friction_work;
  EXPECT_NEAR(cycle / energy_of_a_cycle(f, kLoad, ratio, hertz.a), 1, 0.01);
  double area = 0;  // enclosed by the loop; the polygon's chords lose the square of the increment
  for (std::size_t k = increments + 1; k < run.rows().size(); ++k)
    area -= 0.5 * (run.rows()[k].F_x + run.rows()[k - 1].F_x) *
            (run.rows()[k].displacement_x - run.rows()[k - 1].displacement_x);
  EXPECT_NEAR(area / cycle, 1, 0.01);
  EXPECT_NEAR(run.rows().back().displacement_x / run.rows()[increments].displacement_x, 1, 1e-4) << "it closes";
  EXPECT_TRUE(std::isnan(run.solution.summary.contact.creepage_x));
  EXPECT_EQ(run.solution.summary.contact.displacement_x, run.rows().back().displacement_x);
  EXPECT_TRUE(run.fields.back().slip_is_distance);
}

// A shift has nothing of rolling: whichever body has the crown, a force that is held moves nothing, and friction takes
// no more than the force gives.
TEST(TransientCase, AShiftThatIsHeldStandsStillOnEveryProfile) {
  const std::string sphere = "wheel_radius = \"460 mm\"\ncant = 0.0\n";
  const std::string profiles[] = {"rail_profile = \"arc:R=460 mm\"\nwheel_profile = \"flat\"\n" + sphere,
                                  "rail_profile = \"flat\"\nwheel_profile = \"arc:R=460 mm\"\n" + sphere,
                                  "rail_profile = \"CN60\"\nwheel_profile = \"LMA\"\n",
                                  "rail_profile = \"UIC60\"\nwheel_profile = \"S1002\"\nlateral_shift = \"2 mm\"\n"};
  double on_crown = 0;
  for (const std::string& geometry : profiles) {
    const Followed run = follow("[geometry]\n" + geometry +
                                    "[vehicle]\nwheel_load = \"80 kN\"\n[drive]\nfriction_coefficient = 0.3\n"
                                    "[transient]\nkind = \"shift\"\nincrements = 8\n"
                                    "traction_coefficient = [0.0, 0.15, 0.15]\n",
                                0.5e-3);
    const TransientRow &pushed = run.rows()[16], &held = run.rows()[24];
    EXPECT_LT(pushed.displacement_x, -5e-6) << geometry;
    EXPECT_NEAR(held.displacement_x / pushed.displacement_x, 1, 1e-6) << geometry;
    EXPECT_NEAR(held.friction_work / pushed.friction_work, 1, 1e-6) << geometry;
    EXPECT_EQ(run.rows()[8].friction_work, 0) << geometry << "no force yet";
    double given = 0;
    for (std::size_t k = 1; k < run.rows().size(); ++k)
      given -= run.rows()[k].F_x * (run.rows()[k].displacement_x - run.rows()[k - 1].displacement_x);
    EXPECT_LT(held.friction_work, given) << geometry;
    if (geometry == profiles[0]) {
      on_crown = pushed.displacement_x;
      const HalfSpaceMaterial steel{run.spec.rail_material.young, run.spec.rail_material.poisson};
      const HertzContact hertz = hertz_estimate(run.spec, run.placement.contact);
      EXPECT_NEAR(-on_crown / cattaneo_shift(hertz, 0.3, 12e3, steel, steel).shift, 1, 3e-3);
    }
    if (geometry == profiles[1]) {
      EXPECT_NEAR(pushed.displacement_x / on_crown, 1, 2e-5) << "a torus is a sphere to the fourth order";
    }
  }
}

// Where the tangential force rises by less than f times the normal force nothing slips: ring by ring comes into contact
// and sticks, dδ/dQ = S/(8 a) with the half-width a of the moment, S as above. [Johnson1985 sec. 7.4]
TEST(TransientCase, ForcesThatRiseTogetherBelowFrictionDoNotSlip) {
  const double begin = 40e3, end = 85e3, ratio = 0.2;
  const Followed run =
      follow(circle(end, 0.5, kNoPoisson) +
                 fmt::format("[transient]\nkind = \"shift\"\nincrements = 40\nwheel_load = [\"{} N\", \"{} N\"]\n"
                             "lateral_force = [\"0 N\", \"{} N\"]\n",
                             begin, end, ratio * (end - begin)),
             0.25e-3);
  const HertzContact hertz = hertz_estimate(run.spec, run.placement.contact);
  const double s = 2 * 2 / (0.5 * kBody.young),
               exact = ratio * s / (8 * hertz.a) * 1.5 * (end - std::pow(begin, 2.0 / 3) * std::cbrt(end));
  const TransientRow& last = run.rows().back();
  EXPECT_NEAR(-last.displacement_y / exact, 1, 5e-3) << "of first order in the increment";
  EXPECT_LT(last.friction_work, 1e-4 * 0.5 * ratio * (end - begin) * exact);
  EXPECT_LT(last.slip_area / last.contact_area, 0.01);
}

TEST(TransientCase, RollingFromRestArrivesAtTheSteadyAnswerAndSteadyRollingStaysThere) {
  const std::string driven = circle() + "traction_coefficient = 0.2\nlateral_creepage = 0.0004\nspin = \"0.1 1/m\"\n";
  const ContactSummary steady = follow(driven, 0.5e-3).solution.summary.contact;
  const Followed rest = follow(driven + "[transient]\nkind = \"rolling\"\ndistance = \"60 mm\"\n", 0.5e-3),
                 on = follow(driven + "[transient]\nkind = \"rolling\"\nstart = \"steady\"\ndistance = \"5 mm\"\n",
                             0.5e-3);
  const TransientRow& end = rest.rows().back();
  EXPECT_TRUE(steady.error.p_max > 0 && std::isnan(rest.solution.summary.contact.error.p_max))
      << "error bars are those of steady rolling";
  EXPECT_NEAR(end.creepage_x / steady.creepage_x, 1, 2e-4);
  EXPECT_NEAR(end.lateral_force / steady.lateral_force, 1, 2e-4);
  EXPECT_NEAR(end.q_max / steady.patch.q_max, 1, 1e-3);
  for (const TransientRow& row : on.rows()) {
    EXPECT_NEAR(row.creepage_x / steady.creepage_x, 1, 1e-4) << row.step;
    EXPECT_NEAR(row.lateral_force / steady.lateral_force, 1, 1e-4) << row.step;
  }
  // power over distance
  EXPECT_NEAR(on.rows().back().friction_work, on.rows().back().friction_power / on.spec.drive.speed * 5e-3,
              1e-3 * on.rows().back().friction_work);
}

TEST(TransientCase, LoadForceAndCreepageFollowTheirRows) {
  const Followed run = follow(circle() +
                                  "[transient]\nkind = \"rolling\"\nat_distance = [\"0 mm\", \"4 mm\", \"4 mm\", "
                                  "\"8 mm\"]\nload_factor = [1, 1.5, 1, 1]\ntractive_force = [\"0 kN\", \"10 kN\", "
                                  "\"20 kN\", \"20 kN\"]\nlateral_creepage = [0, 0.001, 0.001, 0.001]\n",
                              1e-3);
  ASSERT_EQ(run.rows().size(), 9u);
  for (const TransientRow& row : run.rows()) {
    const double x = 1e3 * row.distance, load = x <= 4 ? kLoad * (1 + 0.125 * x) : kLoad,
                 force = x <= 4 ? 2.5e3 * x : 20e3;
    EXPECT_NEAR(row.load, load, 1e-6 * load) << row.step;
    EXPECT_NEAR(row.F_z / load, 1, 1e-4) << row.step;
    EXPECT_NEAR(row.F_x, force, 1e-5 * kLoad) << row.step;
    if (row.step > 0) {
      EXPECT_NEAR(row.creepage_y, x <= 4 ? 0.00025 * (x - 0.5) : 0.001, 1e-12) << "of the middle of the step";
    }
  }
  // the same by time
  const double speed = run.spec.drive.speed;
  const Followed timed = follow(
      circle() +
          fmt::format("[transient]\nkind = \"rolling\"\nat_time = [\"0 s\", \"{0:.15g} s\", \"{0:.15g} s\", "
                      "\"{1:.15g} s\"]\nload_factor = [1, 1.5, 1, 1]\ntractive_force = [\"0 kN\", \"10 kN\", \"20 "
                      "kN\", \"20 kN\"]\nlateral_creepage = [0, 0.001, 0.001, 0.001]\n",
                      4e-3 / speed, 8e-3 / speed),
      1e-3);
  EXPECT_NEAR(timed.rows()[3].creepage_x / run.rows()[3].creepage_x, 1, 1e-6);
  EXPECT_NEAR(timed.rows().back().time, 8e-3 / speed, 1e-12);
}

// Towards the flange lateral friction carries a part of the load, on the way as in the end.
TEST(TransientCase, NormalAndLateralForceBearTheLoadTogether) {
  const Followed run = follow(
      "[geometry]\nlateral_shift = \"9.5 mm\"\n[drive]\nfriction_coefficient = "
      "0.3\ntraction_coefficient = 0.05\n[transient]\nkind = \"rolling\"\ndistance = \"5 mm\"\n",
      0.5e-3);
  EXPECT_GT(run.placement.contact.angle, 0.1);
  for (const TransientRow& row : run.rows()) EXPECT_NEAR(row.F_z / row.load, 1, 2e-5) << row.step;
}

TEST(TransientCase, LayersAreFollowedTooAndInterfacesThatGive) {
  for (const char* interface : {"",
                                "interface_normal_stiffness = \"20000 MPa/mm\"\n"
                                "interface_shear_stiffness = \"5000 MPa/mm\"\n"}) {
    const std::string driven =
        circle() + "traction_coefficient = 0.2\n[[layer]]\nthickness = \"1 mm\"\nyoung_ratio = 4\n" + interface;
    const ContactSummary steady = follow(driven, 0.5e-3).solution.summary.contact;
    const Followed rest = follow(driven + "[transient]\nkind = \"rolling\"\ndistance = \"60 mm\"\n", 0.5e-3);
    EXPECT_NEAR(rest.rows().back().creepage_x / steady.creepage_x, 1, 1e-3) << interface;
    EXPECT_NEAR(rest.rows().back().p_max / steady.patch.p_max, 1, 1e-4) << interface;
  }
}

TEST(TransientCase, AControlEndsIt) {
  const LoadedCase loaded = parse_case(circle() + "[transient]\nkind = \"rolling\"\ndistance = \"20 mm\"\n", "a.toml");
  Control control;
  AskOptions how{.control = &control};
  how.bem.cell = 1e-3;
  how.observer = [&](const TransientState& state) { control.stop = state.step == 3; };
  const Answer s = ask(loaded.spec, place(loaded.spec, {}), {}, how);
  EXPECT_TRUE(s.stopped);
  EXPECT_EQ(s.history.size(), 4u);
  EXPECT_EQ(s.summary.state, "after 3 mm of rolling from rest");
}

// A film of 10 MPa under 85 kN (118 mm2) carries 1.1 kN at most, as a row's force shows before the first step.
TEST(TransientCase, ForcesBeyondAFilmAreToldBeforeTheFirstStepWithTheirRow) {
  const auto message = [](const std::string& last) -> std::string {
    const LoadedCase loaded = parse_case(
        circle() + "[third_body]\nthickness = \"20 um\"\nshear_modulus = \"100 MPa\"\nyield_shear = \"10 MPa\"\n" +
            "[transient]\nkind = \"rolling\"\nat_distance = [\"0 mm\", \"8 mm\"]\ntractive_force = [\"0 kN\", \"" +
            last + "\"]\n",
        "a.toml");
    BemOptions options;
    options.cell = 0.5e-3;
    try {
      require_film_carries(loaded.spec, place(loaded.spec, {}), options);
    } catch (const CaseError& e) {
      return in_case_file(loaded, e).what();
    }
    return "";
  };
  EXPECT_EQ(message("1 kN"), "");
  const std::string text = message("2 kN");
  EXPECT_NE(text.find("a.toml:"), std::string::npos) << text;
  EXPECT_NE(text.find("third_body.yield_shear: row 2 of the transient wants 2 kN"), std::string::npos) << text;
}

// The load falls to a five-thousandth on the way and comes back: the patch is 0.7 mm wide there.
TEST(TransientCase, TooFewCellsAreToldOfTheSmallestPatchOnTheWay) {
  const Followed run = follow(circle() +
                                  "[transient]\nkind = \"rolling\"\nat_distance = [\"0 mm\", \"4 mm\", \"8 "
                                  "mm\"]\nload_factor = [1, 0.0002, 1]\ntraction_coefficient = [0, 0, 0]\n",
                              0.5e-3);
  const Summary& s = run.solution.summary;
  const auto check =
      std::find_if(s.checks.begin(), s.checks.end(), [](const Check& c) { return c.name == "cell_of_patch"; });
  ASSERT_NE(check, s.checks.end());
  EXPECT_FALSE(check->ok);
  EXPECT_GT(check->value, 0.35);
  EXPECT_TRUE(std::any_of(s.warnings.begin(), s.warnings.end(),
                          [](const Warning& w) { return w.name == "few_cells_over_patch"; }));
}

TEST(TransientCase, EveryCheckOfTheLastStateHolds) {
  const Followed run = follow(circle() +
                                  "[transient]\nkind = \"rolling\"\nat_distance = [\"0 mm\", \"8 mm\"]\nload_factor "
                                  "= [1, 1.5]\ntraction_coefficient = [0, 0.3]\n",
                              0.5e-3);
  for (const Check& c : run.solution.summary.checks) EXPECT_TRUE(c.ok) << c.name << ' ' << c.value;
  EXPECT_NEAR(run.solution.summary.contact.F_x / kLoad, 0.3, 1e-4) << "over the static load";
}

}  // namespace
}  // namespace railstrata
