#include "material/plastic.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "material/elastic.hpp"
#include "material/material_path.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

constexpr double kMPa = 1e6;

std::vector<MaterialState> drive_path(const PlasticMaterial& material, const MaterialPath& path, int increments) {
  const auto nothing = [](const MaterialState&) {};
  return railstrata::drive_path(material, path, increments, nothing);
}

PlasticMaterial material(double young, double poisson, double yield, double q, double b, std::vector<double> c,
                         std::vector<double> gamma) {
  const Elastic e = elastic(young * kMPa, poisson, 7800);
  PlasticMaterial out{e.lambda, {e.mu, yield * kMPa, q * kMPa, b, {}, {}}};
  for (std::size_t k = 0; k < c.size(); ++k) {
    out.plastic.modulus[k] = c[k] * kMPa;
    out.plastic.recall[k] = gamma[k];
  }
  return out;
}

PlasticMaterial three_backstresses() {
  return material(210000, 0.3, 400, 60, 9, {160000, 40000, 4000}, {800, 150, 10});
}

/// A path of stresses in MPa.
MaterialPath stresses(std::vector<std::array<double, 6>> points) {
  MaterialPath out;
  out.prescribed.fill(Prescribed::stress);
  for (auto& point : points)
    for (double& s : point) s *= kMPa;
  out.points = std::move(points);
  return out;
}

/// The limit of a quantity whose error falls with the first power of the step, from three of them, each half the one
/// before.
double limit(const std::array<double, 3>& by_step) { return (8 * by_step[2] - 6 * by_step[1] + by_step[0]) / 3; }

template <class Solve>
double limit_of(int steps, Solve&& solve) {
  return limit({solve(steps), solve(2 * steps), solve(4 * steps)});
}

double uniaxial(const std::array<double, 6>& stress) { return stress[0] - 0.5 * (stress[1] + stress[2]); }

// [Chaboche1989]: sigma = sigma_y0 + Q (1 - e^{-b p}) + sum C/gamma (1 - e^{-gamma p}); gamma = 0: C p.
TEST(Plastic, MonotonicTensionIsTheClosedForm) {
  const PlasticMaterial m = material(210000, 0.3, 500, 100, 4, {20000, 10}, {400, 0});
  for (const auto& [plastic, stress] : {std::pair{0.002, 528.35036}, {0.01, 553.10527}, {0.05, 568.62693}}) {
    const double strain = plastic + stress * kMPa / (3 * m.plastic.mu);
    const MaterialPath path{{}, {{strain, -strain / 2, -strain / 2, 0, 0, 0}}};
    const auto accumulated = [&](int steps) { return drive_path(m, path, steps).back().history[6]; };
    const auto axial = [&](int steps) { return uniaxial(drive_path(m, path, steps).back().stress); };
    EXPECT_NEAR(limit_of(2000, accumulated), plastic, 1e-6 * plastic);
    EXPECT_NEAR(limit_of(2000, axial), stress * kMPa, 1e-6 * stress * kMPa);
  }
}

// sigma_a = sigma_y0 + sum C/gamma tanh(gamma eps_pa) of the loop that no longer changes; in torsion a sqrt(3)-th of it
// at sqrt(3) times the plastic shear.
TEST(Plastic, SaturatedLoopsOfTensionAndTorsionHaveTheAmplitudeOfTheClosedForm) {
  const PlasticMaterial m = material(210000, 0.3, 300, 0, 0, {80000, 20000, 2000}, {800, 150, 0});
  for (const auto& [plastic, amplitude] :
       {std::pair{0.001, 388.25501}, {0.0025, 449.18374}, {0.005, 494.61946}, {0.01, 540.68641}}) {
    const double axial = plastic + amplitude * kMPa / (3 * m.plastic.mu), shear = std::numbers::sqrt3 / 2 * axial;
    MaterialPath tension, torsion;
    const int halves = 3 + static_cast<int>(12 / (150 * 2 * plastic));  // until the slowest backstress has settled
    for (int half = 0; half < halves; ++half) {
      const double sign = half % 2 == halves % 2 ? -1 : 1;
      tension.points.push_back({sign * axial, -sign * axial / 2, -sign * axial / 2, 0, 0, 0});
      torsion.points.push_back({0, 0, 0, sign * shear, 0, 0});
    }
    const auto in_tension = [&](int steps) { return uniaxial(drive_path(m, tension, steps).back().stress); };
    const auto in_torsion = [&](int steps) { return drive_path(m, torsion, steps).back().stress[3]; };
    EXPECT_NEAR(limit_of(250, in_tension), amplitude * kMPa, 1e-5 * amplitude * kMPa) << plastic;
    EXPECT_NEAR(std::numbers::sqrt3 * limit_of(250, in_torsion), amplitude * kMPa, 1e-5 * amplitude * kMPa) << plastic;
  }
}

