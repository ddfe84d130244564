// The history of elements: trials leave it alone, commits advance that of every element once.
#include <gtest/gtest.h>

#include "body/traversal_kernel.hpp"
#include "tests/body/same_bits.hpp"
#include "tests/body/sample_bodies.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

/// Elastic; counts its updates and keeps the largest dilatation, which softens nothing.
struct RecordingLaw {
  template <class Real>
  using Parameters = MaterialParameters<Real>;
  static constexpr int kHistory = 2;  // updates, largest dilatation

  template <class T, class Real>
  static void stress(const Parameters<Real>& p, const T (&strain)[6], const T*, T (&stress)[6]) {
    elastic_stress(p.lambda, p.mu, strain, stress);
  }
  template <class T, class Real>
  static void update(const Parameters<Real>& p, const T (&strain)[6], T* history, T (&stress)[6]) {
    const T dilatation = strain[0] + strain[1] + strain[2];
    history[0] += ScalarOf<T>(1);
    history[1] = dilatation > history[1] ? dilatation : history[1];
    elastic_stress(p.lambda, p.mu, strain, stress);
  }
  template <class T, class Real>
  static void tangent_stress(const Parameters<Real>& p, const T (&strain)[6], T (&stress)[6]) {
    elastic_stress(p.lambda, p.mu, strain, stress);
  }
};
using RecordingHex = SweptHex<RecordingLaw>;

/// Body, state and traversal of the recording element.
struct Recording {
  explicit Recording(const SweptBody& mesh, Precision precision = Precision::double_precision)
      : body(mesh, {kSteel}, {ElementKind::full, 0.05, precision}),
        state(body, RecordingHex::kHistory),
        elements(body),
        layout(body.layout, body.mesh, RecordingHex::kHistory) {}
  double history(int quad, int entry, int element) const {
    return state.history[layout.first(0, quad) + entry * layout.stride[0] + element];
  }
  template <class Visit>
  void each_element(Visit&& visit) const {
    for (int q = 0; q < static_cast<int>(body.mesh.blocks[0].section.quads.size()); ++q)
      for (int e = 0; e < body.layout.blocks[0].elements; ++e) visit(q, e);
  }
  Body body;
  BodyState state;
  TraversalOf<RecordingHex> elements;
  HistoryLayout layout;
};

template <class Element>
concept TriedWithoutHistory = requires(TraversalOf<Element> elements, Field field) {
  elements.internal_force(field, 0.0, field);
};
static_assert(TriedWithoutHistory<ElasticHex>);
static_assert(!TriedWithoutHistory<RecordingHex>, "an element that remembers is never evaluated without its history");

Field stretched(const Body& body, double share) {
  return nodal_field(body, [&](Vec3 x) { return Vec3{share * x.x, 0, 0}; });
}

TEST(ElementHistory, TrialsLeaveItAloneAndCommitsAdvanceItOncePerElement) {
  Recording r(distorted_body(SweepKind::extrude));
  Field u = stretched(r.body, 1e-3);
  for (int trial = 0; trial < 3; ++trial) r.elements.internal_force(u, 0, r.state.f, r.state.history);
  r.each_element([&](int q, int e) { ASSERT_EQ(r.history(q, 0, e), 0.0); });
  for (int commit = 1; commit <= 2; ++commit) {
    r.elements.commit_internal_force(u, 0, r.state.f, r.state.history);
    r.each_element([&](int q, int e) { ASSERT_EQ(r.history(q, 0, e), commit) << q << " " << e; });
  }
}

TEST(ElementHistory, KeepsTheLargestDilatationOfAStretchAndItsReturn) {
  Recording r(distorted_body(SweepKind::extrude));
  const double largest = 2e-3, green = largest + 0.5 * largest * largest;  // E_xx of a stretch 1 + largest
  for (double share : {1e-3, largest, 0.5e-3}) {
    Field u = stretched(r.body, share);
    r.elements.commit_internal_force(u, 0, r.state.f, r.state.history);
  }
  r.each_element([&](int q, int e) { ASSERT_NEAR(r.history(q, 1, e), green, 1e-13); });
}

