// Derivatives of sums of pressure and tractions by adjoint systems, against differences of solutions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "bem/rolling_derivatives.hpp"
#include "half_space_pair.hpp"

namespace railstrata {
namespace {

using Change = std::function<void(RollingContact&, double)>;

/// An input, a step of its differences, and what is a usual change of it.
struct Input {
  std::string name;
  double step, usual;
  Change change;
};

void change_force(CreepOrForce& direction, double by) {
  (direction.force ? *direction.force : direction.creepage) += by;
}

/// A hollow of the gap that moves sums of both problems.
void deepen(const PatchGrid& grid, RollingContact& c, double by) {
  for (std::size_t k = 0; k < grid.size(); ++k)
    c.gap[k] -= by * (1 + 0.3 * std::sin(400 * grid.x_of(k)) + 50 * grid.y_of(k));
}

/// Normal force, moments of the pressure about both axes, both tractions' forces and their moment.
std::vector<TractionSum> sums_of(const PatchGrid& grid) {
  const Plane area(grid.size(), grid.cell_area());
  Plane x = area, y = area, minus_y = area;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    x[k] *= grid.x_of(k);
    y[k] *= grid.y_of(k);
    minus_y[k] = -y[k];
  }
  return {{area, {}, {}}, {x, {}, {}}, {y, {}, {}}, {{}, area, {}}, {{}, {}, area}, {{}, minus_y, x}};
}

double value_of(const TractionSum& sum, const RollingSolution& s) {
  return (sum.p.empty() ? 0.0 : dot(sum.p, s.normal.pressure)) +
         (sum.q_x.empty() ? 0.0 : dot(sum.q_x, s.tangential.q_x)) +
         (sum.q_y.empty() ? 0.0 : dot(sum.q_y, s.tangential.q_y));
}

/// The pair, its grid and a problem under an approach.
struct Case {
  HalfSpaceMaterial wheel = kSteel, rail = kSteel;
  PatchGrid grid = grid_around(7.5e-3, 6e-3, 0.5e-3, 0.5e-3);
  double film = 0;  ///< m/Pa
  InfluenceOperator influence{pair_of(wheel, rail), grid.nx, grid.ny, grid.dx, grid.dy, film};
  RollingContact contact = [&] {
    RollingContact c;
    c.gap = quadratic_gap(grid, 0.6, 0.9);
    c.target.approach = 35e-6;
    c.friction = 0.4;
    c.x.creepage = -1.1e-3;
    c.y.creepage = 0.4e-3;
    c.spin = 0.12;
    return c;
  }();
};

constexpr RollingOptions kSharp{
    .normal = {.tolerance = 1e-13}, .tangential = {.tolerance = 1e-11}, .coupling_tolerance = 1e-11};

std::vector<Input> inputs_of(const Case& c) {
  const double force = 1e4, creepage = 1e-3;
  return {{"approach", 1e-10, 1e-5, [](RollingContact& t, double by) { *t.target.approach += by; }},
          {"gap", 1e-10, 1e-5, [&c](RollingContact& t, double by) { deepen(c.grid, t, by); }},
          {"x", c.contact.x.force ? 0.1 : 1e-9, c.contact.x.force ? force : creepage,
           [](RollingContact& t, double by) { change_force(t.x, by); }},
          {"y", c.contact.y.force ? 0.1 : 1e-9, c.contact.y.force ? force : creepage,
           [](RollingContact& t, double by) { change_force(t.y, by); }},
          {"spin", 1e-7, 0.1, [](RollingContact& t, double by) { t.spin += by; }},
          {"friction", 1e-7, 0.1, [](RollingContact& t, double by) {
             t.friction += by;
             for (double& f : t.local_friction) f += by;
           }}};
}

/// Sums, then creepages.
std::vector<double> numbers_at(const Case& c, const Input& in, double by, const std::vector<TractionSum>& sums) {
  RollingContact there = c.contact;
  in.change(there, by);
  const RollingSolution s = solve_rolling(c.influence, c.grid, there, kSharp);
  std::vector<double> out;
  for (const TractionSum& sum : sums) out.push_back(value_of(sum, s));
  out.push_back(s.tangential.creepage_x);
  out.push_back(s.tangential.creepage_y);
  return out;
}

/// Sums and creepages: how far each derivative lies outside of the differences to both sides, over what counts.
std::vector<double> wrong_by(const Case& c, const Input& in, double step, const std::vector<double>& slopes) {
  constexpr double kLeast[] = {100, 0.5, 0.5, 100, 100, 0.5, 1e-5, 1e-5};  // a hundredth of usual changes
  const std::vector<TractionSum> sums = sums_of(c.grid);
  const auto here = numbers_at(c, in, 0, sums), up = numbers_at(c, in, step, sums),
             down = numbers_at(c, in, -step, sums);
  std::vector<double> out;
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    const double above = (up[k] - here[k]) / step, below = (here[k] - down[k]) / step,
                 nearest = std::clamp(slopes[k], std::min(above, below), std::max(above, below));
    out.push_back(std::abs(slopes[k] - nearest) / std::max(std::abs(nearest), kLeast[k] / in.usual));
  }
  return out;
}

