#include "fem/solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace railstrata {
namespace {

constexpr int kTile = 64;  // elements along the sweep; a multiple of every pack width

}  // namespace

std::array<Vec2, 4> Solid::corners(int block, int quad) const {
  const Section& s = body_.blocks[block].section;
  const auto& q = s.quads[quad];
  return {s.nodes[q[0]], s.nodes[q[1]], s.nodes[q[2]], s.nodes[q[3]]};
}

Solid::Solid(const SweptBody& body, const std::vector<Elastic>& materials, const SolidOptions& options) : body_(body), layout_(layout_of(body)), materials_(materials) {
  mass_ = layout_.field();
  std::ptrdiff_t spill = 0;
  for (int b = 0; b < static_cast<int>(body_.blocks.size()); ++b) {
    const Block& block = body_.blocks[b];
    const BlockLayout& lay = layout_.blocks[b];
    const int padded = whole_packs(lay.elements), quads = static_cast<int>(block.section.quads.size());
    BlockData d;
    d.spacing_class.resize(padded);
    for (Field* a : {&d.inv_sigma, &d.inv_c, &d.v1, &d.v2, &d.v3, &d.sigma, &d.c, &d.theta, &d.cos_q, &d.sin_q}) a->assign(padded, 0.0);
    for (int e = 0; e < lay.elements; ++e) {
      const double t0 = block.stations.at[e];
      const double t1 = e + 1 < lay.stations ? block.stations.at[e + 1] : block.stations.at[0] + 2 * std::numbers::pi;
      const double spacing = t1 - t0;
      auto known = std::find_if(d.spacings.begin(), d.spacings.end(), [&](double s) { return std::abs(s - spacing) < 1e-9 * spacing; });
      d.spacing_class[e] = static_cast<int>(known - d.spacings.begin());
      if (known == d.spacings.end()) d.spacings.push_back(spacing);
      const SweepScale scale = sweep_scale(body_.kind, d.spacings[d.spacing_class[e]]);
      d.inv_sigma[e] = 1 / scale.sigma, d.inv_c[e] = 1 / scale.c;
      d.v1[e] = scale.c, d.v2[e] = scale.sigma * scale.c, d.v3[e] = scale.sigma;
      d.sigma[e] = scale.sigma, d.c[e] = scale.c;
      d.theta[e] = body_.kind == SweepKind::revolve ? 0.5 * (t0 + t1) : 0.0;
      d.cos_q[e] = std::cos(d.theta[e]), d.sin_q[e] = std::sin(d.theta[e]);
    }
    const int classes = static_cast<int>(d.spacings.size());
    std::fill(d.spacing_class.begin() + lay.elements, d.spacing_class.end(), classes);
    d.quads.reserve(quads);
    for (int q = 0; q < quads; ++q) d.quads.push_back(quad_reference(body_.kind, corners(b, q), materials_[block.section.quad_material[q]]));
    d.hourglass.assign(static_cast<std::size_t>(classes + 1) * quads, HourglassStiffness{});
    for_each(static_cast<std::ptrdiff_t>(classes) * quads, [&](std::ptrdiff_t i) {
      const int q = static_cast<int>(i % quads);
      d.hourglass[i] = hourglass_stiffness(body_.kind, corners(b, q), sweep_scale(body_.kind, d.spacings[i / quads]), materials_[block.section.quad_material[q]], options.element,
                                           options.hourglass_coefficient);
    });

    for (int e = 0; e < lay.elements; ++e) {
      const int next = e + 1 < lay.stations ? e + 1 : 0;
      const SweepScale scale{d.sigma[e], d.c[e]};
      for (int q = 0; q < quads; ++q) {
        const auto m = corner_masses(body_.kind, corners(b, q), scale, materials_[block.section.quad_material[q]].density);
        for (int k = 0; k < 4; ++k)
          for (int i = 0; i < 3; ++i) {
            const std::ptrdiff_t line = lay.line(block.section.quads[q][k], i);
            mass_[line + e] += m[k];
            mass_[line + next] += m[k];
          }
      }
    }
    first_tile_.push_back(static_cast<int>(tiles_.size()));
    for (int first = 0; first < lay.elements; first += kTile) {
      tiles_.push_back({b, first, std::min(first + kTile, padded), spill});
      spill += static_cast<std::ptrdiff_t>(lay.nodes) * 3;
    }
    frame_offset_.push_back(frame_size_);
    frame_size_ += padded;
    data_.push_back(std::move(d));
  }
  first_tile_.push_back(static_cast<int>(tiles_.size()));
  spill_.assign(spill, 0.0);
  cos_r_.assign(frame_size_, 0.0);
  sin_r_.assign(frame_size_, 0.0);
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

void Solid::turned_frames(double psi, Field& cos_r, Field& sin_r) const {
  const double cp = std::cos(psi), sp = std::sin(psi);
  for (std::size_t b = 0; b < data_.size(); ++b) {
    const BlockData& d = data_[b];
    const std::ptrdiff_t o = frame_offset_[b];
    for (std::size_t e = 0; e < d.cos_q.size(); ++e) {
      cos_r[o + e] = d.cos_q[e] * cp + d.sin_q[e] * sp;  // theta - psi
      sin_r[o + e] = d.sin_q[e] * cp - d.cos_q[e] * sp;
    }
  }
}

namespace {

// Corner values of a pack of elements: sums and differences over the two stations.
struct LinePointers {
  const double* u[4][3];
};

inline void gather(const LinePointers& p, int e, Pack (&s)[4][3], Pack (&d)[4][3]) {
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i) {
      const Pack left = load(p.u[k][i] + e), right = load(p.u[k][i] + e + 1);
      s[k][i] = right + left;
      d[k][i] = right - left;
    }
}

// Hourglass stiffness of a pack whose elements have one spacing (scalars) or several (a lane each).
struct OneClass {
  const double* k;
  double operator()(int e) const { return k[e]; }
};
struct LaneClass {
  const double* k[kLanes];
  Pack operator()(int e) const {
    Pack v;
    for (int l = 0; l < kLanes; ++l) v[l] = k[l][e];
    return v;
  }
};

}  // namespace

