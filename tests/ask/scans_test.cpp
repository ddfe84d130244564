// Scans made from known profiles with known faults, read as files, against the profile's own largest pressure.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "ask/answer.hpp"
#include "geometry/profile_names.hpp"
#include "reader/case_file.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

/// How a list differs from its profile; lengths in mm.
struct Scan {
  const char* profile;
  double spacing, noise;
  int decimals;  ///< of mm
  int specks = 0;
  double unit = 1;      ///< of mm: 1000 for metres, 25.4 for inches
  double inclined = 0;  ///< tangent, with the gauge side down
  bool mirrored = false, z_down = false;
};

/// Deviates of a unit normal distribution, the same on every machine.
double deviate(std::mt19937& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(random()) / 4294967296.0;
  return sum;
}

std::string listed(const Scan& scan, const Profile& profile, unsigned seed) {
  std::mt19937 random(seed);
  const int decimals = scan.decimals + static_cast<int>(std::lround(std::log10(scan.unit)));
  std::string text = scan.unit == 25.4 ? "y [in],z [in]\n" : "y,z\n";
  std::vector<int> specks;
  for (int k = 0; k < scan.specks; ++k) specks.push_back(static_cast<int>((-20 + 13.7 * k) / scan.spacing));
  const double turn = std::atan(scan.inclined), mm = 1e3;
  for (int i = static_cast<int>(std::ceil(mm * profile.y_min() / scan.spacing));
       i * scan.spacing < mm * profile.y_max(); ++i) {
    const double y = i * scan.spacing;
    double z = mm * profile.height(y / mm) + scan.noise * deviate(random);
    for (const int speck : specks)
      if (i == speck) z += 0.05 + 12 * scan.noise;
    Vec2 p{std::cos(turn) * y - std::sin(turn) * z, std::sin(turn) * y + std::cos(turn) * z};
    if (scan.mirrored) p.y = -p.y;
    if (scan.z_down) p.z = -p.z;
    text += fmt::format("{:.{}f},{:.{}f}\n", p.y / scan.unit, decimals, p.z / scan.unit, decimals);
  }
  return text;
}

ContactSummary contact_of(const std::vector<std::string>& sets, const std::filesystem::path& folder) {
  const LoadedCase loaded =
      parse_case("[vehicle]\nwheel_load = \"85 kN\"\n[drive]\ntraction_coefficient = 0\n", folder / "none.toml", sets);
  AskOptions how;
  how.bem.cell = 0.5e-3;
  Wanted wanted = kContactAlone;
  wanted.other_fits = true;
  return ask(loaded.spec, place(loaded.spec, folder), wanted, how).summary.contact;
}

/// Of CN60 and LMA, UIC60 and S1002.
std::vector<std::string> pair_of(const std::string& profile) {
  return profile == "CN60" || profile == "LMA"
             ? std::vector<std::string>{"geometry.rail_profile=CN60", "geometry.wheel_profile=LMA", "geometry.track=CN"}
             : std::vector<std::string>{"geometry.rail_profile=UIC60", "geometry.wheel_profile=S1002",
                                        "geometry.track=EN", "geometry.lateral_shift=1 mm"};
}

struct Found {
  double exact = 0, read = 0, bar = 0;
  bool inside() const { return std::abs(read - exact) <= bar; }
};

/// The largest pressures, MPa, by the profile itself and by its scan, with its error bar.
Found found_by(const Scan& scan, unsigned seed) {
  const TemporaryFolder temporary;
  const std::string name = scan.profile;
  const bool wheel = name == "LMA" || name == "S1002";
  const Profile profile = builtin_profile(wheel ? ProfileKind::wheel : ProfileKind::rail, name);
  std::ofstream(temporary.path() / "scan.csv") << listed(scan, profile, seed);
  std::vector<std::string> sets = pair_of(name);
  const ContactSummary exact = contact_of(sets, temporary.path());
  sets.push_back(wheel ? "geometry.wheel_profile=scan.csv" : "geometry.rail_profile=scan.csv");
  if (scan.inclined != 0) sets.emplace_back("geometry.cant=0");
  if (scan.mirrored && !wheel) sets.emplace_back("geometry.rail_mirror=true");
  const ContactSummary read = contact_of(sets, temporary.path());
  const double to_mpa = 1e-6;
  return {to_mpa * exact.patch.p_max, to_mpa * read.patch.p_max, to_mpa * read.error.p_max};
}

