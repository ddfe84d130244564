#include "body/solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/vectorize.hpp"
#include "mesh/sweep_order.hpp"

namespace railstrata {
namespace {

constexpr int kGroup =
    8;  // elements along the sweep that share one hourglass stiffness; a multiple of every pack of doubles
constexpr int kLineEnd = 64 / sizeof(float);  // lines end with a whole pack of any number type

bool same_spacing(double a, double b) { return std::abs(a - b) < 1e-9 * b; }

// Index of `value` in `known`, added if it is new.
template <class T, class Same>
int class_of(std::vector<T>& known, const T& value, Same&& same) {
  const auto at = std::find_if(known.begin(), known.end(), [&](const T& k) { return same(k, value); });
  if (at != known.end()) return static_cast<int>(at - known.begin());
  known.push_back(value);
  return static_cast<int>(known.size()) - 1;
}

QuadReferenceOf<float> rounded(const QuadReference& r) {
  QuadReferenceOf<float> out;
  auto f = [](double x) { return static_cast<float>(x); };
  for (int k = 0; k < 4; ++k) {
    out.gx[k] = f(r.gx[k]);
    out.gy[k] = f(r.gy[k]);
    out.gz[k] = f(r.gz[k]);
  }
  for (int k = 0; k < 3; ++k) out.odd[k] = f(r.odd[k]);
  out.volume = f(r.volume);
  out.even_y = f(r.even_y);
  out.even_z = f(r.even_z);
  out.lambda = f(r.lambda);
  out.mu = f(r.mu);
  return out;
}

}  // namespace

std::array<Vec2, 4> Solid::corners(int block, int quad) const {
  const Section& s = body_.blocks[block].section;
  const auto& q = s.quads[quad];
  return {s.nodes[q[0]], s.nodes[q[1]], s.nodes[q[2]], s.nodes[q[3]]};
}

Solid::Solid(const SweptBody& body, const std::vector<Elastic>& materials, const SolidOptions& options)
    : body_(body), layout_(layout_of(body)), materials_(materials), precision_(options.precision) {
  mass_ = layout_.field();
  std::ptrdiff_t border = 0;
  for (int b = 0; b < static_cast<int>(body_.blocks.size()); ++b) {
    const Block& block = body_.blocks[b];
    const BlockLayout& lay = layout_.blocks[b];
    const int quads = static_cast<int>(block.section.quads.size()),
              padded = (lay.elements + kLineEnd - 1) / kLineEnd * kLineEnd;
    BlockData d;
    KernelData<double>& k = d.kernel;
    for (auto* a : {&k.inv_sigma, &k.inv_c, &k.v1, &k.v2, &k.v3, &k.sigma, &k.c}) a->assign(padded, 0.0);
    for (Field* a : {&d.theta, &d.cos_q, &d.sin_q}) a->assign(lay.elements, 0.0);
    std::vector<double> spacing(lay.elements);
    for (int e = 0; e < lay.elements; ++e) {
      const double t0 = block.stations.at[e];
      const double t1 = e + 1 < lay.stations ? block.stations.at[e + 1] : block.stations.at[0] + 2 * std::numbers::pi;
      spacing[e] = t1 - t0;
      const SweepScale scale = sweep_scale(body_.kind, spacing[e]);
      k.inv_sigma[e] = 1 / scale.sigma;
      k.inv_c[e] = 1 / scale.c;
      k.v1[e] = scale.c;
      k.v2[e] = scale.sigma * scale.c;
      k.v3[e] = scale.sigma;
      k.sigma[e] = scale.sigma;
      k.c[e] = scale.c;
      d.theta[e] = body_.kind == SweepKind::revolve ? 0.5 * (t0 + t1) : 0.0;
      d.cos_q[e] = std::cos(d.theta[e]);
      d.sin_q[e] = std::sin(d.theta[e]);
    }
    d.cos_r = d.cos_q;
    d.sin_r = d.sin_q;

    std::vector<double> hourglass_spacings;
    for (int e = 0; e < lay.elements; ++e) {
      if (e % kGroup == 0) {
        const int count = std::min(kGroup, lay.elements - e);
        d.hourglass_class.push_back(
            class_of(hourglass_spacings, *std::min_element(&spacing[e], &spacing[e] + count), same_spacing));
      }
      const SpacingClass mine{spacing[e], d.hourglass_class.back()};
      d.element_class.push_back(class_of(d.classes, mine, [](const SpacingClass& a, const SpacingClass& c) {
        return same_spacing(a.spacing, c.spacing) && a.hourglass == c.hourglass;
      }));
    }
    const int classes = static_cast<int>(hourglass_spacings.size());
    d.hourglass_class.resize(padded / kGroup, d.hourglass_class.back());
    k.quads.reserve(quads);
    for (int q = 0; q < quads; ++q)
      k.quads.push_back(quad_reference(body_.kind, corners(b, q), materials_[block.section.quad_material[q]]));
    k.hourglass.assign(static_cast<std::size_t>(classes) * quads, HourglassStiffness{});
    for_each(static_cast<std::ptrdiff_t>(classes) * quads, [&](std::ptrdiff_t i) {
      const int q = static_cast<int>(i % quads);
      k.hourglass[i] = hourglass_stiffness(
          body_.kind, corners(b, q), sweep_scale(body_.kind, hourglass_spacings[i / quads]),
          materials_[block.section.quad_material[q]], options.element, options.hourglass_coefficient);
    });
    if (precision_ == Precision::single_precision) {
      for (const QuadReference& r : k.quads) d.single.quads.push_back(rounded(r));
      for (const HourglassStiffness& h : k.hourglass) {
        d.single.hourglass.emplace_back();
        std::transform(h.begin(), h.end(), d.single.hourglass.back().begin(),
                       [](double x) { return static_cast<float>(x); });
      }
      auto round_line = [](const Line<double>& from, Line<float>& to) { to.assign(from.begin(), from.end()); };
      round_line(k.inv_sigma, d.single.inv_sigma);
      round_line(k.inv_c, d.single.inv_c);
      round_line(k.v1, d.single.v1);
      round_line(k.v2, d.single.v2);
      round_line(k.v3, d.single.v3);
      round_line(k.sigma, d.single.sigma);
      round_line(k.c, d.single.c);
    }

    for (int e = 0; e < lay.elements; ++e) {
      const int next = e + 1 < lay.stations ? e + 1 : 0;
      const SweepScale scale{k.sigma[e], k.c[e]};
      for (int q = 0; q < quads; ++q) {
        const auto m =
            corner_masses(body_.kind, corners(b, q), scale, materials_[block.section.quad_material[q]].density);
        for (int n = 0; n < 4; ++n)
          for (int i = 0; i < 3; ++i) {
            const std::ptrdiff_t line = lay.line(block.section.quads[q][n], i);
            mass_[line + e] += m[n];
            mass_[line + next] += m[n];
          }
      }
    }
    plan_scratch(b, d);
    first_tile_.push_back(static_cast<int>(tiles_.size()));
    for (int first = 0; first < lay.elements; first += kTile) {
      tiles_.push_back({b, first, std::min(first + kTile, lay.elements)});
      border_.push_back(border);
      border += static_cast<std::ptrdiff_t>(lay.nodes) * 3;
    }
    data_.push_back(std::move(d));
  }
  first_tile_.push_back(static_cast<int>(tiles_.size()));
  border_first_.assign(border, 0.0);
  border_end_.assign(border, 0.0);
}

// Scratch memory: the lowest free place at the first touch of a node, given back after the last.
void Solid::plan_scratch(int block, BlockData& d) const {
  const auto& quads = body_.blocks[block].section.quads;
  const std::size_t nodes = body_.blocks[block].section.nodes.size();
  d.order = sweep_order(body_.blocks[block].section);
  d.fresh.resize(quads.size());
  d.done.resize(quads.size());
  std::vector<int> first(nodes, -1), last(nodes, -1);
  for (int q : d.order)
    for (int n : quads[q]) {
      if (first[n] < 0) first[n] = q;
      last[n] = q;
    }
  d.slot.assign(nodes, 0);
  std::vector<char> taken;
  for (int q : d.order) {
    for (int k = 0; k < 4; ++k) {
      const int n = quads[q][k];
      if (first[n] != q) continue;
      d.fresh[q][k] = 1;
      const auto free = std::find(taken.begin(), taken.end(), 0);
      d.slot[n] = static_cast<int>(free - taken.begin());
      if (free == taken.end())
        taken.push_back(1);
      else
        *free = 1;
    }
    for (int k = 0; k < 4; ++k)
      if (last[quads[q][k]] == q) d.done[q][k] = 1, taken[d.slot[quads[q][k]]] = 0;
  }
  d.slots = static_cast<int>(taken.size());
}

double Solid::total_mass() const {
  double sum = 0;
  for (const BlockLayout& l : layout_.blocks)
    for (int n = 0; n < l.nodes; ++n)
      for (int j = 0; j < l.stations; ++j) sum += mass_[l.line(n, 0) + j];
  return sum;
}

void Solid::refresh_ghosts(Field& u) const {
  for (const BlockLayout& l : layout_.blocks)
    if (l.closed)
      for (int n = 0; n < l.nodes; ++n)
        for (int i = 0; i < 3; ++i) u[l.line(n, i) + l.stations] = u[l.line(n, i)];
}

void Solid::turn_frames(double psi) const {
  if (body_.kind == SweepKind::extrude) return;
  turn_ = {std::cos(psi), std::sin(psi)};
  for (BlockData& d : data_)
    for (std::size_t e = 0; e < d.cos_q.size(); ++e) {
      d.cos_r[e] = d.cos_q[e] * turn_.c + d.sin_q[e] * turn_.s;  // theta - psi
      d.sin_r[e] = d.sin_q[e] * turn_.c - d.cos_q[e] * turn_.s;
    }
}

template <class Real>
template <class T, class Load>
StationScale<T> Solid::KernelData<Real>::scale(int e, Load&& read) const {
  return {read(&inv_sigma[e]), read(&inv_c[e]), read(&v1[e]), read(&v2[e]), read(&v3[e]), read(&sigma[e]), read(&c[e])};
}

template <>
const Solid::KernelData<double>& Solid::kernel<double>(const BlockData& d) const {
  return d.kernel;
}
template <>
const Solid::KernelData<float>& Solid::kernel<float>(const BlockData& d) const {
  return d.single;
}

namespace {

// Hourglass stiffness of a pack: of one class, or of one in each half.
template <class Real>
struct OneClass {
  const Real* k;
  Real operator()(int e) const { return k[e]; }
};
template <class Real>
struct TwoClasses {
  const Real *lower, *upper;
  PackOf<Real> operator()(int e) const { return halves(PackOf<Real>{} + lower[e], PackOf<Real>{} + upper[e]); }
};

// Replaces the hourglass amplitudes of a pack of elements from `first` on by their forces; returns the energy. `table`:
// the classes' stiffnesses of one quadrilateral. Lanes past the end of the line are filled with numbers that mean
// nothing.
template <class Real, class P, class Table>
P pack_hourglass(const Table& table, const std::vector<int>& group_class, int first, ElementKinematics<P>& kin) {
  const int lower = group_class[first / kGroup], upper = group_class[(first + kLanesOf<Real> / 2) / kGroup];
  if (lower == upper) return hourglass_forces(OneClass<Real>{table(lower)}, kin);
  return hourglass_forces(TwoClasses<Real>{table(lower), table(upper)}, kin);
}

// A tile's scratch memory. A node that is being worked on has twelve rows: displacements at a station and the next, sum
// and difference by component; forces in the same form, s - d in front of the element and s + d behind it.
template <class Real>
struct Scratch {
  static constexpr int kSum = 0, kDifference = 3, kForces = 6, kRows = 12;
  static constexpr std::size_t kNode = static_cast<std::size_t>(kRows) * Solid::kTile;
  std::vector<Real, CacheLineAllocator<Real>> rows;
  alignas(64) Real zero[(kRows - kForces) * Solid::kTile] = {};  // forces on a node before the first element
  void fit(int slots) { rows.resize(std::max(rows.size(), static_cast<std::size_t>(slots) * kNode)); }
};

// Displacements of a node at stations 0 … count as sums and differences over the elements between them, in the carried
// frame.
template <SweepKind kind, class Real>
void take_in(const double* const (&line)[3], const double* cosine, const double* sine, int count, Real* rows) {
  const double *x = line[0], *y = line[1], *z = line[2];
  Real *sx = rows, *sy = sx + Solid::kTile, *sz = sy + Solid::kTile, *dx = sz + Solid::kTile, *dy = dx + Solid::kTile,
       *dz = dy + Solid::kTile;
  RAILSTRATA_INDEPENDENT
  for (int j = 0; j < count; ++j) {
    const double a = x[j + 1] + x[j], b = z[j + 1] + z[j], da = x[j + 1] - x[j], db = z[j + 1] - z[j];
    sy[j] = static_cast<Real>(y[j + 1] + y[j]);
    dy[j] = static_cast<Real>(y[j + 1] - y[j]);
    if constexpr (kind == SweepKind::revolve) {
      const double c = cosine[j], s = sine[j];
      sx[j] = static_cast<Real>(c * a + s * b);
      sz[j] = static_cast<Real>(c * b - s * a);
      dx[j] = static_cast<Real>(c * da + s * db);
      dz[j] = static_cast<Real>(c * db - s * da);
    } else {
      sx[j] = static_cast<Real>(a);
      sz[j] = static_cast<Real>(b);
      dx[j] = static_cast<Real>(da);
      dz[j] = static_cast<Real>(db);
    }
  }
}

// Forces of the elements in front of and behind the stations 0 < j < count, model frame: complete[i * kTile + j]; those
// at station 0 from the element in front of it, at station `count` from the one behind.
template <SweepKind kind, class Real>
void give_out(const Real* rows, const double* cosine, const double* sine, int count, double* complete, double* first,
              double* end) {
  const Real *sx = rows, *sy = sx + Solid::kTile, *sz = sy + Solid::kTile, *dx = sz + Solid::kTile,
             *dy = dx + Solid::kTile, *dz = dy + Solid::kTile;
  auto in_model = [&](int j, Real x, Real y, Real z, double& fx, double& fy, double& fz) {
    const double a = x, b = z;
    fy = y;
    if constexpr (kind == SweepKind::revolve) {
      fx = cosine[j] * a - sine[j] * b;
      fz = sine[j] * a + cosine[j] * b;
    } else {
      fx = a;
      fz = b;
    }
  };
  auto front = [&](int j, double& fx, double& fy, double& fz) {
    in_model(j, sx[j] - dx[j], sy[j] - dy[j], sz[j] - dz[j], fx, fy, fz);
  };
  auto behind = [&](int j, double& fx, double& fy, double& fz) {
    in_model(j, sx[j] + dx[j], sy[j] + dy[j], sz[j] + dz[j], fx, fy, fz);
  };
  front(0, first[0], first[1], first[2]);
  behind(count - 1, end[0], end[1], end[2]);
  double *x = complete, *y = x + Solid::kTile, *z = y + Solid::kTile;
  RAILSTRATA_INDEPENDENT
  for (int j = 1; j < count; ++j) {
    double ax, ay, az, bx, by, bz;
    front(j, ax, ay, az);
    behind(j - 1, bx, by, bz);
    x[j] = ax + bx;
    y[j] = ay + by;
    z[j] = az + bz;
  }
}

}  // namespace

template <class Real, bool linear, SweepKind kind>
void Solid::run_tile(int t, bool follows, const Field& u, Field& f, const TakeRows* take,
                     const ExpectRows* expect) const {
  using P = PackOf<Real>;
  using Rows = Scratch<Real>;
  constexpr int lanes = kLanesOf<Real>;
  const Tile& tile = tiles_[t];
  const BlockData& d = data_[tile.block];
  const KernelData<Real>& k = kernel<Real>(d);
  const BlockLayout& lay = layout_.blocks[tile.block];
  const auto& quads = body_.blocks[tile.block].section.quads;
  const int count = tile.end - tile.first, packs = (count + lanes - 1) / lanes;
  thread_local Rows scratch;
  scratch.fit(d.slots);
  alignas(64) double complete[3 * kTile];
  const BodyTurn<Real> turn{static_cast<Real>(turn_.c), static_cast<Real>(turn_.s)};
  const double *cosine = d.cos_r.data() + tile.first, *sine = d.sin_r.data() + tile.first;  // the carried frame

  StationScale<P> st[kTile / lanes];
  for (int n = 0; n < packs; ++n)
    st[n] = k.template scale<P>(tile.first + n * lanes, [](const Real* x) { return load(x); });

  Prefetch ahead;
  auto look_ahead = [&](int q) {
    for (int c = 0; c < 4; ++c) {
      if (d.fresh[q][c])
        for (int i = 0; i < 3; ++i) ahead.add(u.data() + lay.line(quads[q][c], i) + tile.first);
      if (d.done[q][c] && expect) (*expect)(tile, quads[q][c], ahead);
    }
  };
  look_ahead(d.order.front());
  ahead.ask(0, count + 1);
  for (std::size_t p = 0; p < quads.size(); ++p) {
    const int q = d.order[p];
    ahead.clear();
    if (p + 1 < quads.size()) look_ahead(d.order[p + 1]);
    const QuadReferenceOf<Real>& ref = k.quads[q];
    Real* node[4];          // rows of the corners
    const Real* so_far[4];  // their forces
    for (int c = 0; c < 4; ++c) {
      node[c] = &scratch.rows[static_cast<std::size_t>(d.slot[quads[q][c]]) * Rows::kNode];
      so_far[c] = d.fresh[q][c] ? scratch.zero : node[c] + Rows::kForces * kTile;
      if (!d.fresh[q][c]) continue;
      const double* line[3];
      for (int i = 0; i < 3; ++i) line[i] = u.data() + lay.line(quads[q][c], i) + tile.first;
      take_in<kind>(line, cosine, sine, count, node[c]);
    }
    for (int n = 0; n < packs; ++n) {
      const int e = n * lanes;
      ahead.ask(n == 0 ? 0 : e + 1, e + lanes + 1);
      auto kin = element_kinematics<kind, P>(ref, st[n], [&](int c, int i, P& sum, P& difference) {
        sum = load(node[c] + (Rows::kSum + i) * kTile + e);
        difference = load(node[c] + (Rows::kDifference + i) * kTile + e);
      });
      ElementStress<P> stress;
      if constexpr (linear)
        stress = linear_stress(ref, kin);
      else
        stress = nonlinear_stress<kind>(ref, turn, kin);
      pack_hourglass<Real>([&](int c) { return k.hourglass[c * quads.size() + q].data(); }, d.hourglass_class,
                           tile.first + e, kin);
      element_forces(ref, st[n], stress, kin, [&](int c, int i, auto&& add) {
        P s = load(so_far[c] + (Rows::kSum + i) * kTile + e),
          difference = load(so_far[c] + (Rows::kDifference + i) * kTile + e);
        add(s, difference);
        store(node[c] + (Rows::kForces + Rows::kSum + i) * kTile + e, s);
        store(node[c] + (Rows::kForces + Rows::kDifference + i) * kTile + e, difference);
      });
    }

    for (int c = 0; c < 4; ++c) {
      if (!d.done[q][c]) continue;
      double *first = &border_first_[border_[t] + static_cast<std::ptrdiff_t>(quads[q][c]) * 3],
             *end = &border_end_[border_[t] + static_cast<std::ptrdiff_t>(quads[q][c]) * 3];
      give_out<kind>(node[c] + Rows::kForces * kTile, cosine, sine, count, complete, first, end);
      if (follows)
        for (int i = 0; i < 3; ++i)
          complete[i * kTile] =
              border_end_[border_[t - 1] + static_cast<std::ptrdiff_t>(quads[q][c]) * 3 + i] + first[i];
      const int begin = follows ? 0 : 1;
      if (take && (*take)(tile, tile.first + begin, quads[q][c], complete)) continue;
      for (int i = 0; i < 3; ++i)
        std::copy(complete + i * kTile + begin, complete + i * kTile + count,
                  f.data() + lay.line(quads[q][c], i) + tile.first + begin);
    }
  }
}

template <class Real, bool linear>
void Solid::run_chain(const Chain& chain, const Field& u, Field& f, const TakeRows* take,
                      const ExpectRows* expect) const {
  for (int t = chain.first_tile; t < chain.end_tile; ++t) {
    const bool follows = t > chain.first_tile;
    if (body_.kind == SweepKind::extrude)
      run_tile<Real, linear, SweepKind::extrude>(t, follows, u, f, take, expect);
    else
      run_tile<Real, linear, SweepKind::revolve>(t, follows, u, f, take, expect);
  }
}

std::vector<Solid::Chain> Solid::chains(int at_least, std::vector<Chain> reuse) const {
  const int length = std::max(1, static_cast<int>(tiles_.size()) / at_least);
  std::vector<Chain> out = std::move(reuse);
  out.clear();
  for (std::size_t b = 0; b + 1 < first_tile_.size(); ++b) {
    const int first = first_tile_[b], tiles = first_tile_[b + 1] - first, pieces = (tiles + length - 1) / length;
    for (int k = 0; k < pieces; ++k) out.push_back({first + k * tiles / pieces, first + (k + 1) * tiles / pieces});
  }
  return out;
}

void Solid::begin_forces(Field& u, double psi) const {
  refresh_ghosts(u);
  turn_frames(psi);
}

void Solid::chain_forces(const Chain& chain, const Field& u, Field& f, const TakeRows& take,
                         const ExpectRows& expect) const {
  if (precision_ == Precision::single_precision)
    run_chain<float, false>(chain, u, f, &take, &expect);
  else
    run_chain<double, false>(chain, u, f, &take, &expect);
}

void Solid::end_forces(const std::vector<Chain>& chains, Field& f) const {
  for_each(static_cast<std::ptrdiff_t>(chains.size()), [&](std::ptrdiff_t k) {
    const int t = chains[k].first_tile, b = tiles_[t].block;
    const BlockLayout& l = layout_.blocks[b];
    const std::ptrdiff_t lines = static_cast<std::ptrdiff_t>(l.nodes) * 3;
    const bool first_of_block = t == first_tile_[b], last_of_block = chains[k].end_tile == first_tile_[b + 1];
    const double* front = &border_first_[border_[t]];
    const double* behind = first_of_block ? (l.closed ? &border_end_[border_[first_tile_[b + 1] - 1]] : nullptr)
                                          : &border_end_[border_[t - 1]];
    double* out = f.data() + l.offset + tiles_[t].first;
    for (std::ptrdiff_t line = 0; line < lines; ++line)
      out[line * l.stride] = behind ? behind[line] + front[line] : front[line];
    if (!last_of_block || l.closed) return;
    const double* end = &border_end_[border_[chains[k].end_tile - 1]];
    double* last = f.data() + l.offset + l.elements;
    for (std::ptrdiff_t line = 0; line < lines; ++line) last[line * l.stride] = end[line];
  });
}

template <bool linear>
void Solid::forces(Field& u, double psi, Field& f) const {
  begin_forces(u, psi);
  all_chains_ = chains(8 * max_threads(), std::move(all_chains_));
  for_each(
      static_cast<std::ptrdiff_t>(all_chains_.size()),
      [&](std::ptrdiff_t k) { run_chain<double, linear>(all_chains_[k], u, f, nullptr, nullptr); }, true);
  end_forces(all_chains_, f);
}

void Solid::internal_force(Field& u, double psi, Field& f) const { forces<false>(u, psi, f); }
void Solid::linear_force(Field& u, Field& f) const { forces<true>(u, 0.0, f); }

StrainEnergy Solid::energy(Field& u, double psi) const {
  begin_forces(u, psi);
  std::vector<StrainEnergy>& part = tile_energy_;
  part.assign(tiles_.size(), {});
  for_each(
      static_cast<std::ptrdiff_t>(tiles_.size()),
      [&](std::ptrdiff_t t) {
        const Tile& tile = tiles_[t];
        const BlockData& d = data_[tile.block];
        const BlockLayout& lay = layout_.blocks[tile.block];
        const auto& quads = body_.blocks[tile.block].section.quads;
        Pack strain{}, hourglass{};
        for (std::size_t q = 0; q < quads.size(); ++q) {
          const QuadReference& ref = d.kernel.quads[q];
          const double* in[4][3];
          for (int c = 0; c < 4; ++c)
            for (int i = 0; i < 3; ++i) in[c][i] = u.data() + lay.line(quads[q][c], i);
          for (int e = tile.first; e < tile.end; e += kLanes) {
            const StationScale<Pack> st = d.kernel.scale<Pack>(e, [](const double* x) { return load(x); });
            const int real = std::min(kLanes, tile.end - e);
            Pack cosine{}, sine{};
            for (int l = 0; l < real; ++l) {
              cosine[l] = d.cos_r[e + l];
              sine[l] = d.sin_r[e + l];
            }
            auto kin =
                element_kinematics<SweepKind::revolve, Pack>(ref, st, [&](int c, int i, Pack& sum, Pack& difference) {
                  auto carried = [&](int station) -> Pack {
                    if (i == 1) return load(in[c][1] + station);
                    const Pack x = load(in[c][0] + station), z = load(in[c][2] + station);
                    return i == 0 ? cosine * x + sine * z : cosine * z - sine * x;
                  };
                  const Pack left = carried(e), right = carried(e + 1);
                  sum = right + left;
                  difference = right - left;
                });
            const auto stress = nonlinear_stress(ref, turn_, kin);
            const Pack stored = pack_hourglass<double>(
                [&](int c) { return d.kernel.hourglass[c * quads.size() + q].data(); }, d.hourglass_class, e, kin);
            for (int l = 0; l < real; ++l) hourglass[l] += stored[l];
            const auto& a = stress.strain;
            const auto& b = stress.s;
            strain += 0.5 * ref.volume * st.v2 *
                      (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]));
          }
        }
        for (int l = 0; l < kLanes; ++l) {
          part[t].strain += strain[l];
          part[t].hourglass += hourglass[l];
        }
      },
      true);
  StrainEnergy sum;
  for (const StrainEnergy& p : part) {
    sum.strain += p.strain;
    sum.hourglass += p.hourglass;
  }
  return sum;
}

