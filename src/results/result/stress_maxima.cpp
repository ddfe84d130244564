#include "result/stress_maxima.hpp"

#include <algorithm>
#include <cmath>

#include "core/callable_ref.hpp"
#include "core/parabola.hpp"
#include "model/zone.hpp"
#include "result/band_surface.hpp"

namespace railstrata {
namespace {

double largest_principal(const Sym3& s) { return principal_stresses(s).x; }
using Measure = double (*)(const Sym3&);

void offer(StressMaximum& best, const StressMaximum& other) {
  if (std::isnan(best.value) || other.value > best.value) best = other;
}
void offer(StressPair& best, const StressPair& other) {
  offer(best.von_mises, other.von_mises);
  offer(best.sigma1, other.sigma1);
}

/// The points of a band at one depth, in the material of a row.
struct BandPlane {
  enum class Kind { centre, border, between };
  double depth = 0;
  int row = 0;
  Kind kind = Kind::centre;
};

/// The largest stresses of a band's planes.
class BandSearch {
 public:
  /// Whether a place of a plane counts.
  using Wanted = CallableRef<bool(const BandPlane&, int column, int station)>;

  explicit BandSearch(const BandStress& band) : band_(band) {}

  StressPair largest(const std::vector<BandPlane>& planes, const Wanted& wanted) const {
    StressPair best;
    for (const BandPlane& plane : planes)
      offer(best, {largest(plane, von_mises, wanted), largest(plane, largest_principal, wanted)});
    return best;
  }

  /// From `begin` down: the plane there, element centres and both sides of every face between rows.
  std::vector<BandPlane> planes(double begin) const {
    const std::vector<double>& face = band_.body->contact.depth;
    std::vector<BandPlane> out;
    for (int r = 0; r < band_.sample.rows; ++r) {
      if (face[r] <= begin && begin < face[r + 1]) out.push_back({begin, r, BandPlane::Kind::between});
      if (band_.centre_depth[r] > begin) out.push_back({band_.centre_depth[r], r, BandPlane::Kind::centre});
      if (r == 0 || face[r] < begin) continue;
      out.push_back({face[r], r - 1, BandPlane::Kind::border});
      out.push_back({face[r], r, BandPlane::Kind::border});
    }
    return out;
  }

  /// Whether a plane is there at a place: a face counts where two materials meet.
  bool exists(const BandPlane& plane, int column, int station) const {
    if (plane.kind != BandPlane::Kind::border) return true;
    const int other = plane.depth < band_.centre_depth[plane.row] ? plane.row - 1 : plane.row + 1;
    return band_.layer(column, plane.row, station) != band_.layer(column, other, station);
  }

 private:
  double value(const BandPlane& plane, Measure measure, int column, int station) const {
    return measure(stress_at_depth(band_, column, plane.row, station, plane.depth));
  }

  StressMaximum largest(const BandPlane& plane, Measure measure, const Wanted& wanted) const {
    StressMaximum best;
    int column = 0, station = 0;
    for (int s = 0; s < band_.sample.stations; ++s)
      for (int c = 0; c < band_.sample.columns; ++c) {
        if (!wanted(plane, c, s)) continue;
        const double here = value(plane, measure, c, s);
        if (!std::isnan(best.value) && here <= best.value) continue;
        best = {here, band_.x(s), band_.centre_y[c] - band_.contact_y, plane.depth};
        column = c;
        station = s;
      }
    if (!std::isnan(best.value)) refine(plane, measure, wanted, column, station, best);
    return best;
  }

  /// A place of a plane and its coordinate along a line of neighbours.
  struct Neighbour {
    BandPlane plane;
    int column, station;
    double at;
  };