/// Within 1e-4 of differences, or between those of both sides, where a cell changes its state; two such changes on both
/// sides are told apart by smaller steps.
void expect_differences(const Case& c) {
  constexpr double kClose = 1e-4;
  const RollingSolution s = solve_rolling(c.influence, c.grid, c.contact, kSharp);
  EXPECT_GT(s.tangential.stick_area, 0.1 * (s.tangential.stick_area + s.tangential.slip_area));
  EXPECT_GT(s.tangential.slip_area, 0.1 * (s.tangential.stick_area + s.tangential.slip_area));
  const RollingDerivatives derivatives(c.influence, c.grid, c.contact, s, sums_of(c.grid));
  for (const Input& in : inputs_of(c)) {
    RollingContact more = c.contact, less = c.contact;
    in.change(more, in.step);
    in.change(less, -in.step);
    const RollingSlopes found = derivatives.by(more, less, in.step);
    std::vector<double> slopes = found.sums;
    slopes.insert(slopes.end(), {found.creepage_x, found.creepage_y});
    std::vector<double> wrong(slopes.size(), 1);
    for (const double longer : {10.0, 3.0, 1.0}) {
      const std::vector<double> now = wrong_by(c, in, longer * in.step, slopes);
      for (std::size_t k = 0; k < wrong.size(); ++k) wrong[k] = std::min(wrong[k], now[k]);
      if (*std::max_element(wrong.begin(), wrong.end()) < kClose) break;
    }
    for (std::size_t k = 0; k < wrong.size(); ++k) EXPECT_LT(wrong[k], kClose) << "number " << k << " by " << in.name;
  }
}

TEST(AdjointDerivatives, AreThoseOfNewSolutions) { expect_differences(Case{}); }

TEST(AdjointDerivatives, OfUnlikeBodiesAreThoseOfNewSolutions) {
  expect_differences(Case{.rail = {100e9, 0.15}});
  expect_differences(Case{.wheel = {70e9, 0.4}});
}

TEST(AdjointDerivatives, OfGivenForcesAreThoseOfNewSolutions) {
  for (const HalfSpaceMaterial& rail : {kSteel, HalfSpaceMaterial{100e9, 0.15}}) {
    Case c{.rail = rail};
    c.contact.x.force = -2e3;
    expect_differences(c);
    c.contact.y.force = 1e3;
    expect_differences(c);
  }
}

TEST(AdjointDerivatives, OfWholeCellsAreThoseOfNewSolutions) {
  Case c{.rail = {100e9, 0.15}};
  c.contact.leading_edge = LeadingEdge::whole_cell;
  expect_differences(c);
}

TEST(AdjointDerivatives, OfFrictionThatIsLessAcrossAndDiffersAreThoseOfNewSolutions) {
  Case c{.rail = {100e9, 0.15}};
  c.contact.lateral_share = 0.7;
  c.contact.x.creepage = -0.4e-3;
  c.contact.y.creepage = 0.1e-3;
  for (std::size_t k = 0; k < c.grid.size(); ++k) c.contact.local_friction.push_back(0.4 + 20 * c.grid.y_of(k));
  expect_differences(c);
  c.contact.y.force = 1e3;
  expect_differences(c);
}

TEST(AdjointDerivatives, WithAFilmAreThoseOfNewSolutions) {
  ThirdBody film;
  film.thickness = 10e-6;
  film.shear_modulus = 2e9;
  Case c{.film = film.flexibility()};
  c.contact.third_body = film;
  expect_differences(c);
}

}  // namespace
}  // namespace railstrata
