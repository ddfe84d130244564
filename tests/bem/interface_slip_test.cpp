// Slip of an interface of the rail's layers that slides where its shear exceeds a limit.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <numbers>

#include "bem/interface_slip.hpp"
#include "bem/subsurface.hpp"
#include "crack/dislocation.hpp"
#include "half_space_pair.hpp"
#include "model/model.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

constexpr double kDepth = 3e-3, kHalf = 5e-3, kPressure = 1e9, kTraction = 0.25;

LayeredHalfSpace one_metal(const Bond& bond = {}) {
  return {{{.thickness = kDepth, .material = kSteel, .bond = bond}}, kSteel};
}

/// Even cells around the middle, and the tractions of an elliptic pressure on them.
struct Loaded {
  PatchGrid grid;
  Plane p, q, none;
  Loaded(int nx, int ny, double cell, bool line) : grid(centred_grid(nx / 2, ny / 2, cell, cell)) {
    grid.nx = nx;
    grid.ny = line ? 1 : ny;
    grid.line = line;
    if (line) {
      grid.dy = 1;
      grid.y0 = 0;
    }
    p = q = none = Plane(grid.size(), 0.0);
    for (std::size_t k = 0; k < grid.size(); ++k) {
      const double r = std::hypot(grid.x_of(k), line ? 0 : grid.y_of(k)) / kHalf;
      p[k] = r < 1 ? kPressure * std::sqrt(1 - r * r) : 0;
    }
    // the same load on all cells
    const double load = (line ? 0.5 : 2 * kHalf / 3) * std::numbers::pi * kHalf * kPressure;
    scale_by(p, load / (sum(p) * grid.cell_area()));
    for (std::size_t k = 0; k < grid.size(); ++k) q[k] = kTraction * p[k];
  }
  InterfaceLoad at_interface(const LayeredHalfSpace& body) const {
    const StatePlane plane = Subsurface(body, grid, p, q, none).plane(kDepth);
    InterfaceLoad out{{plane.s_xz, plane.s_yz}, plane.s_zz};
    scale_by(out.pressure, -1);
    return out;
  }
};

int cells_of(double length, double cell) { return good_fft_length(static_cast<int>(length / cell)); }

double product(const PlanePair& a, const PlanePair& b) { return dot(a.x, b.x) + dot(a.y, b.y); }

/// Change over a cell, from the one behind to the one ahead.
Plane over_a_cell(const PatchGrid& g, const Plane& v) {
  Plane out(v.size(), 0.0);
  const auto row = static_cast<std::size_t>(g.ny);
  for (std::size_t k = row; k + row < v.size(); ++k) out[k] = 0.5 * (v[k + row] - v[k - row]);
  return out;
}

// A wave of slip is a row of dislocations: the closed form of a glide dislocation below a free surface.
TEST(InterfaceWaves, OfALineMeetDislocationsBelowAFreeSurface) {
  const double cell = 0.25e-3;
  const Loaded l(cells_of(80e-3, cell), 1, cell, true);
  const InterfaceWaves waves(one_metal(), 0, l.grid);
  PlanePair slip{l.none, l.none};
  constexpr double kLength = 4e-3, kSlip = 1e-6;
  for (int i = 0; i < l.grid.nx; ++i)
    slip.x[static_cast<std::size_t>(i)] = kSlip * std::exp(-std::pow(l.grid.x(i) / kLength, 2));
  const PlanePair shear = waves.shear(slip);
  const Plane pressure = waves.pressure(slip);
  for (const double at : {0.0, 2e-3, 5e-3, 9e-3}) {
    const auto k = static_cast<std::size_t>(std::lround((at - l.grid.x0) / cell));
    PlaneStress exact;
    constexpr double kStep = 0.01e-3;
    for (double x = -30e-3 + 0.5 * kStep; x < 30e-3; x += kStep) {  // the field's own place lies between two of them
      const double slope = -2 * x / (kLength * kLength) * kSlip * std::exp(-std::pow(x / kLength, 2));
      const std::complex<double> here(l.grid.x_of(k), kDepth), from(x, kDepth), jump(slope * kStep, 0);
      const PlaneStress whole = whole_plane_stress(kSteel, here, from, jump),
                        image = image_stress(kSteel, here, from, jump);
      exact.xz += whole.xz + image.xz;
      exact.zz += whole.zz + image.zz;
    }
    const double sign = exact.xz * shear.x[k] > 0 ? 1 : -1;  // which side a dislocation moves
    EXPECT_NEAR(shear.x[k], sign * exact.xz, 2e-3 * std::abs(shear.x[l.grid.index(l.grid.nx / 2, 0)])) << at;
    EXPECT_NEAR(pressure[k], -sign * exact.zz, 2e-3 * std::abs(shear.x[l.grid.index(l.grid.nx / 2, 0)])) << at;
  }
}