/// Net axial plastic strain of the third cycle between two axial stresses.
double ratchetting(const PlasticMaterial& m, double highest, double lowest, int steps) {
  std::vector<std::array<double, 6>> points;
  for (int cycle = 0; cycle < 3; ++cycle) {
    points.push_back({highest, 0, 0, 0, 0, 0});
    points.push_back({lowest, 0, 0, 0, 0, 0});
  }
  const auto states = drive_path(m, stresses(points), steps);
  return states[5].history[0] - states[3].history[0];
}

// delta eps = (1/gamma) ln{[(C/gamma)^2 - X1^2] / [(C/gamma)^2 - X2^2]}, X2 = sigma_max - sigma_y, X1 = sigma_min +
// sigma_y: exact for one backstress.
TEST(Plastic, UniaxialRatchettingIsTheClosedForm) {
  const PlasticMaterial m = material(210000, 0.3, 400, 0, 0, {40000}, {200});
  for (const auto& [highest, lowest, rate] : {std::tuple{550.0, -450.0, 3.8107003e-3},
                                              {550.0, -400.0, 4.1333929e-3},
                                              {580.0, -500.0, 6.8652457e-3},
                                              {500.0, -500.0, 0.0}}) {
    const std::array rates{ratchetting(m, highest, lowest, 1000), ratchetting(m, highest, lowest, 2000),
                           ratchetting(m, highest, lowest, 4000)};
    EXPECT_NEAR(limit(rates), rate, 1e-5 * std::max(rate, 1e-3)) << highest << " " << lowest;
    if (rate > 0) {
      EXPECT_NEAR((rates[1] - rate) / (rates[2] - rate), 2, 0.01) << "first order";
    }
  }
  EXPECT_NEAR(ratchetting(material(210000, 0.3, 400, 0, 0, {40000}, {0}), 550, -450, 100), 0, 1e-12)
      << "linear kinematic hardening does not ratchet";
}

// Axial stress 100 MPa held, shear stress between -300 and 300 MPa: extrapolated from 500, 1000, 2000 steps a branch of
// another program.
TEST(Plastic, BiaxialRatchettingIsTheReferences) {
  const PlasticMaterial m = material(210000, 0.3, 400, 0, 0, {40000}, {200});
  const auto run = [&](int steps) {
    std::vector<std::array<double, 6>> points{{100, 0, 0, 0, 0, 0}, {100, 0, 0, 300, 0, 0}};
    for (int cycle = 0; cycle < 4; ++cycle) {
      points.push_back({100, 0, 0, -300, 0, 0});
      points.push_back({100, 0, 0, 300, 0, 0});
    }
    const auto s = drive_path(m, stresses(points), steps);
    return std::array{s[1].history[0], s[3].history[0] - s[1].history[0], s[7].history[0] - s[5].history[0]};
  };
  const auto coarse = run(250), middle = run(500), fine = run(1000);
  const std::array reference{1.0845e-3, 2.5636e-3, 2.4988e-3};  // first quarter, first cycle, from the third on
  for (std::size_t k = 0; k < reference.size(); ++k)
    EXPECT_NEAR(limit({coarse[k], middle[k], fine[k]}), reference[k], 3e-3 * reference[k]) << k;
}

struct Answer {
  std::string material, path;
  std::size_t point;
  std::array<double, 6> stress;  // MPa
  double p;
};

std::vector<std::vector<std::string>> rows_of(const std::string& name) {
  std::ifstream file(source_dir() / "tests/data/reference" / name);
  std::vector<std::vector<std::string>> out;
  bool names = true;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#")) continue;
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (!names) out.push_back(row);
    names = false;
  }
  return out;
}

std::map<std::string, MaterialPath> reference_paths() {
  std::map<std::string, MaterialPath> out;
  for (const auto& row : rows_of("plastic_paths.csv")) {
    auto& point = out[row[0]].points.emplace_back();
    for (std::size_t j = 0; j < 6; ++j) point[j] = std::stod(row[j + 2]);
  }
  return out;
}