TEST(ElementHistory, IsEachElementsOwn) {
  Recording r(distorted_body(SweepKind::extrude));
  Field u = nodal_field(r.body, [](Vec3 x) { return Vec3{0.5e-2 * x.x * x.x, 0, 0}; });  // E_xx grows with x
  r.elements.commit_internal_force(u, 0, r.state.f, r.state.history);
  for (int e = 1; e < r.body.layout.blocks[0].elements; ++e) ASSERT_GT(r.history(3, 1, e), r.history(3, 1, e - 1)) << e;
}

TEST(ElementHistory, OfALawThatOnlyRecordsChangesNoForce) {
  for (SweepKind kind : {SweepKind::extrude, SweepKind::revolve}) {
    Recording r(distorted_body(kind));
    Field u = scattered_field(r.body, 1e-6), plain = r.body.layout.field();
    internal_force(r.body, u, 0, plain);
    r.elements.commit_internal_force(u, 0, r.state.f, r.state.history);
    for (const NodeLine& l : r.body.lines)
      for (int j = 0; j < l.count; ++j) ASSERT_EQ(r.state.f[l.first + j], plain[l.first + j]);
    EXPECT_EQ(r.elements.energy(u, 0, r.state.history).strain, strain_energy(r.body, u, 0).strain);
  }
}

TEST(ElementHistory, OfAStepInChainsIsCommittedOnceInEitherPrecision) {
  for (Precision precision : {Precision::double_precision, Precision::single_precision}) {
    Recording r(distorted_body(SweepKind::extrude), precision);
    r.state.u = stretched(r.body, 1e-3);
    r.elements.begin(r.state.u, 0);
    const std::vector<Chain> all = chains(r.body.tiling, 2);
    for (const Chain& c : all) r.elements.chain_forces(c, r.state.u, r.state.f, r.state.history, StoreForces{});
    r.elements.end(all, r.state.f);
    r.each_element([&](int q, int e) {
      ASSERT_EQ(r.history(q, 0, e), 1.0);
      ASSERT_NEAR(r.history(q, 1, e), 1.0005e-3, precision == Precision::single_precision ? 1e-6 : 1e-13);
    });
  }
}

TEST(ElementHistory, StandsInTheListOfNamedArraysWithItsSize) {
  const Recording r(distorted_body(SweepKind::extrude));
  const auto history = std::find_if(kStateArrays.begin(), kStateArrays.end(),
                                    [](const StateArray& a) { return std::string_view(a.name) == "history"; });
  ASSERT_NE(history, kStateArrays.end());
  EXPECT_TRUE(history->restart);
  EXPECT_EQ((r.state.*history->values).size(), static_cast<std::size_t>(r.layout.size));
  EXPECT_TRUE(BodyState(r.body).history.empty());  // elastic elements keep nothing
}

TEST(Body, IsConstantSoThatTwoTraversalsMayUseItAtATime) {
  const Body body(distorted_body(SweepKind::revolve, true), {kSteel}, {});
  const Field u = scattered_field(body, 1e-6);
  Field alone = body.layout.field(), moved = u;
  internal_force(body, moved, 0.2, alone);
  std::array<Field, 2> f{body.layout.field(), body.layout.field()};
  for_each(2, [&](std::ptrdiff_t k) {
    Field mine = u;
    for (int repeat = 0; repeat < 20; ++repeat) internal_force(body, mine, 0.2, f[static_cast<std::size_t>(k)]);
  });
  for (const Field& other : f)
    for (const NodeLine& l : body.lines)
      for (int j = 0; j < l.count; ++j) ASSERT_EQ(other[l.first + j], alone[l.first + j]);
}

}  // namespace
}  // namespace railstrata
