#include "post/stress_cycles.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/rotation.hpp"

namespace railstrata {
namespace {

constexpr double kBehind = 3, kNear = 1.15, kBeside = 1.5;  // semi-axes of the patch that cycles are followed to
constexpr int kMostSamples = 160, kMostColumns = 50, kFarSamples = 12;

/// First and last cell of a direction that carry pressure.
struct Extent {
  int first = 0, last = 0;
  double middle() const { return 0.5 * (first + last); }
  double half() const { return 0.5 * (last - first + 1); }
};

struct PatchExtent {
  Extent x, y;  ///< in cells
};

PatchExtent extent_of(const ContactField& f) {
  PatchExtent e{{f.stations, -1}, {f.columns, -1}};
  for (int s = 0; s < f.stations; ++s)
    for (int c = 0; c < f.columns; ++c) {
      if (!(f.p[static_cast<std::size_t>(s) * f.columns + c] > 0)) continue;
      e.x = {std::min(e.x.first, s), std::max(e.x.last, s)};
      e.y = {std::min(e.y.first, c), std::max(e.y.last, c)};
    }
  return e;
}

/// Every n-th cell of a direction out to `reach` semi-axes; cells may lie outside the grid (negative, or beyond it).
std::vector<int> sampled(const Extent& e, double reach, int most) {
  const int from = static_cast<int>(std::floor(e.middle() - reach * e.half())),
            to = static_cast<int>(std::ceil(e.middle() + reach * e.half())),
            stride = std::max(1, (to - from) / most + 1);
  std::vector<int> out;
  for (int i = from; i <= to; i += stride) out.push_back(i);
  return out;
}

/// Densely as far as the patch and a little beyond, then every few cells.
std::vector<int> sampled_along(const Extent& e) {
  const std::vector<int> near = sampled(e, kNear, kMostSamples);
  const int apart = std::max(1, static_cast<int>((kBehind - kNear) * e.half() / kFarSamples));
  std::vector<int> out;
  for (int k = kFarSamples; k > 0; --k) out.push_back(near.front() - k * apart);
  out.insert(out.end(), near.begin(), near.end());
  for (int k = 1; k <= kFarSamples; ++k) out.push_back(near.back() + k * apart);
  return out;
}

struct Sampling {
  std::vector<int> x, y;  ///< cells of the patch's grid
  int more_x = 0, more_y = 0;
};

Sampling sampling_of(const BemPatch& patch) {
  const PatchExtent e = extent_of(patch.field);
  Sampling s{sampled_along(e.x), patch.grid.line ? std::vector<int>{0} : sampled(e.y, kBeside, kMostColumns)};
  s.more_x = std::max({0, -s.x.front(), s.x.back() - patch.grid.nx + 1});
  s.more_y = std::max({0, -s.y.front(), s.y.back() - patch.grid.ny + 1});
  return s;
}

bool below_interface(const std::vector<CycleRow>& rows, std::size_t r) {
  return r > 0 && rows[r].depth == rows[r - 1].depth;
}

/// The surface at the edge of the patch. Cells miss the peak there: inside it rises as the root of the distance to the
/// edge, as the pressure falls. What is left of sigma_xx + p and sigma_yy + 2 nu p is smooth (of a circular contact:
/// [Johnson1985 eq. 3.43]); it is extrapolated from the two cells behind the outermost to the edge, where p² is zero.
/// The first sample beyond the edge takes it.
///
/// And at the front of slip, where |q| has a cusp (post/patch.hpp, shear_at_front_of_slip): its stresses rise as a root
/// on the slipping side and are smooth on the sticking one, from where they are extrapolated; shear is f p there. The
/// sticking sample next to the front takes it.
class SurfacePeaks {
 public:
  SurfacePeaks(const BemPatch& patch, const StatePlane& surface, const Subsurface& body, const Sampling& at)
      : patch_(patch), surface_(surface), body_(body), at_(at), poisson_(body.material_at(0).poisson) {}

  /// Samples of one column of the patch's cells.
  void put(int column, Sym3* cycle) const {
    if (column < 0 || column >= patch_.grid.ny) return;
    int first = 0, last = patch_.grid.nx - 1;
    while (first <= last && !(pressure(first, column) > 0)) ++first;
    while (last >= first && !(pressure(last, column) > 0)) --last;
    constexpr int kLeastCells = 4;
    if (last - first + 1 < kLeastCells) return;
    const auto begin = at_.x.begin(), behind = std::lower_bound(begin, at_.x.end(), first),
               ahead = std::upper_bound(begin, at_.x.end(), last);
    if (behind != begin) cycle[behind - begin - 1] = at_edge(first, column, 1);
    if (ahead != at_.x.end()) cycle[ahead - begin] = at_edge(last, column, -1);
    for (int i = first; i < last; ++i) {
      if (slips(i, column) && sticks(i + 1, column)) put_front(i, 1, last, column, cycle);
      if (sticks(i, column) && slips(i + 1, column)) put_front(i + 1, -1, first, column, cycle);
    }
  }