const Scan kScans[] = {
    {"LMA", 0.5, 0, 2},
    {"CN60", 0.2, 3e-3, 4, 3},
    {"S1002", 0.3, 2e-3, 3},
    {"UIC60", 0.2, 4e-3, 4, 0, 1000},
    {"CN60", 0.25, 1e-3, 3, 0, 25.4},
    {"CN60", 0.2, 2e-3, 4, 1, 1, 0.025},
    {"CN60", 0.2, 2e-3, 4, 0, 1, 0.025, true},
    {"LMA", 0.9, 0, 2},
    {"LMA", 0.1, 0, 2, 0, 1, 0, false, true},
    {"LMA", 0.2, 5e-3, 3, 2, 1, 0, true},
    {"UIC60", 0.5, 0, 2},
    {"UIC60", 1.0, 0, 2, 0, 1, 0, false, true},
    {"S1002", 0.5, 3e-3, 3, 1},
    {"S1002", 1.0, 0, 2},
    {"CN60", 0.4, 2e-3, 2},
    {"CN60", 0.1, 10e-3, 4, 4, 1, 0, false, true},
    {"LMA", 0.3, 1e-3, 3, 0, 1000},
    {"LMA", 0.25, 4e-3, 4, 2, 25.4},
    {"UIC60", 0.15, 6e-3, 4, 2, 1, 0, true},
    {"S1002", 0.7, 0, 2, 0, 1, 0, true, true},
};

/// Every last digit is 0.01 mm and nothing else is wrong.
std::vector<Scan> rounded_scans() {
  std::vector<Scan> out;
  for (const char* profile : {"LMA", "S1002", "CN60", "UIC60"})
    for (const double spacing : {0.2, 0.3, 0.4}) out.push_back({profile, spacing, 0, 2});
  return out;
}

void expect_inside(const std::vector<Scan>& scans, unsigned seed, std::size_t outside_allowed) {
  std::string outside;
  std::size_t count = 0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Found f = found_by(scans[i], seed + static_cast<unsigned>(i));
    EXPECT_LT(f.bar, 0.5 * f.exact) << "scan " << i << " says nothing";
    if (f.inside()) continue;
    ++count;
    outside +=
        fmt::format("scan {} ({}): {:.0f} MPa ± {:.0f}, exact {:.0f}\n", i, scans[i].profile, f.read, f.bar, f.exact);
  }
  EXPECT_LE(count, outside_allowed) << outside;
}

}  // namespace

TEST(Scans, RoundedSpeckledAndInclinedListsHaveTheTruePressureWithinTheirBars) {
  expect_inside({kScans[0], kScans[1], kScans[5]}, 1, 0);
}

TEST(SlowScans, NineteenOfTwentyHaveTheTruePressureWithinTheirBars) {
  expect_inside({std::begin(kScans), std::end(kScans)}, 100, 1);
}

TEST(SlowScans, ListsOfEverySpacingRoundedToAHundredthHaveTheTruePressureWithinTheirBars) {
  expect_inside(rounded_scans(), 1, 0);
}

TEST(Scans, AListWithManyDigitsAndAProfileBuiltInHaveTheBarOfTheirCells) {
  const TemporaryFolder temporary;
  const Scan fine{"CN60", 0.2, 0, 7};
  std::ofstream(temporary.path() / "scan.csv") << listed(fine, builtin_profile(ProfileKind::rail, "CN60"), 1);
  const double exact = contact_of(pair_of("CN60"), temporary.path()).error.p_max;
  std::vector<std::string> sets = pair_of("CN60");
  sets.emplace_back("geometry.rail_profile=scan.csv");
  EXPECT_NEAR(contact_of(sets, temporary.path()).error.p_max, exact, 0.2 * exact);
}

TEST(Scans, PointsFarApartHaveABarThatHoldsTheTruePressure) {
  const Found f = found_by({"UIC60", 4.58, 0, 4}, 1);
  EXPECT_TRUE(f.inside()) << f.read << " ± " << f.bar << ", exact " << f.exact;
}

}  // namespace railstrata