void Solid::stiffness_diagonal(Field& diagonal) const {
  std::fill(diagonal.begin(), diagonal.end(), 0.0);
  for (int b = 0; b < static_cast<int>(data_.size()); ++b) {
    const BlockData& d = data_[b];
    const KernelData<double>& kernel_data = d.kernel;
    const BlockLayout& lay = layout_.blocks[b];
    const int quads = static_cast<int>(kernel_data.quads.size()), classes = static_cast<int>(d.classes.size());
    // per (class, quad, corner): xx, yy, zz, xz of the corner's own block, element frame; the same at both stations but
    // for the sign of xz
    std::vector<std::array<double, 32>> block(static_cast<std::size_t>(classes) * quads);
    for_each(static_cast<std::ptrdiff_t>(block.size()), [&](std::ptrdiff_t i) {
      const SpacingClass& mine = d.classes[i / quads];
      const Matrix24 k = linear_stiffness(kernel_data.quads[i % quads], sweep_scale(body_.kind, mine.spacing),
                                          kernel_data.hourglass[mine.hourglass * quads + i % quads]);
      for (int a = 0; a < 8; ++a) {
        block[i][4 * a] = k(3 * a, 3 * a);
        block[i][4 * a + 1] = k(3 * a + 1, 3 * a + 1);
        block[i][4 * a + 2] = k(3 * a + 2, 3 * a + 2);
        block[i][4 * a + 3] = k(3 * a, 3 * a + 2);
      }
    });
    for (int q = 0; q < quads; ++q)
      for (int a = 0; a < 8; ++a) {
        double* x = diagonal.data() + lay.line(body_.blocks[b].section.quads[q][a % 4], 0);
        for (int e = 0; e < lay.elements; ++e) {
          const auto& k = block[static_cast<std::size_t>(d.element_class[e]) * quads + q];
          const int j = a < 4 ? e : (e + 1 < lay.stations ? e + 1 : 0);
          const double c = d.cos_q[e], s = d.sin_q[e], cross_term = 2 * c * s * k[4 * a + 3];
          x[j] += c * c * k[4 * a] + s * s * k[4 * a + 2] - cross_term;
          x[j + lay.stride] += k[4 * a + 1];
          x[j + 2 * lay.stride] += s * s * k[4 * a] + c * c * k[4 * a + 2] + cross_term;
        }
      }
  }
}

