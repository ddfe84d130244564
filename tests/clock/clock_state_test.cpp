#include "clock/clock_state.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/faults.hpp"
#include "core/text.hpp"
#include "record/output_file.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

/// Two loads that wear a rail, which yields or does not.
std::string worn(const std::string& rail, const std::string& more = "") {
  return "[geometry]\nrail_profile = \"arc:R=80 mm\"\nwheel_profile = \"arc:R=-400 mm\"\ncant = 0\n"
         "[material.rail]\ngrade = \"R260\"\nfatigue_limit = \"100 MPa\"\ndang_van_coefficient = 0.23\n"
         "fatigue_exponent = 8\n" +
         rail +
         "[drive]\ntraction_coefficient = 0.1\nfriction_coefficient = 0.35\nspin = \"0 1/m\"\n"
         "[[load]]\nname = \"a\"\npassages = 1000\nwheel_load = \"50 kN\"\n"
         "[[load]]\nname = \"b\"\npassages = 500\nwheel_load = \"40 kN\"\n" +
         more;
}
const std::string kElastic = worn("yield_strength = \"3000 MPa\"\n");
const std::string kYielding =
    worn("hardening = \"R260\"\n[passes]\nductility = 3\n", "[grinding]\nevery = \"0.4 Mt\"\ndepth = \"0.05 mm\"\n");

/// A run to so many MGT in a folder.
class Traffic {
 public:
  Traffic(const std::string& text, fs::path folder, double cell = 1e-3)
      : loaded_(parse_case(text, "a.toml")), file_(folder / "traffic") {
    options_.bem.cell = cell;
    options_.apart = 1.5e-3;
    options_.first_row = 0.3e-3;
    options_.change = 0.1;
    options_.settle.tolerance = 0.3;
    options_.control = &control_;
  }
  ClockResult run(double mgt, bool resume = false) {
    options_.horizon = 1e9 * mgt;
    options_.keep = [&](const ClockState& state) { write_clock_state(file_, identity(), state); };
    const std::optional<ClockState> begun = resume ? std::optional(read(mgt)) : std::nullopt;
    options_.begun = begun ? &*begun : nullptr;
    return run_clock(loaded_.spec, {}, options_);
  }
  /// Stopped after so many stretches.
  void stop(double mgt, std::size_t stretches) {
    options_.horizon = 1e9 * mgt;
    options_.begun = nullptr;
    options_.keep = [&](const ClockState& state) {
      write_clock_state(file_, identity(), state);
      control_.stop = state.out.history.size() > stretches;
    };
    EXPECT_THROW(run_clock(loaded_.spec, {}, options_), Interrupted);
    control_.stop = false;
  }
  ClockState read(double mgt) const { return read_clock_state(file_, identity(), 1e9 * mgt); }
  std::string refused(double mgt) const {
    try {
      read(mgt);
    } catch (const CaseError& e) {
      return e.what();
    }
    return "";
  }
  std::string identity() const { return clock_identity(loaded_, options_); }
  const fs::path& file() const { return file_; }

 private:
  LoadedCase loaded_;
  fs::path file_;
  Control control_;
  ClockOptions options_;
};

/// The history, the lives and the profile.
std::vector<std::uint64_t> bits_of(const ClockResult& r) {
  std::vector<double> all{r.wheels, r.tonnes, r.reached};
  for (const ClockMoment& m : r.history)
    all.insert(all.end(), {m.kilograms, m.removed, m.removed_y, m.p_max, m.layer_left, m.ductility, m.ductility_y,
                           m.ductility_depth, m.exhausted, m.cycles, m.fatigue, m.net, m.unsettled, double(m.changes)});
  for (const LifeRow& l : r.lives)
    all.insert(all.end(),
               {l.wheels.low, l.wheels.best, l.wheels.high, l.mgt.low, l.mgt.best, l.mgt.high, l.depth, l.y});
  for (const Vec2& p : r.profile) all.insert(all.end(), {p.y, p.z});
  std::vector<std::uint64_t> out;
  for (const double v : all) out.push_back(std::bit_cast<std::uint64_t>(v));
  return out;
}

