// The stress cycles of a contact band that holds a Hertz contact's exact stress at its centres and surface nodes.
#include <gtest/gtest.h>

#include "damage/shakedown.hpp"
#include "fatigue/shakedown_summary.hpp"
#include "result/stress_cycles.hpp"
#include "single_track/history_stress.hpp"
#include "tests/damage/hertz_stress.hpp"
#include "tests/fem/small_rolling.hpp"

namespace railstrata {
namespace {

constexpr double kA = 6e-3, kElement = 1.2e-3;  // a fifth of the patch's half-length

/// z of the model frame points up.
Sym3 in_model_frame(Sym3 s) {
  s.xz = -s.xz;
  s.yz = -s.yz;
  return s;
}

/// Circular patch in full slip, p0 = 1 Pa; the axle `offset` elements beyond a station.
struct HertzBand {
  RollingSystem system;
  BandStress band;
  ContactField field;
  std::vector<Sym3> surface;

  HertzBand(double friction, double offset) : system(fem_checks::small_system(spec())) {
    const SweptBody& rail = system.model.rail;
    const testing::HertzLoad load{.a = kA, .b = kA, .friction = friction};
    BandSample s;
    s.columns = rail.contact.columns;
    s.rows = rail.contact.rows;
    s.stations = 2 * kReach;
    for (int j = 0; j <= s.stations; ++j) s.along.push_back(kElement * (j - kReach + offset));
    const double contact_y = system.model.placement.contact.point.y - rail.origin.y;
    band = band_stress(rail, s, contact_y);
    std::vector<Sym3>& stress = band.sample.stress;
    stress.resize(static_cast<std::size_t>(s.columns) * s.rows * s.stations);
    for (int r = 0; r < s.rows; ++r) {
      std::vector<Vec3> points;
      for (int j = 0; j < s.stations; ++j)
        for (const double y : band.centre_y) points.push_back({band.x(j), y - contact_y, band.centre_depth[r]});
      const std::vector<Sym3> found = load.stresses(points);
      for (std::size_t k = 0; k < found.size(); ++k)
        stress[(k / s.columns * s.rows + r) * s.columns + k % s.columns] = in_model_frame(found[k]);
    }
    add_surface(load, contact_y);
  }

  StressHistory cycles() const { return band_cycles(band, {surface, field, 0.3, 0}); }

 private:
  static constexpr int kReach = 10;
  static CaseSpec spec() {
    CaseSpec s = fem_checks::small_case();
    s.mesh.element_size = kElement;
    s.mesh.fine_width = 24e-3;
    s.mesh.fine_depth = 9.6e-3;
    return s;
  }
  void add_surface(const testing::HertzLoad& load, double contact_y) {
    const SweptBody& rail = system.model.rail;
    const auto& nodes = rail.blocks[rail.contact.block].section.nodes;
    field.resize(band.sample.columns + 1, band.sample.stations + 1);
    std::vector<Vec3> points;
    for (int i = 0; i < field.size(); ++i) {
      field.x[i] = band.sample.along[i / field.columns];
      field.y[i] = rail.origin.y + nodes[i % field.columns].y;
      points.push_back({field.x[i], nodes[i % field.columns].y - contact_y, 0});
      field.p[i] = std::sqrt(std::max(0.0, 1 - (points[i].x * points[i].x + points[i].y * points[i].y) / (kA * kA)));
      field.q_x[i] = load.friction * field.p[i];
      if (field.p[i] > 0) field.state[i] = ContactState::slip;
    }
    for (const Sym3& s : load.stresses(points)) surface.push_back(in_model_frame(s));
  }
};

}  // namespace

// docs/damage-verification.md, p0/k: elements of a fifth of the half-length see limits that are decided in depth.
TEST(SlowBandCycles, OfACircularContactGiveTheFactorsOfItsExactStress) {
  struct Row {
    double friction, offset, first_yield, wandering, track, upper;
  };
  for (const Row& row : {Row{0, 0, 2.795, 4.632, 4.675, 4.677}, Row{0.2, 0.4, 2.717, 3.683, 4.29, 4.584}}) {
    const HertzBand hertz(row.friction, row.offset);
    const StressHistory history = hertz.cycles();
    const std::vector<double> k(history.depth.size(), 1.0), none(history.depth.size(), 0.0);
    const Shakedown found = shakedown({history, k, none, none});
    EXPECT_NEAR(found.first_yield.value / row.first_yield, 1, 0.02) << row.friction;
    EXPECT_NEAR(found.wandering.value / row.wandering, 1, 0.02) << row.friction;
    EXPECT_NEAR(found.upper.value / row.upper, 1, 0.02) << row.friction;
    const double track = one_track(found, [&] { return single_track_input(history, k, kA, kA); });
    EXPECT_NEAR(track / row.track, 1, 0.025) << row.friction;
  }
}

}  // namespace railstrata
