#pragma once
// The search of the contact and the integrals of its rows: kernels of independent threads.
#include "device/contact_tables.hpp"

namespace railstrata::device {

/// Displacements of the rail's surface.
struct RailDisplacement {
  const SurfaceView& surface;
  const View<const double>& u;
  RAILSTRATA_POINTWISE Vec3 operator()(int column, int station) const {
    return gather(u, surface.index(column, station), surface.stride);
  }
};

/// Displacement of the wheel's nodes, in its own axes.
struct WheelDisplacement {
  const SurfaceView& surface;
  const View<const double>& u;
  const ReferenceFrame& frame;
  RAILSTRATA_POINTWISE Vec3 operator()(int column, int station) const {
    return own_displacement(frame, surface.node[column].z, surface.cosine[station], surface.sine[station],
                            RailDisplacement{surface, u}(column, station));
  }
};

/// Arguments of the kernels of the search.
struct SearchScope {
  ContactTables contact;
  View<const StepState> now;
  View<const double> u_rail, u_wheel;

  RAILSTRATA_POINTWISE Vec3 rail_point(int column, int station, double wy, double wx) const {
    return mortar_law::in_wheel_axes(
        contact.wheel,
        mortar_law::rail_point(contact.rail, RailDisplacement{contact.rail, u_rail}, column, station, wy, wx));
  }
  RAILSTRATA_POINTWISE Vec3 gauss_point(int column, int station, int g) const {
    return rail_point(column, station, mortar_law::gauss(g % 2), mortar_law::gauss(g / 2));
  }
  RAILSTRATA_POINTWISE mortar_law::Hit opposite(Vec3 p, Tangential correction) const {
    const StepState& s = now[0];
    const WheelDisplacement u{contact.wheel, u_wheel, s.wheel.frame};
    return mortar_law::opposite(contact.wheel, contact.wheel.sine, contact.wheel.cosine, u, s.on_wheel, s.turned, p,
                                correction);
  }
};

/// Which nodes of the window are near: an index for every slot.
struct TestNodes {
  SearchScope scope;
  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const ContactTables& t = scope.contact;
    const StepState& s = scope.now[0];
    const int slot = static_cast<int>(i), w = slot / t.inner, c = t.column_of(slot);
    int near_by = 0, edge = 0;
    if (w < s.window) {
      const Vec3 p = scope.rail_point(c, s.window_first + w, 0, 0), normal = yaw_back(t.wheel.yaw, t.normal(c));
      mortar_law::Hit h = scope.opposite(p, {});
      h = scope.opposite(p, {h.offset.x, h.offset.y});
      const double gap = dot(normal, h.offset);
      near_by = gap < t.search.gap && h.inside;
      edge = gap < 0 && (!h.inside || c == 1 || c == t.inner || w == 0 || w == s.window - 1);
    }
    t.found.near[slot] = near_by;
    t.found.at_edge[slot] = edge;
  }
};

/// Nodes that left the neighbourhood of the patch lose their tractions; facets that come to it get corrections: an
/// index for every node and facet of the rail's surface, [station * columns + column].
struct ChooseFacets {
  SearchScope scope;
  RAILSTRATA_POINTWISE bool chosen(int column, int station) const {
    const ContactTables& t = scope.contact;
    const int w = station - scope.now[0].window_first;
    if (w < 0 || w >= scope.now[0].window || column < 1 || column > t.inner) return false;
    return t.found.near[static_cast<std::ptrdiff_t>(w) * t.inner + column - 1] != 0;
  }
  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const ContactTables& t = scope.contact;
    const int c = static_cast<int>(i % t.rail.columns), j = static_cast<int>(i / t.rail.columns);
    if (!chosen(c, j)) t.traction(c, j) = apart(t.traction(c, j));
    const bool was = t.kept.active[i] != 0,
               is = chosen(c, j) || chosen(c + 1, j) || chosen(c, j + 1) || chosen(c + 1, j + 1);
    t.kept.active[i] = is;
    if (!is) return;
    for (int g = 0; g < 4; ++g) {
      Tangential& correction = t.kept.corrections[4 * i + g];
      if (was && (correction.x != 0 || correction.y != 0)) continue;
      const mortar_law::Hit h = scope.opposite(scope.gauss_point(c, j, g), {});
      correction = {h.offset.x, h.offset.y};
    }
  }
};

/// The wheel opposite the facets' Gauss points: an index for each of them.
struct UpdateHits {
  SearchScope scope;
  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const ContactTables& t = scope.contact;
    const StepState& s = scope.now[0];
    const int g = static_cast<int>(i % 4), c = static_cast<int>(i / 4 % t.rail.columns),
              w = static_cast<int>(i / 4 / t.rail.columns), j = s.window_first + w - 1;
    if (w > s.window) return;
    const std::ptrdiff_t facet = static_cast<std::ptrdiff_t>(j) * t.rail.columns + c;
    if (!t.kept.active[facet]) return;
    Tangential& correction = t.kept.corrections[4 * facet + g];
    const mortar_law::Hit h = scope.opposite(scope.gauss_point(c, j, g), correction);
    correction = correction + Tangential{h.offset.x, h.offset.y};
    t.hits[i] = h;
  }
};