TEST(ClockState, StoppedAfterAnyStretchARailGoesOnToTheSameBits) {
  const TemporaryFolder folder;
  for (const auto& [text, mgt] : {std::pair{kElastic, 1.5}, std::pair{kYielding, 1.0}}) {
    Traffic traffic(text, folder.path());
    const ClockResult whole = traffic.run(mgt);
    ASSERT_GE(whole.history.size(), 4u);
    for (const std::size_t stretches : {1, 2}) {
      traffic.stop(mgt, stretches);
      EXPECT_EQ(traffic.read(mgt).out.history.size(), stretches + 1);
      EXPECT_EQ(bits_of(traffic.run(mgt, true)), bits_of(whole)) << stretches;
    }
  }
}

TEST(ClockState, ALaterHorizonGivesTheBitsOfARunInOneGo) {
  const TemporaryFolder folder;
  Traffic traffic(kYielding, folder.path());
  const ClockResult whole = traffic.run(1), half = traffic.run(0.5);
  EXPECT_NEAR(half.reached, 0.5e9, 1);
  EXPECT_EQ(bits_of(traffic.run(0.5, true)), bits_of(half)) << "the same horizon once more";
  EXPECT_EQ(bits_of(traffic.run(1, true)), bits_of(whole));
  EXPECT_NE(traffic.refused(0.1).find("beyond --until"), std::string::npos) << traffic.refused(0.1);
}

TEST(ClockState, NumbersThatAreNoneSurvive) {
  const TemporaryFolder folder;
  Traffic traffic(kElastic, folder.path());
  traffic.stop(12, 1);
  const ClockState state = traffic.read(12);
  EXPECT_TRUE(std::isinf(state.next_grinding));
  EXPECT_TRUE(std::isnan(state.out.history.back().layer_left));
}

TEST(ClockState, AnotherCaseIsRefusedWithTheKeysThatDiffer) {
  const TemporaryFolder folder;
  Traffic traffic(kElastic, folder.path());
  EXPECT_NE(traffic.refused(12).find("nothing to resume"), std::string::npos);
  traffic.stop(12, 0);
  EXPECT_EQ(traffic.refused(12), "");
  EXPECT_EQ(Traffic("[case]\ntitle = \"renamed\"\n" + kElastic, folder.path()).refused(12), "");
  std::string heavier = kElastic;
  heavier.replace(heavier.find("40 kN"), 5, "45 kN");
  EXPECT_NE(Traffic(heavier, folder.path()).refused(12).find("load.1.wheel_load = \"45 kN\" instead of \"40 kN\""),
            std::string::npos)
      << Traffic(heavier, folder.path()).refused(12);
  EXPECT_NE(Traffic(kElastic, folder.path(), 0.5e-3).refused(12).find("--cell = 0.0005 instead of 0.001"),
            std::string::npos);
  const std::string many = Traffic(kYielding, folder.path()).refused(12);
  EXPECT_NE(many.find("passes.ductility = 3.0 instead of nothing"), std::string::npos) << many;
}

TEST(ClockState, AnotherContentOfAProfileIsRefusedWithItsKey) {
  const TemporaryFolder folder;
  const auto identity = [&](double radius) {
    std::string text = "y_mm,z_mm\n";
    for (int y = -20; y <= 20; ++y) text += fmt::format("{},{}\n", y, y * y / (2 * radius));
    write_whole_file(folder.path() / "rail.csv", text);
    write_whole_file(folder.path() / "case.toml", "[geometry]\nrail_profile = \"rail.csv\"\n");
    return clock_identity(load_case(folder.path() / "case.toml"), {});
  };
  write_clock_state(folder.path() / "traffic", identity(80), {});
  EXPECT_NO_THROW(read_clock_state(folder.path() / "traffic", identity(80), 1));
  try {
    read_clock_state(folder.path() / "traffic", identity(81), 1);
    ADD_FAILURE();
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("geometry.rail_profile: a file of other content"), std::string::npos)
        << e.what();
  }
}

TEST(ClockState, ADamagedFileIsRefused) {
  const TemporaryFolder folder;
  Traffic traffic(kElastic, folder.path());
  traffic.stop(12, 0);
  const std::string whole = file_text(traffic.file());
  for (const std::string& bytes : {std::string(), whole.substr(0, whole.size() / 2), "x" + whole}) {
    write_whole_file(traffic.file(), bytes);
    EXPECT_NE(traffic.refused(12).find("cannot be read"), std::string::npos);
  }
}

}  // namespace
}  // namespace railstrata