namespace {

// Corner displacements of one element, as element_kinematics wants them.
auto corners_of(const BlockLayout& l, const std::array<int, 4>& quad, const Field& u, int station) {
  const int next = l.closed && station + 1 == l.stations ? 0 : station + 1;
  return [&l, &quad, &u, station, next](int c, int i, double& sum, double& difference) {
    const double left = u[l.line(quad[c], i) + station], right = u[l.line(quad[c], i) + next];
    sum = right + left;
    difference = right - left;
  };
}

}  // namespace

Sym3 Solid::stress(const Field& u, int block, int quad, int station) const {
  const BlockData& d = data_[block];
  const QuadReference& ref = d.kernel.quads[quad];
  const StationScale<double> st = d.kernel.scale<double>(station, [](const double* x) { return *x; });
  const double c = d.cos_q[station], s = d.sin_q[station];
  const auto corner = corners_of(layout_.blocks[block], body_.blocks[block].section.quads[quad], u, station);
  const auto kin =
      element_kinematics<SweepKind::revolve, double>(ref, st, [&](int k, int i, double& sum, double& difference) {
        if (i == 1) return corner(k, 1, sum, difference);
        double sx, dx, sz, dz;
        corner(k, 0, sx, dx);
        corner(k, 2, sz, dz);
        sum = i == 0 ? c * sx + s * sz : c * sz - s * sx;
        difference = i == 0 ? c * dx + s * dz : c * dz - s * dx;
      });
  const auto p = nonlinear_stress(ref, BodyTurn<double>{}, kin);
  // sigma = P F^T / det F, P and F with the element's frame as their right index
  auto to_model = [&](double x, double y, double z) { return Vec3{c * x - s * z, y, s * x + c * z}; };
  const Vec3 f1 = to_model(1 + kin.h1[0], kin.h1[1], kin.h1[2]), f2 = to_model(kin.h2[0], 1 + kin.h2[1], kin.h2[2]),
             f3 = to_model(kin.h3[0], kin.h3[1], 1 + kin.h3[2]);
  const Vec3 a = to_model(p.p1[0], p.p1[1], p.p1[2]), b = to_model(p.p2[0], p.p2[1], p.p2[2]),
             e = to_model(p.p3[0], p.p3[1], p.p3[2]);
  return (1 / dot(f1, cross(f2, f3))) *
         Sym3{a.x * f1.x + b.x * f2.x + e.x * f3.x, a.y * f1.y + b.y * f2.y + e.y * f3.y,
              a.z * f1.z + b.z * f2.z + e.z * f3.z, a.x * f1.y + b.x * f2.y + e.x * f3.y,
              a.y * f1.z + b.y * f2.z + e.y * f3.z, a.x * f1.z + b.x * f2.z + e.x * f3.z};
}