 private:
  /// Of the field, which has several columns for the one of a line contact.
  std::size_t point(int i, int column) const {
    return static_cast<std::size_t>(i) * patch_.field.columns + static_cast<std::size_t>(column);
  }
  double pressure(int i, int column) const { return patch_.field.p[point(i, column)]; }
  double shear(int i, int column) const {
    return std::hypot(patch_.field.q_x[point(i, column)], patch_.field.q_y[point(i, column)]);
  }
  bool slips(int i, int column) const { return patch_.field.state[point(i, column)] == ContactState::slip; }
  bool sticks(int i, int column) const { return patch_.field.state[point(i, column)] == ContactState::stick; }
  Sym3 stress(int i, int column) const {
    return body_.stress(surface_, body_.grid().index(i + at_.more_x, column + at_.more_y));
  }

  /// The front between a slipping cell and the sticking ones at `slipping` + `on`, + 2 `on`, … to `end`.
  void put_front(int slipping, int on, int end, int column, Sym3* cycle) const {
    const int near = slipping + on, next = near + on, far = next + on;
    const auto sample = std::lower_bound(at_.x.begin(), at_.x.end(), near);
    const bool room = on > 0 ? far <= end : far >= end;
    if (!room || !sticks(next, column) || !sticks(far, column) || !(shear(slipping, column) > 0)) return;
    if (sample == at_.x.end() || *sample != near) return;
    const double f = shear(slipping, column) / pressure(slipping, column);
    const auto left = [&](int i) { return std::pow(f * pressure(i, column) - shear(i, column), 2); };
    const double rise = left(next) - left(near), back = rise > 0 ? std::min(left(near) / rise, 1.0) : 1.0;
    const double p = pressure(near, column) + back * (pressure(slipping, column) - pressure(near, column));
    const Sym3 slip = stress(slipping, column), a = stress(next, column), b = stress(far, column);
    const double share = f * p / shear(slipping, column);
    Sym3 front = a + (1 + back) * (a - b);
    front.zz = -p;
    front.xz = share * slip.xz;
    front.yz = share * slip.yz;
    cycle[sample - at_.x.begin()] = front;
  }

  Sym3 smooth(int i, int column) const {
    Sym3 s = stress(i, column);
    s.xx += pressure(i, column);
    s.yy += 2 * poisson_ * pressure(i, column);
    s.zz = s.xz = s.yz = 0;
    return s;
  }

  Sym3 at_edge(int outermost, int column, int inward) const {
    const double outer = std::pow(pressure(outermost, column), 2),
                 inner = std::pow(pressure(outermost + inward, column), 2);
    const double beyond = inner > outer ? std::min(outer / (inner - outer), 1.0) : 1.0;  // cells, from the outermost
    const Sym3 a = smooth(outermost + inward, column), b = smooth(outermost + 2 * inward, column);
    return a + (1 + beyond) * (a - b);
  }

  const BemPatch& patch_;
  const StatePlane& surface_;
  const Subsurface& body_;
  const Sampling& at_;
  double poisson_;
};

StressHistory half_space_cycles(const Subsurface& interior, const BemPatch& patch, const std::vector<CycleRow>& rows) {
  const Sampling at = sampling_of(patch);
  const std::unique_ptr<Subsurface> wide = interior.widened(at.more_x, at.more_y);
  const PatchGrid& g = wide->grid();
  StressHistory out;
  for (const int i : at.x) out.x.push_back(patch.grid.x(i));
  for (const int j : at.y) out.y.push_back(patch.grid.y(j));
  for (const CycleRow& row : rows) {
    out.depth.push_back(row.depth);
    out.zone.push_back(row.zone);
  }
  out.stress.resize(rows.size() * at.x.size() * at.y.size());
  StatePlane plane;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const bool below = below_interface(rows, r);
    if (!below) plane = wide->plane(rows[r].depth);
    for (std::size_t c = 0; c < at.y.size(); ++c) {
      Sym3* cycle = out.cycle(static_cast<int>(r), static_cast<int>(c));
      for (std::size_t s = 0; s < at.x.size(); ++s)
        cycle[s] = wide->stress(plane, g.index(at.x[s] + at.more_x, at.y[c] + at.more_y), below);
      if (rows[r].depth == 0) SurfacePeaks(patch, plane, *wide, at).put(at.y[c], cycle);
    }
  }
  return out;
}

}  // namespace

