#include "steady/plastic_strain_response.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/parallel.hpp"

namespace railstrata {
namespace {

RowModuli moduli(double young, double poisson) {
  return {young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

SteadyGrid grid(int nx, int ny, int rows) {
  SteadyGrid g{
      .nx = nx, .ny = ny, .dx = 8. / nx, .dy = ny > 1 ? 6. / ny : 0, .front = 4, .y0 = -3, .active = 1, .hold = 1};
  g.thickness.assign(static_cast<std::size_t>(rows), 1.5 / rows);
  return g;
}

/// Symmetric gradient of u = curl (A_x, A_y, 0), A = (sin kx sin(ly + .3), cos kx cos ly) (1 - z/D)^3, D = 1.5: no
/// change of volume, nothing below D.
std::array<double, 6> compatible(double x, double y, double z, bool plane) {
  const double k = std::numbers::pi / 4, l = plane ? 0 : std::numbers::pi / 3, s = 1 - z / 1.5;
  const double f = s * s * s, f1 = -2 * s * s, f2 = 8. / 3 * s;
  const double cx = std::cos(k * x), sx = std::sin(k * x), cy = std::cos(l * y), sy = std::sin(l * y);
  const double w = plane ? 0 : 1, c3 = w * std::cos(l * y + .3), s3 = w * std::sin(l * y + .3);
  // u_x = -cx cy f', u_y = sx s3 f', u_z = -k sx cy f - l sx c3 f
  return {k * sx * cy * f1,
          l * sx * c3 * f1,
          -(k * cy + l * c3) * sx * f1,
          0.5 * (l * cx * sy * f1 + k * cx * s3 * f1),
          0.5 * (sx * s3 * f2 + sx * f * (k * l * sy + l * l * s3)),
          0.5 * (-cx * cy * f2 - k * cx * f * (k * cy + l * c3))};
}

/// Largest deviation of the answer from the compatible plastic strain itself, over its largest.
double deviation(int nx, int ny, int rows, RowModuli top) {
  const SteadyGrid g = grid(nx, ny, rows);
  std::vector<RowModuli> m(static_cast<std::size_t>(rows), moduli(210e9, .3));
  for (int r = 0; r < rows / 3; ++r) m[r] = top;
  const PlasticStrainResponse response(g, m, moduli(210e9, .3));
  Field field(g.size());
  const auto each = [&](auto&& at) {
    for (int r = 0; r < rows; ++r)
      for (int i = 0; i < nx; ++i)
        for (int j = 0; j < ny; ++j) {
          const auto e = compatible(g.x(i), g.y(j), g.depth(r), ny == 1);
          for (int c = 0; c < 6; ++c) at(field[g.index(c, r, i, j)], e[c]);
        }
  };
  double largest = 0, worst = 0;
  each([&](double& value, double e) {
    value = e;
    largest = std::max(largest, std::abs(e));
  });
  response.apply(field);
  each([&](double value, double e) { worst = std::max(worst, std::abs(value - e)); });
  return worst / largest;
}

TEST(PlasticStrainResponse, CompatiblePlasticStrainLeavesNoStressWithTheSecondPowerOfTheCells) {
  for (const double young : {210e9, 600e9}) {
    const double coarse = deviation(32, 24, 9, moduli(young, .25)), fine = deviation(64, 48, 18, moduli(young, .25));
    EXPECT_LT(fine, 0.01);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.25) << young;
  }
}

TEST(PlasticStrainResponse, OneColumnIsPlaneStrain) {
  const double coarse = deviation(32, 1, 9, moduli(600e9, .25)), fine = deviation(64, 1, 18, moduli(600e9, .25));
  EXPECT_LT(fine, 0.01);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.25);
}

TEST(PlasticStrainResponse, UniformPlasticStrainOfALayerLeavesItsClosedFormStress) {
  // endless along x and y: e_xx = e_yy = 0, S_zz = S_xz = 0, so that E_zz = E^p_zz + lambda/(lambda + 2 mu) (E^p_xx +
  // E^p_yy) and E_xz = E^p_xz
  const SteadyGrid g = grid(16, 4, 6);
  const RowModuli m = moduli(210e9, .3);
  const PlasticStrainResponse response(g, std::vector<RowModuli>(6, m), m);
  const std::array<double, 6> plastic = {1e-3, -4e-4, -6e-4, 2e-4, 3e-4, -5e-4};
  Field field(g.size());
  for (int c = 0; c < 6; ++c)
    for (int r = 0; r < 3; ++r)
      for (int i = 0; i < g.nx; ++i)
        for (int j = 0; j < g.ny; ++j) field[g.index(c, r, i, j)] = plastic[c];
  response.apply(field);
  const std::array<double, 6> expected = {0, 0, -6e-4 + .3 / .7 * 6e-4, 0, 3e-4, -5e-4};
  for (int c = 0; c < 6; ++c) {
    EXPECT_NEAR(field[g.index(c, 1, 3, 2)], expected[c], 1e-15);
    EXPECT_NEAR(field[g.index(c, 4, 3, 2)], 0, 1e-15);
  }
}

TEST(PlasticStrainResponse, RowsThatDoNotCountChangeNothingInTheOthers) {
  const SteadyGrid g = grid(16, 8, 6);
  const RowModuli m = moduli(210e9, .3);
  const PlasticStrainResponse response(g, std::vector<RowModuli>(6, m), m);
  Field all(g.size()), some(g.size(), 7);
  const std::vector<bool> rows{true, false, true, true, false, false};
  for (int c = 0; c < 6; ++c)
    for (int r = 0; r < 6; ++r)
      for (int i = 0; rows[static_cast<std::size_t>(r)] && i < g.nx; ++i)
        for (int j = 0; j < g.ny; ++j)
          all[g.index(c, r, i, j)] = some[g.index(c, r, i, j)] = std::sin(c + 2 * i + 3 * j);
  response.apply(all);
  response.apply(some, nullptr, rows);
  for (int c = 0; c < 6; ++c)
    for (int r = 0; r < 6; ++r)
      for (int i = 0; i < g.nx; ++i)
        for (int j = 0; j < g.ny; ++j)
          if (const std::size_t at = g.index(c, r, i, j); rows[static_cast<std::size_t>(r)])
            EXPECT_NEAR(some[at], all[at], 1e-13);
          else
            EXPECT_EQ(some[at], 7) << "left as it was";
}

/// Displacement of a half-plane's surface at 0 by plastic strain in a rectangle: u_i = integral of E^p : S_i, S_i the
/// stress of a unit line load along i at that place (Flamant). Normal: E^p_tt = -E^p_zz = 1; shear: E^p_tz = 1.
struct OfRectangle {
  double t0, t1, z0, z1;
  double sum(double shift, double (*corner)(double, double)) const {
    const auto at = [&](double t, double z) { return corner(t + shift, z) / std::numbers::pi; };
    return at(t1, z1) - at(t0, z1) - at(t1, z0) + at(t0, z0);
  }
  /// Beside it all its images in a period; less the same at the origin.
  double periodic(double place, double period, double (*corner)(double, double)) const {
    double out = 0;
    for (int m = -1000; m <= 1000; ++m) out += sum(m * period - place, corner) - sum(m * period, corner);
    return out;
  }
};
double normal_down(double t, double z) { return t * std::log(t * t + z * z); }
double normal_along(double t, double z) { return -z * std::log(t * t + z * z); }
double shear_down(double t, double z) { return 2 * (z - t * std::atan2(z, t)); }
double shear_along(double t, double z) { return 2 * (t - z * std::atan(t / z)); }

/// Largest deviation of the surface from the closed form over its largest, along x (with one column) or along y (with
/// one station): along and down, by normal and by shear strain.
std::array<double, 4> surface_deviation(int cells, int rows, bool across) {
  const double period = across ? 6 : 8;
  SteadyGrid g = grid(across ? 1 : cells, across ? cells : 1, rows);
  if (!across) g.dx = period / cells;
  const RowModuli m = moduli(210e9, .3);
  const PlasticStrainResponse response(g, std::vector<RowModuli>(static_cast<std::size_t>(rows), m), m);
  const auto place = [&](int n) { return across ? g.y(n) : g.x(n); };
  const auto index = [&](int c, int r, int n) { return g.index(c, r, across ? 0 : n, across ? n : 0); };
  const OfRectangle rectangle{-0.5, 1, 0.5, 1};
  std::array<double, 4> out{};
  for (const bool shear : {false, true}) {
    Field field(g.size()), surface;
    for (int r = rows / 3; r < 2 * rows / 3; ++r)
      for (int n = 0; n < cells; ++n) {
        // the cell's share of the rectangle
        const double h = period / cells,
                     inside = std::clamp(
                         (std::min(place(n) + 0.5 * h, rectangle.t1) - std::max(place(n) - 0.5 * h, rectangle.t0)) / h,
                         0., 1.);
        if (shear) {
          field[index(across ? 4 : 5, r, n)] = inside;
        } else {
          field[index(across ? 1 : 0, r, n)] = inside;
          field[index(2, r, n)] = -inside;
        }
      }
    response.apply(field, &surface);
    for (const bool down : {false, true}) {
      const auto corner = shear ? (down ? shear_down : shear_along) : (down ? normal_down : normal_along);
      const std::size_t plane = down ? 2 : (across ? 1 : 0);
      const auto found = [&](int n) { return surface[plane * g.plane() + static_cast<std::size_t>(n)]; };
      double mean = 0, worst = 0, largest = 0;
      std::vector<double> exact;
      for (int n = 0; n < cells; ++n) {
        exact.push_back(rectangle.periodic(place(n), period, corner));
        mean += (exact.back() - found(n)) / cells;
      }
      for (int n = 0; n < cells; ++n) {
        worst = std::max(worst, std::abs(exact[n] - mean - found(n)));
        largest = std::max(largest, std::abs(exact[n] - exact[0]));
      }
      out[2 * shear + down] = worst / largest;
    }
  }
  return out;
}

TEST(PlasticStrainResponse, SurfaceOfAHalfPlaneFollowsAYieldedStripWithTheSecondPowerOfTheCells) {
  for (const bool across : {false, true}) {
    const auto coarse = surface_deviation(96, 18, across), fine = surface_deviation(192, 36, across);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_LT(fine[k], 0.01) << across << k;
      EXPECT_GT(std::log2(coarse[k] / fine[k]), 1.75) << across << k << " " << fine[k];
    }
  }
}

TEST(PlasticStrainResponse, IsTheSameToTheBitForOneAndTwoThreads) {
  const SteadyGrid g = grid(24, 16, 5);
  const RowModuli m = moduli(210e9, .3);
  const PlasticStrainResponse response(g, std::vector<RowModuli>(5, m), m);
  Field one(g.size());
  for (std::size_t n = 0; n < one.size(); ++n) one[n] = std::sin(1.7 * static_cast<double>(n));
  Field two = one;
  const int threads = max_threads();
  set_threads(1);
  response.apply(one);
  set_threads(2);
  response.apply(two);
  set_threads(threads);
  EXPECT_TRUE(one == two);
}

}  // namespace
}  // namespace railstrata