TEST(InterfaceWaves, SpringsBoundWhatSlipTakes) {
  const Loaded l(64, 64, 0.5e-3, false);
  constexpr double kSpring = 5e12;
  const InterfaceWaves bonded(one_metal(), 0, l.grid), springs(one_metal({0, 1 / kSpring}), 0, l.grid);
  EXPECT_LT(springs.stiffest(), kSpring);
  EXPECT_GT(springs.stiffest(), 0.9 * kSpring);
  EXPECT_NEAR(InterfaceWaves(one_metal({0, 1e-22}), 0, l.grid).stiffest() / bonded.stiffest(), 1, 1e-6);
}

/// Shear per slip in plane strain, cell by cell: dislocations at both ends of every cell. The first cell has no end
/// behind: what is left there goes on.
Eigen::MatrixXd dislocation_stiffness(const std::vector<double>& x, double cell) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd out(n, n);
  const auto shear_at = [](double distance) {
    const std::complex<double> at(distance, kDepth), from(0, kDepth), jump(1, 0);
    return whole_plane_stress(kSteel, at, from, jump).xz + image_stress(kSteel, at, from, jump).xz;
  };
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const double d = x[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(j)];
      out(i, j) = (j > 0 ? shear_at(d + 0.5 * cell) : 0) - shear_at(d - 0.5 * cell);
    }
  return out(1, 1) < 0 ? out : Eigen::MatrixXd(-out);
}

// Its own method in all: dislocations in place of waves, relaxation cell by cell in place of alternating directions. In
// plane strain the slip that stays goes on changing far behind, which depends on the period: it is not compared.
TEST(InterfaceMarch, OfALineMeetsDislocationsThatRelaxCellByCell) {
  const double cell = 0.5e-3, limit = 180e6;
  const Loaded l(cells_of(100e-3, cell), 1, cell, true);
  const int border = 10;
  const InterfaceLoad load = l.at_interface(one_metal());
  InterfaceMarch march(InterfaceWaves(one_metal(), 0, l.grid), {limit, 0}, border);
  const InterfacePassage passage = march.pass(load);

  std::vector<double> x;
  for (int i = border; i < l.grid.nx - border; ++i) x.push_back(l.grid.x(i));
  const Eigen::MatrixXd stiff = dislocation_stiffness(x, cell);
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::VectorXd slip = Eigen::VectorXd::Zero(n), before(n);
  double work = 0;
  for (Eigen::Index step = 0; step < n; ++step) {
    before << slip.tail(n - 1), 0;
    slip[0] = before[0];
    for (int sweep = 0; sweep < 30; ++sweep)
      for (Eigen::Index i = 1; i < n; ++i) {
        const double other = load.shear.x[static_cast<std::size_t>(i + border)] + stiff.row(i).dot(slip) -
                             stiff(i, i) * (slip[i] - before[i]);
        slip[i] = before[i] + (std::abs(other) > limit ? (other - std::copysign(limit, other)) / -stiff(i, i) : 0);
      }
    work = limit * (slip - before).cwiseAbs().sum();
  }
  EXPECT_NEAR(passage.largest / slip.cwiseAbs().maxCoeff(), 1, 0.02);
  EXPECT_NEAR(passage.work / work, 1, 0.02);
}

