// The beam on supports against receptances that were computed independently (121 supports, to 5 digits), and against
// closed forms.
#include "track/beam_receptance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace railstrata {
namespace {

RailBeam beam(double area, double inertia, double density) {
  constexpr double kYoung = 210e9, kShear = kYoung / 2.6, kKappa = 0.40;
  return {kYoung * inertia, kKappa * kShear * area, density * area, density * inertia, 0.01};
}
RailBeam uic60() { return beam(76.70e-4, 3038e-8, 7850); }
RailBeam cn60() { return beam(77.45e-4, 3217e-8, 7830); }

SleeperTrack at_points(std::string_view set) {
  SleeperTrack out = *named_track(set);
  out.pad_length = 0;
  return out;
}

TEST(BeamReceptance, IsThatOfTheTableWithinOnePercent) {
  const std::vector<double> hertz{50, 100, 200, 300, 500, 700, 900, 1067, 1200, 1500, 2000, 3000};
  struct Row {
    std::string_view set;
    RailBeam rail;
    double phase;
    std::vector<double> nm_per_n;
  };
  const std::vector<Row> rows{
      {"delft", uic60(), 0.5, {13.1, 11.5, 2.14, .464, 1.21, 2.13, 4.39, 11.2, 1.90, .600, .255, .101}},
      {"delft", uic60(), 0, {12.8, 11.7, 2.67, 2.02, .177, .487, .985, .430, .0743, .331, .333, .108}},
      {"medium", uic60(), 0.5, {15.1, 9.49, 1.95, 3.47, 3.50, 1.64, 1.16, 3.69, .723, .432, .298, .171}},
      {"medium", uic60(), 0, {14.8, 9.60, 1.89, 2.72, 2.88, 1.30, .766, .274, .424, .438, .302, .172}},
      {"cn60", cn60(), 0.5, {15.9, 16.4, 4.02, 3.03, 1.79, 1.20, .997, 2.47, 1.06, .541, .334, .103}},
      {"cn60", cn60(), 0, {15.6, 16.4, 4.11, 3.03, 1.78, 1.14, .743, .357, .239, .328, .280, .102}}};
  for (const Row& r : rows) {
    SleeperTrack track = at_points(r.set);
    track.phase = r.phase;
    for (std::size_t k = 0; k < hertz.size(); ++k)
      EXPECT_NEAR(1e9 * std::abs(beam_receptance(r.rail, track, 0, hertz[k])), r.nm_per_n[k], 0.01 * r.nm_per_n[k])
          << r.set << " phase " << r.phase << ", " << hertz[k] << " Hz";
  }
}

TEST(BeamReceptance, NearlyAtRestIsTheStaticComplianceOfTheTable) {
  const auto compliance = [](std::string_view set, const RailBeam& rail, double phase) {
    SleeperTrack track = at_points(set);
    track.phase = phase;
    return 1e9 * std::abs(beam_receptance(rail, track, 0, 0.5));
  };
  EXPECT_NEAR(compliance("delft", uic60(), 0.5), 9.74, 0.01 * 9.74);
  EXPECT_NEAR(compliance("delft", uic60(), 0), 9.38, 0.01 * 9.38);
  EXPECT_NEAR(compliance("medium", uic60(), 0.5), 11.7, 0.01 * 11.7);
  EXPECT_NEAR(compliance("cn60", cn60(), 0), 12.7, 0.01 * 12.7);
}

TEST(BeamReceptance, PinnedPinnedFrequenciesAreThoseOfABeamOnPoints) {
  EXPECT_NEAR(pinned_pinned_frequency(uic60(), 0.6), 1067.2, 0.1);
  EXPECT_NEAR(pinned_pinned_frequency(cn60(), 0.6), 1083.3, 0.1);
  EXPECT_NEAR(pinned_pinned_frequency(uic60(), 0.65), 939, 1);
  RailBeam slender = uic60();
  slender.shear *= 1e6;
  slender.rotary *= 1e-6;
  const double euler = std::numbers::pi / (2 * 0.6 * 0.6) * std::sqrt(slender.bending / slender.mass);
  EXPECT_NEAR(pinned_pinned_frequency(slender, 0.6), euler, 1e-4 * euler);
}

// Winkler: 1/(8 B beta^3) + half the shear's part for a beam that is stiff in shear, beta^4 = k/(4 B).
TEST(BeamReceptance, OfCloseSoftSupportsIsWinklers) {
  RailBeam rail = uic60();
  rail.shear *= 1e4;
  SleeperTrack track;
  track.spacing = 0.05;
  track.phase = 0;
  track.pad_length = 0;
  track.pad_stiffness = 1e12;
  track.ballast_stiffness = 50e6 * track.spacing;
  const double beta = std::pow(50e6 / (4 * rail.bending), 0.25);
  const double winkler = 1 / (8 * rail.bending * beta * beta * beta);
  EXPECT_NEAR(std::abs(beam_receptance(rail, track, 0, 0.5, 401)), winkler, 2e-3 * winkler);
}

TEST(BeamReceptance, APadOfALengthHoldsTheSlopeToo) {
  SleeperTrack track = at_points("delft");
  track.phase = 0.5;
  const auto peak = [&] {
    double best = 0, at = 0;
    for (double f = 1040; f < 1120; f += 2)
      if (const double a = std::abs(beam_receptance(uic60(), track, 0, f)); a > best) best = a, at = f;
    return at;
  };
  EXPECT_NEAR(peak(), 1067, 2);
  track.pad_length = 0.15;
  EXPECT_GT(peak(), 1075);
}

}  // namespace
}  // namespace railstrata