std::vector<Answer> reference_answers() {
  std::vector<Answer> out;
  for (const auto& row : rows_of("plastic_answers.csv")) {
    out.push_back({row[0], row[1], std::stoul(row[2]), {}, std::stod(row[9])});
    for (std::size_t j = 0; j < 6; ++j) out.back().stress[j] = std::stod(row[j + 3]);
  }
  return out;
}

std::map<std::string, PlasticMaterial> reference_materials() {
  return {{"perfect", material(210000, 0.3, 480, 0, 0, {}, {})},
          {"linear_kinematic", material(210000, 0.3, 350, 0, 0, {20000}, {0})},
          {"af_voce", material(207000, 0.29, 300, 80, 12, {60000}, {250})},
          {"chaboche3", material(209000, 0.3, 380, -60, 8, {180000, 40000, 6000}, {1400, 220, 12})},
          {"hard_layer", material(230000, 0.3, 900, 150, 30, {250000, 30000}, {900, 60})}};
}

/// Largest difference of stress [MPa], by material.
std::map<std::string, double> differences(int increments) {
  const auto paths = reference_paths();
  std::map<std::string, std::vector<MaterialState>> solved;
  const auto materials = reference_materials();
  std::map<std::string, double> out;
  for (const Answer& a : reference_answers()) {
    auto& states = solved[a.material + a.path];
    if (states.empty()) states = drive_path(materials.at(a.material), paths.at(a.path), increments);
    for (std::size_t j = 0; j < 6; ++j)
      out[a.material] = std::max(out[a.material], std::abs(states.at(a.point).stress[j] / kMPa - a.stress[j]));
    EXPECT_NEAR(states[a.point].history[6], a.p, a.p / increments + 1e-8) << a.material << a.path;
  }
  return out;
}

// The references are good to 0.3 MPa themselves (tests/data/reference/README.md).
TEST(Plastic, StressesAlongGivenStrainPathsAreTheReferencesAndConvergeWithTheFirstOrder) {
  ASSERT_EQ(reference_answers().size(), 255u);
  const auto coarse = differences(10), middle = differences(40), fine = differences(800);
  for (const auto& [name, difference] : fine) {
    EXPECT_LT(difference, 0.5) << name;
    EXPECT_GT(coarse.at(name), 3 * middle.at(name)) << name;
    EXPECT_GT(middle.at(name), 5 * difference) << name;
  }
}

// E = (F^T F - 1)/2 takes nothing of a rotation, and the law has no other frame.
TEST(Plastic, ARotationOnTheWayChangesNoStress) {
  const PlasticMaterial m = three_backstresses();
  double history[2][kPlasticHistory<3>] = {};
  for (int step = 1; step <= 400; ++step) {
    const double t = step / 400.0, shear = 0.02 * std::sin(9 * t), stretch = 0.01 * std::sin(5 * t);
    Eigen::Matrix3d f;
    f << 1 + stretch, shear, 0, 0.3 * shear, 1 - 0.5 * stretch, 0, 0, -0.2 * shear, 1;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.5 * t, Eigen::Vector3d(1, 2, 0.5).normalized()).matrix();
    double stress[2][6];
    for (const int turned : {0, 1}) {
      const Eigen::Matrix3d g = turned ? turn * f : f;
      const Eigen::Matrix3d c = 0.5 * (g.transpose() * g - Eigen::Matrix3d::Identity());
      const double e[6] = {c(0, 0), c(1, 1), c(2, 2), c(0, 1), c(1, 2), c(0, 2)};
      advance_plastic<3, 2>(m.plastic, e, history[turned]);
      plastic_stress(m.lambda, m.plastic.mu, e, history[turned], stress[turned]);
    }
    for (int j = 0; j < 6; ++j) ASSERT_NEAR(stress[1][j], stress[0][j], 1e-12 * m.lambda);
  }
  EXPECT_GT(history[0][6], 0.01);
}

/// Steps of a random walk of strain that comes back to zero, of all sizes.
std::array<double, 6> walk(std::array<double, 6> strain, std::mt19937& random, double size) {
  std::normal_distribution<double> normal;
  for (double& e : strain) e = 0.995 * e + size * normal(random);
  return strain;
}

