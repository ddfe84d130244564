// Derivatives of creepages, forces and moment by adjoint systems, against those of all tractions.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "bem/leading_edge.hpp"
#include "half_space_pair.hpp"

namespace railstrata {
namespace {

using Change = std::function<void(TangentialProblem&, double)>;

/// An input, a step of it that hardly changes tractions, and what is a usual change of it.
struct Input {
  std::string name;
  double step, usual;
  Change change;
};

void scale_bound(TangentialProblem& p, double by) {
  for (std::size_t k = 0; k < p.traction_bound.size(); ++k)
    p.traction_bound[k] *= 1 + by * (1 + 0.3 * std::sin(0.1 * static_cast<double>(k)));
}

void change_force(CreepOrForce& direction, double by) {
  (direction.force ? *direction.force : direction.creepage) += by;
}

/// A sum and a hundredth of what it changes with usual changes of inputs.
struct Sum {
  const char* name;
  double TangentialDerivative::*at;
  double least;
};
constexpr Sum kSums[] = {{"force_x", &TangentialDerivative::force_x, 100},
                         {"force_y", &TangentialDerivative::force_y, 100},
                         {"moment", &TangentialDerivative::moment, 0.5},
                         {"creepage_x", &TangentialDerivative::creepage_x, 1e-5},
                         {"creepage_y", &TangentialDerivative::creepage_y, 1e-5}};

const ReferenceContact& contact() {
  static const ReferenceContact out(0.6, 0.9, 0.5e-3);
  return out;
}

TangentialProblem rolling() {
  TangentialProblem p = contact().rolling();
  p.leading_weight = leading_weights(contact().grid, contact().normal);
  p.x.creepage = -1.1e-3;
  p.y.creepage = 0.4e-3;
  p.spin = 0.12;
  return p;
}

void expect_alike(const TangentialProblem& p) {
  const ReferenceContact& c = contact();
  const TangentialSolution s = solve_tangential(c.influence, c.grid, p, {.tolerance = 1e-10});
  EXPECT_GT(s.stick_area, 0.2 * (s.stick_area + s.slip_area));
  EXPECT_GT(s.slip_area, 0.2 * (s.stick_area + s.slip_area));
  const Input inputs[] = {{"x", p.x.force ? 1.0 : 1e-9, p.x.force ? 1e4 : 1e-3,
                           [](TangentialProblem& t, double by) { change_force(t.x, by); }},
                          {"y", p.y.force ? 1.0 : 1e-9, p.y.force ? 1e4 : 1e-3,
                           [](TangentialProblem& t, double by) { change_force(t.y, by); }},
                          {"spin", 1e-7, 0.1, [](TangentialProblem& t, double by) { t.spin += by; }},
                          {"bound", 1e-7, 0.1, scale_bound}};
  TangentialDerivatives all(c.influence, c.grid, p, s), sums(c.influence, c.grid, p, s);
  for (const Input& in : inputs) {
    TangentialProblem more = p, less = p;
    in.change(more, in.step);
    in.change(less, -in.step);
    const TangentialDerivative one = all.by(more, less, in.step), other = sums.sums_by(more, less, in.step);
    EXPECT_TRUE(other.q_x.empty());
    for (const Sum& sum : kSums)
      EXPECT_NEAR(other.*sum.at, one.*sum.at, 1e-5 * std::max(std::abs(one.*sum.at), sum.least / in.usual))
          << sum.name << " by " << in.name;
  }
}

TEST(AdjointDerivatives, OfGivenCreepagesAreThoseOfAllTractions) { expect_alike(rolling()); }

TEST(AdjointDerivatives, OfGivenForcesAreThoseOfAllTractions) {
  TangentialProblem p = rolling();
  p.x.force = -0.2 * ReferenceContact::kLoad;
  expect_alike(p);
  p.y.force = 0.1 * ReferenceContact::kLoad;
  expect_alike(p);
}

TEST(AdjointDerivatives, OfWholeCellsAreThoseOfAllTractions) {
  TangentialProblem p = rolling();
  p.leading_weight.clear();
  expect_alike(p);
}

TEST(AdjointDerivatives, OfFrictionThatIsLessAcrossAreThoseOfAllTractions) {
  TangentialProblem p = rolling();
  p.lateral_share = 0.7;
  expect_alike(p);
  p.y.force = 0.1 * ReferenceContact::kLoad;
  expect_alike(p);
}

TEST(AdjointDerivatives, OfAFilmThatDiffersFromCellToCellAreThoseOfAllTractions) {
  TangentialProblem p = rolling();
  for (std::size_t k = 0; k < contact().grid.size(); ++k) {
    ThirdBody film;
    film.thickness = 10e-6 * (1 + 0.5 * std::sin(0.2 * static_cast<double>(k)));
    film.shear_modulus = 2e9;
    p.film.push_back(film);
  }
  expect_alike(p);
}

}  // namespace
}  // namespace railstrata