/// Remaining share of an impulse at a node where added mass begins (MassScaling::share).
RAILSTRATA_POINTWISE double share_of(const SurfaceChains& chains, int column, int station) {
  const int chain = chains.at[column];
  return chain < 0 ? 1.0 : chains.tables.response[chains.tables.chains[chain].factor + station];
}

/// A body's surface nodes in a step.
struct SurfaceFields {
  SurfaceChains chains;
  View<const double> f, v, inverse_mass;
};

/// Free velocities of the band's nodes: an index for each.
struct FreeBand {
  ContactTables contact;
  View<const StepState> now;
  SurfaceFields fields;
  double gravity;

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const ContactTables& t = contact;
    const StepState& s = now[0];
    const SurfaceView& surface = t.wheel;
    const int column = static_cast<int>(i % surface.columns),
              station = (s.band_first + static_cast<int>(i / surface.columns)) % surface.stations.nodes();
    const std::ptrdiff_t x = surface.index(column, station);
    const double radius = surface.node[column].z, m = fields.inverse_mass[x];
    const Vec3 arm{-radius * surface.sine[station], 0, radius * surface.cosine[station]};
    const FreeMotion motion =
        free_wheel_node(s.wheel.frame, s.mean, arm, m, RailDisplacement{surface, fields.f}(column, station),
                        RailDisplacement{surface, fields.v}(column, station), gravity, t.enforcement.law.dt, s.rate);
    t.wheel_nodes.before[i] = motion.before;
    t.wheel_nodes.after[i] = motion.after;
    t.wheel_nodes.answer[i] = share_of(fields.chains, column, station) * m;
    t.wheel_nodes.force[i] = {};
  }
};

/// Area, gap, weights and free velocity of the rows: an index for every slot. After FreeBand.
struct MakeRows {
  ContactTables contact;
  View<const StepState> now;
  SurfaceFields fields;
  double gravity;

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const ContactTables& t = contact;
    const int slot = static_cast<int>(i);
    RowRecord row{};
    if (t.found.near[slot] && slot / t.inner < now[0].window) {
      measure(slot, row);
      start(slot, row);
    }
    t.rows[slot] = row;
  }

 private:
  RAILSTRATA_POINTWISE void measure(int slot, RowRecord& row) const {
    const ContactTables& t = contact;
    const StepState& s = now[0];
    const int c = t.column_of(slot), j = t.station_of(slot, s), ring = t.wheel.stations.nodes(), w = slot / t.inner;
    const auto hit = [&](int q, int g) -> const mortar_law::Hit& {  // the window's facets begin a station before it
      const int station = w + q / 2, column = c - 1 + q % 2;
      return t.hits[4 * (static_cast<std::ptrdiff_t>(station) * t.rail.columns + column) + g];
    };
    const mortar_law::WheelPatch patch = mortar_law::wheel_patch(hit, ring);
    row.column = patch.column;
    row.columns = patch.columns;
    row.stations = patch.stations;
    row.first = (patch.anchor - s.band_first + ring) % ring + patch.first;
    if (patch.nodes() > t.patch) row.fault = static_cast<int>(Fault::patch_too_large);
    if (row.first < 0 || row.first + patch.stations > t.band) row.fault = static_cast<int>(Fault::off_the_band);
    if (row.fault) {
      row.columns = row.stations = 0;
      return;
    }
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(slot) * t.patch;
    for (int k = 0; k < patch.nodes(); ++k) t.weights[first + k] = 0;
    const auto add = [&](int k, double weight) { t.weights[first + k] += weight; };
    const mortar_law::RowMeasure measured =
        mortar_law::integrate(t.rail, c, j, hit, patch, ring, yaw_back(t.wheel.yaw, t.normal(c)), add);
    row.area = measured.area;
    row.gap = measured.gap;
    for (int k = 0; k < patch.nodes(); ++k) t.weights[first + k] /= row.area;
  }
  RAILSTRATA_POINTWISE void start(int slot, RowRecord& row) const {
    const ContactTables& t = contact;
    const int c = t.column_of(slot), j = t.station_of(slot, now[0]);
    const double m = fields.inverse_mass[t.rail.index(c, j)], answer = share_of(fields.chains, c, j) * m;
    const FreeMotion motion =
        free_rail_node(m, RailDisplacement{t.rail, fields.f}(c, j), RailDisplacement{t.rail, fields.v}(c, j), gravity,
                       t.enforcement.law.dt, now[0].rate);
    t.rail_nodes.before[slot] = motion.before;
    t.rail_nodes.after[slot] = motion.after;
    t.rail_nodes.answer[slot] = answer;
    t.rail_nodes.force[slot] = {};
    t.starts[slot] = row_start(t.traction(c, j));
    t.slips[slot] = 0;
    double sum = answer;
    for (int station = 0; station < row.stations; ++station)
      for (int column = 0; column < row.columns; ++column) {
        const double weight = t.weights[static_cast<std::ptrdiff_t>(slot) * t.patch + station * row.columns + column];
        const int node = (row.first + station) * t.wheel.columns + row.column + column;
        sum += weight * weight * t.wheel_nodes.answer[node];
      }
    row.compliance = t.enforcement.law.dt * row.area * sum;
  }
};

}  // namespace railstrata::device
