// Materials that change along the sweep, inside a pack and inside a group of elements.
#include <gtest/gtest.h>

#include <cstring>

#include "body/stress.hpp"
#include "tests/body/same_bits.hpp"
#include "tests/body/sample_bodies.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

constexpr int kChange = 29;  // the first element of the second set
const Elastic kOther = elastic(420e9, 0.2, 6000);
const std::vector<Elastic> kBoth{kSteel, kOther};

/// The upper two rows are of the second material from kChange on.
SweptBody changing(SweptBody body) {
  Block& block = body.blocks[0];
  std::vector<int> second = block.section.quad_material;
  for (std::size_t q = 0; q < second.size() / 2; ++q) second[q] = 1;
  block.along.sets = {block.section.quad_material, second};
  for (int e = 0; e < block.stations.elements(); ++e) block.along.of_element.push_back(e < kChange ? 0 : 1);
  return body;
}

/// The set at `element` all along.
SweptBody endless(const SweptBody& body, int element) {
  SweptBody out = body;
  Block& block = out.blocks[0];
  block.section.quad_material = block.along.sets[static_cast<std::size_t>(block.set_of(element))];
  block.along = {};
  return out;
}

Field scattered(const Body& body, double size) {
  Field u = body.layout.field();
  for (const NodeLine& l : body.lines)
    for (int j = 0; j < l.count; ++j) u[l.first + j] = size * scatter(static_cast<std::size_t>(l.first + j));
  return u;
}

class MaterialSets : public ::testing::TestWithParam<SweepKind> {
 protected:
  const SweptBody mesh = changing(distorted_body(GetParam()));
  const Body body{mesh, kBoth, {}};
  const Body before{endless(mesh, 0), kBoth, {}}, after{endless(mesh, kChange), kBoth, {}};
  Field u = scattered(body, 1e-4);

  /// Largest difference from the endless body on its side of the plane of change, over the largest value.
  template <class Make>
  double worst(Make&& make) const {
    const Field mine = make(body), left = make(before), right = make(after);
    double most = 0, difference = 0;
    for (const NodeLine& l : body.lines)
      for (int j = 0; j < l.count; ++j) {
        const std::ptrdiff_t i = l.first + j;
        most = std::max(most, std::abs(mine[i]));
        if (j != kChange) difference = std::max(difference, std::abs(mine[i] - (j < kChange ? left : right)[i]));
      }
    return difference / most;
  }
};

TEST_P(MaterialSets, ForcesStiffnessAndMassAreThoseOfTheEndlessBodyOnEitherSide) {
  EXPECT_LT(worst([&](const Body& b) {
              Field f = b.layout.field(), x = u;
              internal_force(b, x, 0.3, f);
              return f;
            }),
            1e-13);
  EXPECT_LT(worst([&](const Body& b) {
              Field f = b.layout.field(), x = u;
              linear_force(b, x, f);
              return f;
            }),
            1e-13);
  EXPECT_LT(worst([](const Body& b) {
              Field d = b.layout.field();
              stiffness_diagonal(b, d);
              return d;
            }),
            1e-14);
  EXPECT_LT(worst([](const Body& b) { return b.element_mass; }), 1e-14);
}

TEST_P(MaterialSets, StressIsThatOfTheElementsOwnMaterial) {
  const PlasticHistory none = initial_history(body);
  for (int e : {kChange - 1, kChange}) {
    const Sym3 mine = element_stress(body, u, none, 0, 0, e),
               own = element_stress(e < kChange ? before : after, u, none, 0, 0, e),
               other = element_stress(e < kChange ? after : before, u, none, 0, 0, e);
    EXPECT_EQ(mine.xx, own.xx);
    EXPECT_EQ(mine.xz, own.xz);
    EXPECT_NE(mine.xx, other.xx);
  }
}

TEST_P(MaterialSets, ForcesAreTheGradientOfTheEnergy) {
  Field f = body.layout.field(), x = u;
  internal_force(body, x, 0.0, f);
  Field way = scattered(body, 1.0);
  for (std::size_t i = 0; i < way.size(); ++i) way[i] *= scatter(i + 13);
  double power = 0;
  for (const NodeLine& l : body.lines)
    for (int j = 0; j < l.count; ++j) power += f[l.first + j] * way[l.first + j];
  const auto energy = [&](double s) {
    Field at = u;
    for (std::size_t i = 0; i < at.size(); ++i) at[i] += s * way[i];
    const StrainEnergy e = strain_energy(body, at, 0.0);
    return e.strain + e.hourglass;
  };
  const double s = 1e-8;
  EXPECT_NEAR((energy(s) - energy(-s)) / (2 * s), power, 1e-6 * std::abs(power));
}

TEST_P(MaterialSets, ForcesHaveTheSameBitsOnAnyNumberOfThreads) {
  expect_same_bits_on_one_two_and_four_threads([&] {
    Field f = body.layout.field(), x = u;
    internal_force(body, x, 0.3, f);
    std::vector<double> out;
    for (const NodeLine& l : body.lines) out.insert(out.end(), f.begin() + l.first, f.begin() + l.first + l.count);
    return out;
  });
}

INSTANTIATE_TEST_SUITE_P(Kinds, MaterialSets, ::testing::Values(SweepKind::extrude, SweepKind::revolve));

}  // namespace
}  // namespace railstrata
