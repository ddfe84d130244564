// Measured receptances: motions of any derivative become displacements, and their difference from each curve is given.
#include "runs/receptance.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <fstream>
#include <numbers>

#include "core/faults.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

MeasuredReceptance read(const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "hammer.csv") << text;
  return read_receptance(folder.path() / "hammer.csv");
}

TEST(MeasuredReceptance, MobilityAndAcceleranceAreDerivatives) {
  const double omega = 2 * std::numbers::pi * 100;
  const MeasuredReceptance displacement = read("frequency [Hz],receptance [nm/N],phase [deg]\n100,2,-60\n");
  EXPECT_TRUE(displacement.has_phase);
  EXPECT_NEAR(std::abs(displacement.values.at(0)), 2e-9, 1e-20);
  EXPECT_NEAR(std::arg(displacement.values.at(0)), -std::numbers::pi / 3, 1e-12);
  const auto same = [&](const std::string& text) {
    const MeasuredReceptance other = read(text);
    EXPECT_NEAR(std::abs(other.values.at(0) - displacement.values.at(0)), 0, 1e-15) << text;
  };
  same(fmt::format("Frequenz [kHz];Admittanz [m/(s N)];phase [deg]\n0,1;{};30\n", 2e-9 * omega));
  same(fmt::format("frequency [Hz],accelerance [1/kg],phase [deg]\n100,{},120\n", 2e-9 * omega * omega));
}

TEST(MeasuredReceptance, IsHeldAgainstEveryCurveInDecibels) {
  Receptance r{{0, 100, 200, 300}, 0, {{"beam_midspan", "beam, midspan", {4e-9, 2e-9, 2e-9, 2e-9}}}};
  r.measured = {read("frequency [Hz],receptance [nm/N]\n150,4\n250,4\n900,1\n")};
  EXPECT_EQ(differences_in_words(r).at(0), "hammer.csv is 6.0 dB from beam, midspan (root mean square)");
}

TEST(MeasuredReceptance, AFaultNamesItsLine) {
  for (const auto& [text, words] : {std::pair{"frequency [Hz],force [N]\n100,2\n", "unknown column"},
                                    std::pair{"frequency [Hz],phase [deg]\n100,2\n", "no columns of frequency and"},
                                    std::pair{"frequency [Hz],receptance [m/N]\n100,0\n", "hammer.csv:2"}})
    try {
      read(text);
      ADD_FAILURE() << "taken: " << text;
    } catch (const CaseError& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
}

}  // namespace
}  // namespace railstrata