std::vector<CycleRow> cycle_rows(const LayeredHalfSpace& body, double shorter) {
  constexpr double kFirst = 0.02, kStep = 0.04, kFineTo = 1.6, kGrowth = 1.15, kDeepest = 4;
  std::vector<double> wanted{0, kFirst * shorter};
  for (double z = kStep; z <= kFineTo; z += kStep) wanted.push_back(z * shorter);
  while (wanted.back() < kDeepest * shorter) wanted.push_back(kGrowth * wanted.back());
  std::vector<CycleRow> rows;
  const auto add = [&](double top, double bottom, int zone, int least) {
    std::vector<double> inside{top, bottom};
    const double apart = 0.5 * kFirst * shorter;
    for (const double z : wanted)
      if (z > top + apart && z < bottom - apart) inside.push_back(z);
    for (int k = 1; k + 1 < least && static_cast<int>(inside.size()) < least; ++k)
      inside.push_back(top + (bottom - top) * k / (least - 1));
    std::sort(inside.begin(), inside.end());
    for (const double z : inside) rows.push_back({z, zone});
  };
  constexpr int kLeastRows = 4;
  double top = 0;
  int zone = 0;
  for (const LayerExtent& layer : layer_extents(body)) {
    add(layer.top, layer.bottom, ++zone, kLeastRows);
    top = layer.bottom;
  }
  add(top, std::max(wanted.back(), top + shorter), 0, kLeastRows);
  return rows;
}

namespace {

/// Rows of a band: where each takes its stresses from.
struct BandRow {
  enum class From { surface, centre, interface_above, interface_below } from;
  int row;
};

std::vector<BandRow> band_rows(const BandStress& b) {
  std::vector<BandRow> rows{{BandRow::From::surface, 0}};
  for (int r = 0; r < b.sample.rows; ++r) {
    if (r > 0 && layer_of(b, b.sample.columns / 2, r) != layer_of(b, b.sample.columns / 2, r - 1)) {
      rows.push_back({BandRow::From::interface_above, r});
      rows.push_back({BandRow::From::interface_below, r});
    }
    rows.push_back({BandRow::From::centre, r});
  }
  return rows;
}

/// The rail's z axis points down into it, the wheel's up: stresses of the model frame in the axes of a column whose
/// surface rises with `angle` towards the field side, and of the wheel's station at x.
Sym3 in_column_frame(const Sym3& stress, double angle, double radius, double x) {
  Sym3 s = roll(rotation_by(-angle), stress);
  if (radius > 0) {  // about y, by the station's azimuth; small
    const double t = x / radius, c = std::cos(t), d = std::sin(t);
    s = {c * c * s.xx + 2 * c * d * s.xz + d * d * s.zz,
         s.yy,
         d * d * s.xx - 2 * c * d * s.xz + c * c * s.zz,
         c * s.xy + d * s.yz,
         c * s.yz - d * s.xy,
         (c * c - d * d) * s.xz + c * d * (s.zz - s.xx)};
    return s;
  }
  s.yz = -s.yz;
  s.xz = -s.xz;
  return s;
}

Sym3 band_stress_of(const BandStress& b, const std::vector<Sym3>& surface, const BandRow& row, int c, int s) {
  switch (row.from) {
    case BandRow::From::surface: {
      const std::size_t nodes = static_cast<std::size_t>(b.sample.columns) + 1, k = s * nodes + c;
      return 0.25 * (surface[k] + surface[k + 1] + surface[k + nodes] + surface[k + nodes + 1]);
    }
    case BandRow::From::centre:
      return b.at(c, row.row, s);
    default:
      return stress_at_interface(b, c, row.row, s, row.from == BandRow::From::interface_below);
  }
}

double depth_of(const BandStress& b, const BandRow& row) {
  if (row.from == BandRow::From::surface) return 0;
  return row.from == BandRow::From::centre ? b.centre_depth[row.row] : b.body->contact.depth[row.row];
}

}  // namespace

StressHistory band_cycles(const BandStress& b, const std::vector<Sym3>& surface, double radius) {
  const auto& nodes = b.body->blocks[b.body->contact.block].section.nodes;
  const std::vector<BandRow> rows = band_rows(b);
  StressHistory out;  // without the border, where no surface stress is recovered
  for (int s = 1; s + 1 < b.sample.stations; ++s) out.x.push_back(b.x(s));
  for (int c = 1; c + 1 < b.sample.columns; ++c) out.y.push_back(b.centre_y[c] - b.contact_y);
  for (const BandRow& row : rows) {
    out.depth.push_back(depth_of(b, row));
    out.zone.push_back(
        layer_of(b, b.sample.columns / 2, row.from == BandRow::From::interface_above ? row.row - 1 : row.row));
  }
  out.stress.resize(rows.size() * out.x.size() * out.y.size());
  for (int r = 0; r < out.rows(); ++r)
    for (int c = 0; c < out.columns(); ++c) {
      const double angle = std::atan2(nodes[c + 2].z - nodes[c + 1].z, nodes[c + 2].y - nodes[c + 1].y);
      for (int s = 0; s < out.samples(); ++s)
        out.cycle(r, c)[s] =
            in_column_frame(band_stress_of(b, surface, rows[r], c + 1, s + 1), angle, radius, out.x[s]);
    }
  return out;
}

StressHistory rail_cycles(const BemResult& result, const BemPatch& patch, const std::vector<CycleRow>& rows) {
  return half_space_cycles(rail_interior(result.rail, patch), patch, rows);
}

StressHistory wheel_cycles(const BemResult& result, const BemPatch& patch, const std::vector<CycleRow>& rows) {
  return half_space_cycles(wheel_interior(result.wheel, patch), patch, rows);
}

}  // namespace railstrata
