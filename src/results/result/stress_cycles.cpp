#include "result/stress_cycles.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "result/surface_peaks.hpp"

namespace railstrata {
namespace {

constexpr double kBehind = 3, kNear = 1.15, kBeside = 1.5;  // semi-axes of the patch that cycles are followed to
constexpr int kMostSamples = 160, kMostColumns = 50, kFarSamples = 12;

/// First and last cell of a direction that carry pressure.
struct CellExtent {
  int first = 0, last = 0;
  double middle() const { return 0.5 * (first + last); }
  double half() const { return 0.5 * (last - first + 1); }
};

struct PatchExtent {
  CellExtent x, y;  ///< in cells
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
std::vector<int> sampled(const CellExtent& e, double reach, int most) {
  const int from = static_cast<int>(std::floor(e.middle() - reach * e.half())),
            to = static_cast<int>(std::ceil(e.middle() + reach * e.half())),
            stride = std::max(1, (to - from) / most + 1);
  std::vector<int> out;
  for (int i = from; i <= to; i += stride) out.push_back(i);
  return out;
}

/// Densely as far as the patch and a little beyond, then every few cells.
std::vector<int> sampled_along(const CellExtent& e) {
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

Sampling sampling_of(const BemPatch& patch, const std::optional<AcrossRange>& across) {
  const PatchExtent e = extent_of(patch.field);
  Sampling s{sampled_along(e.x), patch.grid.line ? std::vector<int>{0} : sampled(e.y, kBeside, kMostColumns)};
  if (across && !patch.grid.line) {
    const auto cell = [&](double y) { return (y - patch.grid.y0) / patch.grid.dy; };
    const int from = static_cast<int>(std::floor(cell(across->from))),
              to = static_cast<int>(std::ceil(cell(across->to)));
    s.y.clear();
    for (int j = from; j <= to; j += std::max(1, (to - from) / kMostColumns + 1)) s.y.push_back(j);
  }
  s.more_x = std::max({0, -s.x.front(), s.x.back() - patch.grid.nx + 1});
  s.more_y = std::max({0, -s.y.front(), s.y.back() - patch.grid.ny + 1});
  return s;
}

bool below_interface(const std::vector<CycleRow>& rows, std::size_t r) {
  return r > 0 && rows[r].depth == rows[r - 1].depth;
}

/// The samples of a column of the patch's cells at the surface, with the peaks between them: the first sample beyond an
/// edge takes the edge's, the sticking one next to a front of slip that of the front.
void put_peaks(const BemPatch& patch, const StatePlane& surface, const Subsurface& body, const Sampling& at, int column,
               Sym3* cycle) {
  if (column < 0 || column >= patch.grid.ny) return;
  const auto stress = [&](int i) { return body.stress(surface, body.grid().index(i + at.more_x, column + at.more_y)); };
  SurfaceRow row{{}, {}, {}, stress, body.material_at(0).poisson, true};
  for (int i = 0; i < patch.grid.nx; ++i) {
    const std::size_t k = static_cast<std::size_t>(i) * patch.field.columns + column;  // a line contact has several
    row.p.push_back(patch.field.p[k]);
    row.q.push_back(std::hypot(patch.field.q_x[k], patch.field.q_y[k]));
    row.state.push_back(patch.field.state[k]);
  }
  const SurfacePeaks peaks = surface_peaks(row);
  if (!peaks.any()) return;
  const auto begin = at.x.begin(), behind = std::lower_bound(begin, at.x.end(), peaks.first),
             ahead = std::upper_bound(begin, at.x.end(), peaks.last);
  if (behind != begin) cycle[behind - begin - 1] = peaks.behind;
  if (ahead != at.x.end()) cycle[ahead - begin] = peaks.ahead;
  for (const SurfacePeaks::Front& front : peaks.fronts)
    if (const auto sample = std::lower_bound(begin, at.x.end(), front.at); sample != at.x.end() && *sample == front.at)
      cycle[sample - begin] = front.stress;
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

StressHistory half_space_cycles(const BemResult& result, BodyId body, const BemPatch& patch,
                                const std::vector<CycleRow>& rows, const std::optional<AcrossRange>& across) {
  const Subsurface interior =
      body == BodyId::rail ? rail_interior(result.rail, patch) : wheel_interior(result.wheel, patch);
  const Sampling at = sampling_of(patch, across);
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
      if (rows[r].depth == 0) put_peaks(patch, plane, *wide, at, at.y[c], cycle);
    }
  }
  return out;
}

}  // namespace railstrata