template <bool linear>
void Solid::tile_forces(const Tile& tile, const Field& u, const Field& cos_r, const Field& sin_r, Field& f) const {
  const BlockData& d = data_[tile.block];
  const BlockLayout& lay = layout_.blocks[tile.block];
  const auto& quads = body_.blocks[tile.block].section.quads;
  for (std::ptrdiff_t line = 0; line < static_cast<std::ptrdiff_t>(lay.nodes) * 3; ++line) {
    double* out = f.data() + lay.offset + line * lay.stride;
    std::fill(out + tile.first, out + tile.last, 0.0);
  }
  double* spill = spill_.data() + tile.spill;
  std::fill(spill, spill + static_cast<std::ptrdiff_t>(lay.nodes) * 3, 0.0);

  const int packs = (tile.last - tile.first) / kLanes;
  StationScale<Pack> st[kTile / kLanes];
  int pack_class[kTile / kLanes];  // -1: several spacings in one pack
  for (int n = 0; n < packs; ++n) {
    const int e = tile.first + n * kLanes;
    st[n] = {load(&d.inv_sigma[e]), load(&d.inv_c[e]), load(&d.v1[e]), load(&d.v2[e]),   load(&d.v3[e]),
             load(&d.sigma[e]),     load(&d.c[e]),     load(&d.cos_q[e]), load(&d.sin_q[e]), load(&cos_r[frame_offset_[tile.block] + e]), load(&sin_r[frame_offset_[tile.block] + e])};
    pack_class[n] = d.spacing_class[e];
    for (int l = 1; l < kLanes; ++l)
      if (d.spacing_class[e + l] != pack_class[n]) pack_class[n] = -1;
  }

  for (std::size_t q = 0; q < quads.size(); ++q) {
    const QuadReference& ref = d.quads[q];
    LinePointers in;
    double* out[4][3];
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 3; ++i) {
        in.u[k][i] = u.data() + lay.line(quads[q][k], i);
        out[k][i] = f.data() + lay.line(quads[q][k], i);
      }
    Pack right[4][3] = {};
    for (int n = 0; n < packs; ++n) {
      const int e = tile.first + n * kLanes;
      Pack s[4][3], diff[4][3], sf[4][3], df[4][3];
      gather(in, e, s, diff);
      auto kin = element_kinematics(ref, st[n], s, diff);
      ElementStress<Pack> stress;
      if constexpr (linear) stress = linear_stress(ref, st[n], kin);
      else stress = nonlinear_stress(ref, st[n], kin);
      if (pack_class[n] >= 0) {
        hourglass_forces(OneClass{d.hourglass[pack_class[n] * quads.size() + q].data()}, st[n], kin);
      } else {
        LaneClass lanes;
        for (int l = 0; l < kLanes; ++l) lanes.k[l] = d.hourglass[d.spacing_class[e + l] * quads.size() + q].data();
        hourglass_forces(lanes, st[n], kin);
      }
      element_forces(ref, st[n], stress, kin, sf, df);
      for (int k = 0; k < 4; ++k)
        for (int i = 0; i < 3; ++i) {
          const Pack now = sf[k][i] + df[k][i];
          store(out[k][i] + e, load(out[k][i] + e) + (sf[k][i] - df[k][i]) + shift_in(right[k][i], now));
          right[k][i] = now;
        }
    }
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 3; ++i) spill[quads[q][k] * 3 + i] += right[k][i][kLanes - 1];
  }
}