  /// By parabolas through the neighbours along the rail, across it and, of element centres, in depth.
  void refine(const BandPlane& plane, Measure measure, const Wanted& wanted, int c, int s, StressMaximum& best) const {
    const double top = best.value;
    const auto between = [&](const Neighbour& before, const Neighbour& after, double& at) {
      for (const Neighbour* n : {&before, &after})
        if (!wanted(n->plane, n->column, n->station)) return;
      const double first = value(before.plane, measure, before.column, before.station),
                   last = value(after.plane, measure, after.column, after.station);
      if (first > top || last > top) return;
      const ParabolaTop t = parabola_top(before.at, first, at, top, after.at, last);
      at = t.at;
      best.value += t.above;
    };
    const auto y = [&](int k) { return band_.centre_y[k] - band_.contact_y; };
    const int r = plane.row;
    if (s > 0 && s + 1 < band_.sample.stations)
      between({plane, c, s - 1, band_.x(s - 1)}, {plane, c, s + 1, band_.x(s + 1)}, best.x);
    if (c > 0 && c + 1 < band_.sample.columns)
      between({plane, c - 1, s, y(c - 1)}, {plane, c + 1, s, y(c + 1)}, best.y);
    if (plane.kind == BandPlane::Kind::centre && r > 0 && r + 1 < band_.sample.rows) {
      const double above = band_.centre_depth[r - 1], below = band_.centre_depth[r + 1];
      between({{above, r - 1}, c, s, above}, {{below, r + 1}, c, s, below}, best.depth);
    }
  }

  const BandStress& band_;
};

/// layer_begin: where the first layer begins; begin: what counts as subsurface.
void below_surface(const BandStress& b, double layer_begin, double begin, bool layered, StressSummary& out) {
  const BandSearch search(b);
  const auto anywhere = [&](const BandPlane& p, int c, int s) { return search.exists(p, c, s); };
  out.subsurface = search.largest(search.planes(begin), anywhere);
  if (!layered) return;
  // where a layer has ended the sample may have none of it
  const auto if_any = [](const StressPair& pair) {
    return std::isnan(pair.von_mises.value) ? std::nullopt : std::optional(pair);
  };
  const auto in_layer = [&](const BandPlane& p, int c, int s) {
    return b.layer(c, p.row, s) > 0 && search.exists(p, c, s);
  };
  const auto in_matrix = [&](const BandPlane& p, int c, int s) {
    return b.layer(c, p.row, s) == 0 && search.exists(p, c, s);
  };
  const auto at_border = [&](const BandPlane& p, int c, int s) {
    return p.kind == BandPlane::Kind::border && search.exists(p, c, s);
  };
  const std::vector<BandPlane> planes = search.planes(layer_begin);
  out.layer = if_any(search.largest(planes, in_layer));
  out.matrix = if_any(search.largest(planes, in_matrix));
  out.interface = if_any(search.largest(planes, at_border));
}

StressPair at_surface(const BandStress& b, const BandSurface& surface) {
  StressPair best;
  const auto& nodes = b.body->blocks[b.body->contact.block].section.nodes;
  for (int c = 1; c < b.sample.columns; ++c) {
    const std::vector<Sym3> stresses = surface_column(b, surface, c);
    const double y = nodes[c].y - b.contact_y;
    for (std::size_t k = 0; k < stresses.size(); ++k) {
      const double x = b.sample.along[k + 1];
      offer(best, {{von_mises(stresses[k]), x, y, 0}, {largest_principal(stresses[k]), x, y, 0}});
    }
  }
  return best;
}

}  // namespace

StressSummary band_stress_summary(const RollingSystem& sys, BodyId id, const MeanContact& m) {
  const bool rail = id == BodyId::rail;
  const SweptBody& body = rail ? sys.model.rail : sys.model.wheel;
  const CaseSpec& spec = sys.model.spec;
  const std::vector<std::size_t> layers = layers_on(spec, id);
  const double layer_begin =
      subsurface_begin(m.patch, layers.empty() ? HUGE_VAL : spec.layers[layers.front()].thickness);
  const BandStress band =
      band_stress(body, rail ? m.rail : m.wheel, sys.model.placement.contact.point.y - body.origin.y);
  StressSummary out;
  below_surface(band, layer_begin, std::max(spec.mesh.element_size, layer_begin), !layers.empty(), out);
  out.surface = at_surface(band, band_surface(sys, id, m));
  return out;
}

}  // namespace railstrata