// The work that the loads lose: what the surface does below them, of their own slip.
TEST(InterfaceMarch, FrictionAndWhatIsStoredBehindTakeTheWorkOfTheLoads) {
  const double cell = 0.5e-3;
  const Loaded l(96, 80, cell, false);
  const InterfaceLoad load = l.at_interface(one_metal());
  InterfaceMarch march(InterfaceWaves(one_metal(), 0, l.grid), {100e6, 0}, 18);
  double stored_ahead = 0;
  for (int passage = 0; passage < 3; ++passage) {
    const InterfacePassage p = march.pass(load);
    const std::array<Plane, 3> moves = march.waves().surface(march.slip());
    const double by_loads =
        -(dot(l.p, over_a_cell(l.grid, moves[2])) + dot(l.q, over_a_cell(l.grid, moves[0]))) * l.grid.dy;
    PlanePair strip{l.none, l.none};  // what is left behind, everywhere
    const PlanePair left = march.left();
    for (std::size_t k = 0; k < l.grid.size(); ++k) {
      strip.x[k] = left.x[k % static_cast<std::size_t>(l.grid.ny)];
      strip.y[k] = left.y[k % static_cast<std::size_t>(l.grid.ny)];
    }
    const double stored = -0.5 * product(strip, march.waves().shear(strip)) * l.grid.dy / l.grid.nx;
    EXPECT_NEAR((p.work + stored - stored_ahead) / by_loads, 1, 0.03) << passage;
    EXPECT_LE(p.shear, 100e6 * (1 + 1e-9));
    stored_ahead = stored;
    march.turn_to_next();
  }
}

TEST(InterfaceMarch, WithoutALimitIsSmoothAndWithAHighOneSticks) {
  const Loaded l(60, 60, 0.5e-3, false);
  const InterfaceLoad load = l.at_interface(one_metal());
  InterfaceMarch sticks(InterfaceWaves(one_metal(), 0, l.grid), {2e9, 0}, 2);
  EXPECT_EQ(sticks.pass(load).largest, 0);
  InterfaceMarch smooth(InterfaceWaves(one_metal(), 0, l.grid), {0, 0}, 2);
  const InterfacePassage p = smooth.pass(load);
  EXPECT_LT(p.shear, 2e-3 * peak(load.shear.x));
  EXPECT_NEAR(p.work, 0, 1e-2);
}

TEST(InterfaceMarch, ChangesLittleWithCellsAndPadding) {
  const auto passage = [](double along, double across, double cell) {
    const Loaded l(cells_of(along, cell), cells_of(across, cell), cell, false);
    InterfaceMarch march(InterfaceWaves(one_metal(), 0, l.grid), {100e6, 0.1}, static_cast<int>(9e-3 / cell));
    return march.pass(l.at_interface(one_metal()));
  };
  const InterfacePassage usual = passage(46e-3, 34e-3, 1e-3);
  const auto near = [&](const InterfacePassage& other, double share) {
    EXPECT_NEAR(other.largest / usual.largest, 1, share);
    EXPECT_NEAR(other.left / usual.left, 1, share);
    EXPECT_NEAR(other.work / usual.work, 1, share);
    EXPECT_NEAR(other.shear / usual.shear, 1, share);
  };
  near(passage(64e-3, 46e-3, 1e-3), 0.02);
  near(passage(46e-3, 34e-3, 0.5e-3), 0.06);
}

/// A clad rail under a driven wheel.
ContactOverInterface over_clad(const ShearLimit& limit) {
  CaseSpec spec;
  spec.geometry.rail_profile = "flat";
  spec.geometry.wheel_profile = "arc:R=430 mm";
  spec.geometry.cant = 0;
  spec.layers.resize(1);
  spec.layers[0].thickness = kDepth;
  spec.layers[0].material.young = 1.2 * spec.rail_material.young;
  const Placement placement = place(spec, {});
  BemOptions options;
  options.cell = 1e-3;
  return solve_over_interface({0, kDepth, limit}, options,
                              [&](const BemOptions& how) { return solve_bem(spec, placement, how); });
}

TEST(InterfaceSlip, BelowAHighLimitIsThatOfAnElasticInterfaceToTheSameBits) {
  const ContactOverInterface high = over_clad({9e9, 0});
  ASSERT_EQ(high.slip.passages.size(), 1u);
  EXPECT_EQ(high.slip.passages[0].largest, 0);
  const ContactOverInterface slides = over_clad({60e6, 0.2});
  EXPECT_LT(slides.contact.patch.largest_pressure, 0.995 * high.contact.patch.largest_pressure);
  EXPECT_NEAR(slides.contact.force.z / high.contact.force.z, 1, 1e-4);
}

TEST(InterfaceSlip, OfPassagesDiesOutUnderResidualShear) {
  const InterfaceSlip slip = over_clad({60e6, 0.2}).slip;
  ASSERT_TRUE(slip.repeats);
  EXPECT_GT(slip.passages.front().left, 5e-6);
  EXPECT_LT(slip.passages.back().left, 0.02 * slip.passages.front().left);
  EXPECT_GT(slip.passages.back().work, 10);
}

}  // namespace
}  // namespace railstrata