template <bool linear>
void Solid::forces(Field& u, double psi, Field& f) const {
  refresh_ghosts(u);
  turned_frames(psi, cos_r_, sin_r_);
  for_each(static_cast<std::ptrdiff_t>(tiles_.size()), [&](std::ptrdiff_t t) { tile_forces<linear>(tiles_[t], u, cos_r_, sin_r_, f); }, true);
  for (int b = 0; b < static_cast<int>(layout_.blocks.size()); ++b) {
    const BlockLayout& l = layout_.blocks[b];
    for_each(static_cast<std::ptrdiff_t>(l.nodes) * 3, [&](std::ptrdiff_t line) {
      double* out = f.data() + l.offset + line * l.stride;
      for (int t = first_tile_[b]; t < first_tile_[b + 1]; ++t) {
        const int plane = tiles_[t].last;
        if (plane == l.elements) out[plane] = 0.0;  // the plane behind the last whole pack belongs to no tile
        out[plane] += spill_[tiles_[t].spill + line];
      }
      if (l.closed) out[0] += out[l.elements];
    });
  }
}

void Solid::internal_force(Field& u, double psi, Field& f) const { forces<false>(u, psi, f); }
void Solid::linear_force(Field& u, Field& f) const { forces<true>(u, 0.0, f); }

StrainEnergy Solid::energy(Field& u, double psi) const {
  refresh_ghosts(u);
  turned_frames(psi, cos_r_, sin_r_);
  std::vector<StrainEnergy> part(tiles_.size());
  for_each(
      static_cast<std::ptrdiff_t>(tiles_.size()),
      [&](std::ptrdiff_t t) {
        const Tile& tile = tiles_[t];
        const BlockData& d = data_[tile.block];
        const BlockLayout& lay = layout_.blocks[tile.block];
        const auto& quads = body_.blocks[tile.block].section.quads;
        Pack strain{}, hourglass{};
        for (std::size_t q = 0; q < quads.size(); ++q) {
          const QuadReference& ref = d.quads[q];
          LinePointers in;
          for (int k = 0; k < 4; ++k)
            for (int i = 0; i < 3; ++i) in.u[k][i] = u.data() + lay.line(quads[q][k], i);
          for (int e = tile.first; e < tile.last; e += kLanes) {
            const std::ptrdiff_t o = frame_offset_[tile.block] + e;
            const StationScale<Pack> st{load(&d.inv_sigma[e]), load(&d.inv_c[e]), load(&d.v1[e]),    load(&d.v2[e]),    load(&d.v3[e]), load(&d.sigma[e]),
                                        load(&d.c[e]),         load(&d.cos_q[e]), load(&d.sin_q[e]), load(&cos_r_[o]), load(&sin_r_[o])};
            Pack s[4][3], diff[4][3];
            gather(in, e, s, diff);
            auto kin = element_kinematics(ref, st, s, diff);
            const auto stress = nonlinear_stress(ref, st, kin);
            LaneClass lanes;
            for (int l = 0; l < kLanes; ++l) lanes.k[l] = d.hourglass[d.spacing_class[e + l] * quads.size() + q].data();
            hourglass += hourglass_forces(lanes, st, kin);
            const auto& a = stress.strain;
            const auto& b = stress.s;
            strain += 0.5 * ref.volume * st.v2 * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]));
          }
        }
        for (int l = 0; l < kLanes; ++l) part[t].strain += strain[l], part[t].hourglass += hourglass[l];
      },
      true);
  StrainEnergy sum;
  for (const StrainEnergy& p : part) sum.strain += p.strain, sum.hourglass += p.hourglass;
  return sum;
}