TEST(Plastic, DissipatesAndKeepsTheVolumeAndTheYieldConditionInEveryStep) {
  const PlasticMaterial m = three_backstresses();
  std::mt19937 random(7);
  double work = 0;
  std::array<double, 6> strain{};
  double history[kPlasticHistory<kMostBackstresses>] = {}, stress[6] = {};
  double dissipated = 0;
  for (int step = 0; step < 20000; ++step) {
    const auto next = walk(strain, random, 1e-4);
    double before[kPlasticHistory<kMostBackstresses>], e[6], old[6];
    std::copy(std::begin(history), std::end(history), before);
    std::copy(std::begin(stress), std::end(stress), old);
    std::copy(next.begin(), next.end(), e);
    advance_plastic<kMostBackstresses, 4>(m.plastic, e, history);
    plastic_stress(m.lambda, m.plastic.mu, e, history, stress);
    const double loss = plastic_dissipation<kMostBackstresses>(m.plastic, stress, before, history);
    ASSERT_GE(loss, 0);
    ASSERT_GE(history[6], before[6]);
    ASSERT_NEAR(history[0] + history[1] + history[2], 0, 1e-15);
    std::array<double, kPlasticHistory<kMostBackstresses>> state;
    std::copy(std::begin(history), std::end(history), state.begin());
    ASSERT_LT(yield_excess(m.plastic, next, state), 1e-12);
    dissipated += loss;
    double d[6], mean[6];
    for (int j = 0; j < 6; ++j) {
      d[j] = next[j] - strain[j];
      mean[j] = 0.5 * (stress[j] + old[j]);
    }
    work += double_contraction(mean, d);
    strain = next;
  }
  double elastic_strain[6];
  for (int j = 0; j < 6; ++j) elastic_strain[j] = strain[j] - history[j];
  const double stored =
      0.5 * double_contraction(stress, elastic_strain) + backstress_energy<kMostBackstresses>(m.plastic, history);
  EXPECT_NEAR(work, stored + dissipated, 0.02 * work) << "energy closes to the first order of the step";
  EXPECT_GT(dissipated, 0.5 * work);
}

template <int terms>
void expect_packs_as_scalars() {
  const PlasticMaterial m = three_backstresses();
  const PlasticParameters<float> single = m.plastic.rounded_to<float>();
  constexpr int n = kPlasticHistory<terms>, float_lanes = kLanesOf<float>;
  std::mt19937 random(3);
  std::array<std::array<double, 6>, float_lanes> strain{};
  Pack pack[n] = {};
  PackOf<float> floats[n] = {};
  double scalar[float_lanes][n] = {};
  for (int step = 0; step < 3000; ++step) {
    Pack e[6];
    PackOf<float> e_float[6];
    for (int l = 0; l < float_lanes; ++l) {
      if (l % 3 != 1) strain[l] = walk(strain[l], random, 2e-5 * (l + 1));
      double one[6];
      for (int j = 0; j < 6; ++j) {
        one[j] = strain[l][j];
        if (l < kLanes) e[j][l] = one[j];
        e_float[j][l] = static_cast<float>(one[j]);
      }
      advance_plastic<terms, 1>(m.plastic, one, scalar[l]);
    }
    advance_plastic<terms, 1>(m.plastic, e, pack);
    advance_plastic<terms, 1>(single, e_float, floats);
  }
  for (int l = 0; l < float_lanes; ++l)
    for (int i = 0; i < n; ++i) {
      const double scale = i < 7 ? 1e-3 : 400e6;
      if (l < kLanes) {
        EXPECT_NEAR(pack[i][l], scalar[l][i], 1e-11 * scale) << l << " " << i;
      }
      EXPECT_NEAR(floats[i][l], scalar[l][i], 5e-3 * scale + 1e-3 * std::abs(scalar[l][i])) << l << " " << i;
    }
}

// To rounding: where products and sums are fused is the compiler's choice, and another one for packs.
TEST(Plastic, PacksOfBothPrecisionsGiveTheScalarsHistory) {
  expect_packs_as_scalars<0>();
  expect_packs_as_scalars<1>();
  expect_packs_as_scalars<3>();
  expect_packs_as_scalars<4>();
}

// Bit for bit: what an element keeps must not depend on who shares its pack.
TEST(Plastic, ALaneThatDoesNotFlowKeepsItsHistoryAndTakesNothingFromItsNeighbours) {
  const PlasticMaterial m = three_backstresses();
  constexpr int n = kPlasticHistory<3>;
  std::mt19937 random(5);
  Pack alone[n] = {}, together[n] = {};
  std::array<double, 6> quiet{}, loud{};
  for (int step = 0; step < 500; ++step) {
    quiet = walk(quiet, random, 2e-4);
    loud = walk(loud, random, 5e-4);
    Pack a[6], b[6];
    for (int j = 0; j < 6; ++j) {
      a[j] = Pack{} + quiet[j];
      b[j] = a[j];
      for (int l = 1; l < kLanes; ++l) b[j][l] = loud[j];
    }
    advance_plastic<3, 1>(m.plastic, a, alone);
    advance_plastic<3, 1>(m.plastic, b, together);
    for (int i = 0; i < n; ++i)
      ASSERT_EQ(std::bit_cast<std::int64_t>(static_cast<double>(alone[i][0])),
                std::bit_cast<std::int64_t>(static_cast<double>(together[i][0])));
  }
  EXPECT_GT(alone[6][0], 0);
}