std::array<Vec3, 3> Solid::displacement_gradient(const Field& u, int block, int quad, int station) const {
  const KernelData<double>& d = data_[block].kernel;
  const StationScale<double> st{d.inv_sigma[station], d.inv_c[station], 0, 0, 0, d.sigma[station], d.c[station]};
  const auto k = element_kinematics<SweepKind::revolve, double>(
      d.quads[quad], st, corners_of(layout_.blocks[block], body_.blocks[block].section.quads[quad], u, station));
  return {Vec3{k.h1[0], k.h1[1], k.h1[2]}, Vec3{k.h2[0], k.h2[1], k.h2[2]}, Vec3{k.h3[0], k.h3[1], k.h3[2]}};
}

Vec3 Solid::reference_position(int block, int node, int station) const {
  const Block& b = body_.blocks[block];
  return swept_point(body_.kind, body_.origin, b.section.nodes[node], b.stations.at[station]);
}

Solid::StepBound Solid::element_step_bound() const {
  StepBound best{std::numeric_limits<double>::infinity(), 0, 0, 0};
  for (int b = 0; b < static_cast<int>(data_.size()); ++b) {
    const BlockData& d = data_[b];
    const int quads = static_cast<int>(d.kernel.quads.size()), classes = static_cast<int>(d.classes.size());
    std::vector<double> step(static_cast<std::size_t>(quads) * classes);
    for_each(static_cast<std::ptrdiff_t>(step.size()), [&](std::ptrdiff_t i) {
      const int q = static_cast<int>(i % quads);
      const SpacingClass& mine = d.classes[i / quads];
      step[i] = element_stable_step(body_.kind, corners(b, q), sweep_scale(body_.kind, mine.spacing),
                                    materials_[body_.blocks[b].section.quad_material[q]],
                                    d.kernel.hourglass[mine.hourglass * quads + q]);
    });
    const auto smallest = std::min_element(step.begin(), step.end()) - step.begin();
    if (step[smallest] < best.step) {
      const int cls = static_cast<int>(smallest / quads);
      const int station =
          static_cast<int>(std::find(d.element_class.begin(), d.element_class.end(), cls) - d.element_class.begin());
      best = {step[smallest], b, static_cast<int>(smallest % quads), station};
    }
  }
  return best;
}

}  // namespace railstrata