void Solid::stiffness_diagonal(Field& diagonal) const {
  std::fill(diagonal.begin(), diagonal.end(), 0.0);
  for (int b = 0; b < static_cast<int>(data_.size()); ++b) {
    const BlockData& d = data_[b];
    const BlockLayout& lay = layout_.blocks[b];
    const int quads = static_cast<int>(d.quads.size()), classes = static_cast<int>(d.spacings.size());
    // per (class, quad, corner): xx, yy, zz, xz of the corner's own block, element frame; the same at both stations but for the sign of xz
    std::vector<std::array<double, 32>> block(static_cast<std::size_t>(classes) * quads);
    for_each(static_cast<std::ptrdiff_t>(block.size()), [&](std::ptrdiff_t i) {
      const Matrix24 k = linear_stiffness(d.quads[i % quads], sweep_scale(body_.kind, d.spacings[i / quads]), d.hourglass[i]);
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
          const auto& k = block[static_cast<std::size_t>(d.spacing_class[e]) * quads + q];
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

struct OneElement {
  double s[4][3], d[4][3];
};

OneElement gather_one(const BlockLayout& l, const std::array<int, 4>& quad, const Field& u, int station) {
  OneElement out{};
  const int next = l.closed && station + 1 == l.stations ? 0 : station + 1;
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i) {
      const double a = u[l.line(quad[k], i) + station], b = u[l.line(quad[k], i) + next];
      out.s[k][i] = a + b;
      out.d[k][i] = b - a;
    }
  return out;
}

}  // namespace

Sym3 Solid::stress(const Field& u, int block, int quad, int station) const {
  const BlockData& d = data_[block];
  const QuadReference& ref = d.quads[quad];
  const OneElement c = gather_one(layout_.blocks[block], body_.blocks[block].section.quads[quad], u, station);
  const StationScale<double> st{d.inv_sigma[station], d.inv_c[station], d.v1[station],    d.v2[station],    d.v3[station], d.sigma[station],
                                d.c[station],         d.cos_q[station], d.sin_q[station], d.cos_q[station], d.sin_q[station]};
  const auto kin = element_kinematics(ref, st, c.s, c.d);
  const auto p = nonlinear_stress(ref, st, kin);
  // sigma = P F^T / det F, P and F with the element's frame as their right index
  const Vec3 f1{st.cos_q + kin.h1[0], kin.h1[1], st.sin_q + kin.h1[2]}, f2{kin.h2[0], 1 + kin.h2[1], kin.h2[2]}, f3{kin.h3[0] - st.sin_q, kin.h3[1], st.cos_q + kin.h3[2]};
  const double det = dot(f1, cross(f2, f3));
  const double(&a)[3] = p.p1;
  const double(&b)[3] = p.p2;
  const double(&e)[3] = p.p3;
  return (1 / det) * Sym3{a[0] * f1.x + b[0] * f2.x + e[0] * f3.x, a[1] * f1.y + b[1] * f2.y + e[1] * f3.y, a[2] * f1.z + b[2] * f2.z + e[2] * f3.z,
                          a[0] * f1.y + b[0] * f2.y + e[0] * f3.y, a[1] * f1.z + b[1] * f2.z + e[1] * f3.z, a[0] * f1.z + b[0] * f2.z + e[0] * f3.z};
}

std::array<Vec3, 3> Solid::displacement_gradient(const Field& u, int block, int quad, int station) const {
  const BlockData& d = data_[block];
  const OneElement c = gather_one(layout_.blocks[block], body_.blocks[block].section.quads[quad], u, station);
  const StationScale<double> st{d.inv_sigma[station], d.inv_c[station], 0, 0, 0, d.sigma[station], d.c[station], 1, 0, 1, 0};
  const auto k = element_kinematics(d.quads[quad], st, c.s, c.d);
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
    const int quads = static_cast<int>(d.quads.size()), classes = static_cast<int>(d.spacings.size());
    std::vector<double> step(static_cast<std::size_t>(quads) * classes);
    for_each(static_cast<std::ptrdiff_t>(step.size()), [&](std::ptrdiff_t i) {
      const int q = static_cast<int>(i % quads);
      step[i] = element_stable_step(body_.kind, corners(b, q), sweep_scale(body_.kind, d.spacings[i / quads]), materials_[body_.blocks[b].section.quad_material[q]], d.hourglass[i]);
    });
    const auto smallest = std::min_element(step.begin(), step.end()) - step.begin();
    if (step[smallest] < best.step) {
      const int cls = static_cast<int>(smallest / quads);
      const int station = static_cast<int>(std::find(d.spacing_class.begin(), d.spacing_class.end(), cls) - d.spacing_class.begin());
      best = {step[smallest], b, static_cast<int>(smallest % quads), station};
    }
  }
  return best;
}

}  // namespace railstrata
