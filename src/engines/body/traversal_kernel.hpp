#pragma once
// Inner loop of body/traversal.cpp over a tile's quadrilaterals; a header so that benchmarks can measure it alone.
#include <algorithm>

#include "body/plastic_pass.hpp"
#include "body/scratch_rows.hpp"
#include "body/traversal.hpp"

namespace railstrata {
namespace traversal {

// Hourglass forces of a pack whose halves are of two classes.
// Seldom: where the spacing changes. Kept out of the loop over packs, whose registers it would take.
template <class Real, class P>
__attribute__((noinline)) P two_class_hourglass(const Real* lower, const Real* upper, ElementKinematics<P>& kin) {
  return hourglass_forces([=](int e) -> P { return halves(P{} + lower[e], P{} + upper[e]); }, kin);
}

// The same of elements with materials of their own.
template <class Real, class P>
__attribute__((noinline)) P own_class_hourglass(const BlockElements& elements, int quad, int first,
                                                ElementKinematics<P>& kin) {
  const Real* own[kLanesOf<Real>];
  for (int l = 0; l < kLanesOf<Real>; ++l) {
    const int e = first + l, cls = elements.hourglass_class[e / kHourglassGroup];
    own[l] = elements.of<Real>().hourglass[elements.hourglass(elements.set_at(e), cls, quad)].data();
  }
  const auto entry = [&](int e) {
    P out;
    for (int l = 0; l < kLanesOf<Real>; ++l) out[l] = own[l][e];
    return out;
  };
  return hourglass_forces(entry, kin);
}

// Material parameters of a pack of elements from `first` on.
template <class Real>
PackReference<Real, PackOf<Real>> pack_reference(const BlockElements& elements, int quad, int first) {
  const auto& references = elements.of<Real>().quads;
  PackReference<Real, PackOf<Real>> out{references[quad].shape, {}};
  for (int l = 0; l < kLanesOf<Real>; ++l) {
    const MaterialParameters<Real>& own = references[elements.reference(elements.set_at(first + l), quad)].material;
    out.material.lambda[l] = own.lambda;
    out.material.mu[l] = own.mu;
  }
  return out;
}

// Replaces the hourglass amplitudes of a pack of elements from `first` on by their forces; returns the energy. Lanes
// past the end of the line are filled with numbers that mean nothing.
template <class Real, class P>
P pack_hourglass(const BlockElements& elements, int quad, int first, ElementKinematics<P>& kin) {
  const ElementTable<Real>& table = elements.of<Real>();
  const auto quads = static_cast<std::size_t>(elements.quads);
  const auto stiffness = [&](int cls) { return table.hourglass[cls * quads + quad].data(); };
  const int lower = elements.hourglass_class[first / kHourglassGroup];
  const int upper = elements.hourglass_class[(first + kLanesOf<Real> / 2) / kHourglassGroup];
  if (lower == upper) return hourglass_forces([k = stiffness(lower)](int e) { return k[e]; }, kin);
  return two_class_hourglass<Real>(stiffness(lower), stiffness(upper), kin);
}

// Kinematics of kLanes elements from fields, without scratch rows. first: element of the block in lane 0; lanes past
// the end of the block have no displacements. Of each source its own: where products are fused may differ between them
// (ROOM_WIDE_VECTOR_SOURCES in cmake/rooms.cmake).
static inline ElementKinematics<Pack> pack_kinematics(const Body& body, int block, int quad, int first,
                                                      const Rotation<double>& turn, const Field& u) {
  const BlockElements& elements = body.elements[block];
  const BlockLayout& lay = body.layout.blocks[block];
  const std::array<int, 4>& nodes = body.mesh.blocks[block].section.quads[quad];
  Pack cosine{}, sine{}, real{};
  for (int l = 0; l < std::min(kLanes, lay.elements - first); ++l) {
    const Rotation<double> frame = Rotation<double>{elements.cos_q[first + l], elements.sin_q[first + l]}.minus(turn);
    cosine[l] = frame.c;
    sine[l] = frame.s;
    real[l] = 1;
  }
  const StationScale<Pack> scale = elements.table.scale<Pack>(first, [](const double* x) { return load(x); });
  const auto corner = [&](int c, int i, Pack& sum, Pack& difference) {
    const auto carried = [&](int station) -> Pack {
      if (i == 1) return real * load(&u[lay.line(nodes[c], 1) + station]);
      const Pack x = load(&u[lay.line(nodes[c], 0) + station]), z = load(&u[lay.line(nodes[c], 2) + station]);
      const PlaneVector<Pack> at = Rotation<Pack>{cosine, sine}.forward(x, z);
      return i == 0 ? at.x : at.z;
    };
    const Pack left = carried(first), right = carried(first + 1);
    sum = right + left;
    difference = right - left;
  };
  return element_kinematics<SweepKind::revolve, Pack>(elements.table.quads[quad].shape, scale, corner);
}

template <class Real>
ScratchRows<Real>& thread_scratch() {
  thread_local ScratchRows<Real> scratch;
  return scratch;
}

// Room for the largest block on every thread, before the time loop.
template <class Real>
void reserve_scratch(const Tiling& tiling) {
  int slots = 0;
  for (const SweepPlan& p : tiling.plans) slots = std::max(slots, p.slots);
#pragma omp parallel
  thread_scratch<Real>().fit(slots);
}

// Data of one quadrilateral of a tile.
template <class Real>
struct QuadRows {
  Real* node[4];              // rows of the corners
  const Real* forces[4];      // their forces so far
  const double* eigenstress;  // of the tile's first element, entry k at + k * kTile; null where there is none
};

// The eigenstress of a pack of elements.
template <class P>
struct PackEigenstress {
  const double* rows;
  P entry(int k) const {
    P out;
    for (int l = 0; l < static_cast<int>(sizeof(P) / sizeof(out[0])); ++l)
      out[l] = static_cast<ScalarOf<P>>(rows[k * kTile + l]);
    return out;
  }
  void operator()(P (&s)[6]) const {
    RAILSTRATA_UNROLL
    for (int i = 0; i < 6; ++i) s[i] -= entry(i);
  }
  void take_off(ElementKinematics<P>& forces) const {
    RAILSTRATA_UNROLL
    for (int i = 0; i < 3; ++i) {
      forces.even[i] -= entry(6 + i);
      RAILSTRATA_UNROLL
      for (int m = 0; m < 3; ++m) forces.odd[m][i] -= entry(9 + 3 * m + i);
    }
  }
};

// A tile and what it works with.
template <class Real>
struct TileWork {
  const Tile& tile;
  const SweepPlan& plan;
  const BlockLayout& layout;
  const std::vector<std::array<int, 4>>& quads;
  CarriedRows frame;
  int count;  // elements along the sweep
  ScratchRows<Real>& scratch;
};

// Names the memory that a quadrilateral will touch, so that it can be asked for while the one before is evaluated.
template <class Real, class Policy>
inline void look_ahead(const TileWork<Real>& work, int q, const Field& u, const Policy& policy, Prefetch& ahead) {
  for (int c = 0; c < 4; ++c) {
    const int node = work.quads[q][c];
    if (work.plan.first[q][c])
      for (int i = 0; i < 3; ++i) ahead.add(u.data() + work.layout.line(node, i) + work.tile.first);
    if constexpr (std::is_same_v<Policy, FuseUpdate>)
      if (work.plan.last[q][c]) policy.expect(work.tile, node, ahead);
  }
}

// The rows of the corners; displacements of those that are touched for the first time.
template <SweepKind kind, class Real>
inline QuadRows<Real> gather_quad(const TileWork<Real>& work, int q, const Field& u) {
  using Rows = ScratchRows<Real>;
  QuadRows<Real> rows{};
  for (int c = 0; c < 4; ++c) {
    const int node = work.quads[q][c];
    rows.node[c] = &work.scratch.rows[static_cast<std::size_t>(work.plan.slot[node]) * Rows::kNode];
    rows.forces[c] = work.plan.first[q][c] ? work.scratch.zero : rows.node[c] + Rows::kForces * kTile;
    if (!work.plan.first[q][c]) continue;
    const double* line[3];
    for (int i = 0; i < 3; ++i) line[i] = u.data() + work.layout.line(node, i) + work.tile.first;
    gather_displacements<kind>(line, work.frame, work.count, rows.node[c]);
  }
  return rows;
}

// All packs of one quadrilateral in a tile.
// own: elements have materials of their own.
template <Evaluation how, SweepKind kind, bool eigenstressed, bool own, class Real, class P, int most>
inline void evaluate_quad(const BlockElements& elements, int quad, const StationScale<P> (&scale)[most], int packs,
                          int first_element, const Rotation<Real>& turn, const QuadRows<Real>& rows,
                          const Prefetch& ahead) {
  using Rows = ScratchRows<Real>;
  constexpr int lanes = kLanesOf<Real>;
  const auto& reference = elements.of<Real>().quads[quad];
  // copies whose address is not taken: else the compiler would read the pointers again after every store to the rows
  Real* const node[4] = {rows.node[0], rows.node[1], rows.node[2], rows.node[3]};
  const Real* const so_far[4] = {rows.forces[0], rows.forces[1], rows.forces[2], rows.forces[3]};
  const Rotation<Real> turned = turn;
  for (int n = 0; n < packs; ++n) {
    const int e = n * lanes;
    ahead.ask(n == 0 ? 0 : e + 1, e + lanes + 1);
    const auto corner = [&](int c, int i, P& sum, P& difference) {
      sum = load(node[c] + (Rows::kSum + i) * kTile + e);
      difference = load(node[c] + (Rows::kDifference + i) * kTile + e);
    };
    const PackEigenstress<P> eigenstress{rows.eigenstress + (eigenstressed ? e : 0)};
    const auto hourglass = [&](ElementKinematics<P>& kin) {
      if constexpr (own)
        own_class_hourglass<Real>(elements, quad, first_element + e, kin);
      else
        pack_hourglass<Real>(elements, quad, first_element + e, kin);
      if constexpr (eigenstressed) eigenstress.take_off(kin);
    };
    const auto add_forces = [&](int c, int i, auto&& add) {
      P s = load(so_far[c] + (Rows::kSum + i) * kTile + e);
      P difference = load(so_far[c] + (Rows::kDifference + i) * kTile + e);
      add(s, difference);
      store(node[c] + (Rows::kForces + Rows::kSum + i) * kTile + e, s);
      store(node[c] + (Rows::kForces + Rows::kDifference + i) * kTile + e, difference);
    };
    const auto forces = [&](const auto& of) {
      if constexpr (eigenstressed)
        hex_forces<kind, how>(of, scale[n], turned, corner, hourglass, add_forces, eigenstress);
      else
        hex_forces<kind, how>(of, scale[n], turned, corner, hourglass, add_forces);
    };
    if constexpr (own)
      forces(pack_reference<Real>(elements, quad, first_element + e));
    else
      forces(reference);
  }
}

// Elements with materials of their own: kept out of the tile's loop, which few bodies have them in.
template <Evaluation how, SweepKind kind, class Real, class P, int most>
__attribute__((noinline, flatten)) void evaluate_own(const BlockElements& elements, int quad,
                                                     const StationScale<P> (&scale)[most], int packs, int first_element,
                                                     const Rotation<Real>& turn, const QuadRows<Real>& rows,
                                                     const Prefetch& ahead) {
  if (rows.eigenstress)
    evaluate_quad<how, kind, true, true>(elements, quad, scale, packs, first_element, turn, rows, ahead);
  else
    evaluate_quad<how, kind, false, true>(elements, quad, scale, packs, first_element, turn, rows, ahead);
}

}  // namespace traversal

}  // namespace railstrata