TEST(Plastic, AnInfiniteYieldStrengthLeavesTheHistoryExactlyZero) {
  PlasticParameters<double> p = three_backstresses().plastic;
  p.yield = std::numeric_limits<double>::infinity();
  const PlasticParameters<float> single = p.rounded_to<float>();
  Pack e[6] = {}, history[kPlasticHistory<3>] = {};
  PackOf<float> f[6] = {}, floats[kPlasticHistory<3>] = {};
  for (int j = 0; j < 6; ++j) {
    e[j] += 0.1 * (j + 1);
    f[j] += 0.1F * static_cast<float>(j + 1);
  }
  advance_plastic<3, 2>(p, e, history);
  advance_plastic<3, 2>(single, f, floats);
  for (int i = 0; i < kPlasticHistory<3>; ++i)
    for (int l = 0; l < kLanes; ++l) {
      EXPECT_EQ(std::bit_cast<std::int64_t>(static_cast<double>(history[i][l])), 0) << i;
      EXPECT_EQ(static_cast<float>(floats[i][l]), 0.0F) << i;
    }
}

// sigma(p) of the scaled material is the factor times sigma(p).
TEST(Plastic, AHarderMaterialHasTheCurveOfPlasticStrainTimesTheFactor) {
  const PlasticMaterial soft = three_backstresses();
  PlasticMaterial hard = soft;
  hard.plastic = scaled(soft.plastic, 1.4);
  const auto stress_at = [](const PlasticMaterial& m, double plastic) {
    double stress = 0;
    std::array<double, 6> e{0.03, -0.015, -0.015, 0, 0, 0};
    const auto look = [&](const MaterialState& s) {
      if (s.history[6] <= plastic) stress = uniaxial(s.stress);
    };
    railstrata::drive_path(m, {{}, {e}}, 30000, look);
    return stress;
  };
  for (const double plastic : {0.001, 0.005, 0.02})
    EXPECT_NEAR(stress_at(hard, plastic), 1.4 * stress_at(soft, plastic), 1e-4 * stress_at(hard, plastic));
}

// -expm1(-x): the share must be right where it is small, for the first yielding of a rail.
TEST(Plastic, VoceShareIsExactToRoundingEverywhere) {
  for (double x = 1e-14; x < 60; x *= 1.7) {
    EXPECT_NEAR(saturated_share(x) / -std::expm1(-x), 1, 2e-15) << x;
    EXPECT_NEAR(saturated_share(static_cast<float>(x)) / -std::expm1(-x), 1, 2e-6) << x;
  }
  EXPECT_EQ(saturated_share(0.0), 0);
}

TEST(MaterialPath, MixedPathsAndStressesThatNoStrainGives) {
  const PlasticMaterial m = material(210000, 0.3, 400, 0, 0, {40000}, {200});
  EXPECT_NEAR(largest_stress(m.plastic), 600 * kMPa, 1);
  MaterialPath tension = stresses({{0.004, 0, 0, 0, 0, 0}});
  tension.prescribed[0] = Prescribed::strain;
  tension.points[0][0] = 0.004;
  const MaterialState s = drive_path(m, tension, 500).back();
  EXPECT_NEAR(s.stress[1], 0, 1);
  EXPECT_NEAR(s.strain[1], -0.3 * s.stress[0] / 210e9 - 0.5 * s.history[0], 1e-12)
      << "contracts by nu, plastic: by half";
  EXPECT_GT(s.stress[0], 400 * kMPa);
  try {
    drive_path(m, stresses({{500, 0, 0, 0, 0, 0}, {700, 0, 0, 0, 0, 0}}), 10);
    FAIL() << "700 MPa is beyond what it bears";
  } catch (const BeyondMaterial& e) {
    EXPECT_EQ(e.point, 1);
    EXPECT_NEAR(e.reached, 0.5, 0.11) << "600 MPa";
  }
}

}  // namespace
}  // namespace railstrata
