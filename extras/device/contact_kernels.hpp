#pragma once
// The contact of a step. The search, the rows' integrals and what is recorded of them are kernels of independent
// threads. The sweeps are one group of threads with barriers: rows of a group of contact/mortar.hpp share no wheel
// node, so that they may be visited together, and the groups follow one another as they do on the processor.
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

/// Of the wheel's, in its own axes.
struct WheelDisplacement {
  const SurfaceView& surface;
  const View<const double>& u;
  const ReferenceFrame& frame;
  RAILSTRATA_POINTWISE Vec3 operator()(int column, int station) const {
    return own_displacement(frame, surface.node[column].z, surface.cosine[station], surface.sine[station],
                            RailDisplacement{surface, u}(column, station));
  }
};

/// What a kernel of the search sees.
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
      near_by = gap < t.gap_limit && h.inside;
      edge = gap < 0 && (!h.inside || c == 1 || c == t.inner || w == 0 || w == s.window - 1);
    }
    t.near_nodes[slot] = near_by;
    t.at_edge[slot] = edge;
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
    return t.near_nodes[static_cast<std::ptrdiff_t>(w) * t.inner + column - 1] != 0;
  }
  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const ContactTables& t = scope.contact;
    const int c = static_cast<int>(i % t.rail.columns), j = static_cast<int>(i / t.rail.columns);
    if (!chosen(c, j)) t.traction(c, j) = apart(t.traction(c, j));
    const bool was = t.active[i] != 0,
               is = chosen(c, j) || chosen(c + 1, j) || chosen(c, j + 1) || chosen(c + 1, j + 1);
    t.active[i] = is;
    if (!is) return;
    for (int g = 0; g < 4; ++g) {
      Tangential& correction = t.corrections[4 * i + g];
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
    if (!t.active[facet]) return;
    Tangential& correction = t.corrections[4 * facet + g];
    const mortar_law::Hit h = scope.opposite(scope.gauss_point(c, j, g), correction);
    correction = correction + Tangential{h.offset.x, h.offset.y};
    t.hits[i] = h;
  }
};

/// What is left of an impulse at a node where added mass begins (MassScaling::share).
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
                        RailDisplacement{surface, fields.v}(column, station), gravity, t.law.dt, s.rate);
    t.wheel_before[i] = motion.before;
    t.wheel_after[i] = motion.after;
    t.wheel_answer[i] = share_of(fields.chains, column, station) * m;
    t.wheel_force[i] = {};
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
    if (t.near_nodes[slot] && slot / t.inner < now[0].window) {
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
    if (patch.columns * patch.stations > t.patch) row.fault = static_cast<int>(Fault::patch_too_large);
    if (row.first < 0 || row.first + patch.stations > t.band) row.fault = static_cast<int>(Fault::off_the_band);
    if (row.fault) {
      row.columns = row.stations = 0;
      return;
    }
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(slot) * t.patch;
    for (int k = 0; k < patch.columns * patch.stations; ++k) t.weights[first + k] = 0;
    const auto add = [&](int k, double weight) { t.weights[first + k] += weight; };
    const mortar_law::RowMeasure measured =
        mortar_law::integrate(t.rail, c, j, hit, patch, ring, yaw_back(t.wheel.yaw, t.normal(c)), add);
    row.area = measured.area;
    row.gap = measured.gap;
    for (int k = 0; k < patch.columns * patch.stations; ++k) t.weights[first + k] /= row.area;
  }
  RAILSTRATA_POINTWISE void start(int slot, RowRecord& row) const {
    const ContactTables& t = contact;
    const int c = t.column_of(slot), j = t.station_of(slot, now[0]);
    const double m = fields.inverse_mass[t.rail.index(c, j)], answer = share_of(fields.chains, c, j) * m;
    const FreeMotion motion = free_rail_node(m, RailDisplacement{t.rail, fields.f}(c, j),
                                             RailDisplacement{t.rail, fields.v}(c, j), gravity, t.law.dt, now[0].rate);
    t.rail_before[slot] = motion.before;
    t.rail_after[slot] = motion.after;
    t.rail_answer[slot] = answer;
    t.rail_force[slot] = {};
    t.starts[slot] = row_start(t.traction(c, j));
    t.slips[slot] = 0;
    double sum = answer;
    for (int station = 0; station < row.stations; ++station)
      for (int column = 0; column < row.columns; ++column) {
        const double weight = t.weights[static_cast<std::ptrdiff_t>(slot) * t.patch + station * row.columns + column];
        const int node = (row.first + station) * t.wheel.columns + row.column + column;
        sum += weight * weight * t.wheel_answer[node];
      }
    row.compliance = t.law.dt * row.area * sum;
  }
};

/// Slots of the window in one group of rows.
struct RowGroup {
  int first_station, first_column, stations, columns, apart;  ///< station: of the window; columns from 0
  RAILSTRATA_POINTWISE RowGroup(const ContactTables& t, const StepState& s, int group) : apart(t.apart) {
    const int along = group / t.apart, across = group % t.apart;
    first_station = first_of(along, s.window_first) - s.window_first;
    first_column = first_of(across, 1) - 1;
    stations = count(first_station, s.window);
    columns = count(first_column, t.inner);
  }
  RAILSTRATA_POINTWISE int size() const { return stations * columns; }
  RAILSTRATA_POINTWISE int slot(std::ptrdiff_t i, int inner) const {
    const int k = static_cast<int>(i);
    return (first_station + k / columns * apart) * inner + first_column + k % columns * apart;
  }

 private:
  RAILSTRATA_POINTWISE int first_of(int remainder, int least) const {
    return least + ((remainder - least) % apart + apart) % apart;
  }
  RAILSTRATA_POINTWISE int count(int first, int end) const { return first < end ? (end - 1 - first) / apart + 1 : 0; }
};

/// What the kernels that work on rows see.
struct RowScope {
  ContactTables contact;
  View<StepState> now;

  RAILSTRATA_POINTWISE int groups() const { return contact.apart * contact.apart; }
  RAILSTRATA_POINTWISE bool is_row(int slot) const { return contact.rows[slot].stations > 0; }
  RAILSTRATA_POINTWISE NodeTraction& traction(int slot) const {
    return contact.traction(contact.column_of(slot), contact.station_of(slot, now[0]));
  }
  RAILSTRATA_POINTWISE Vec3 normal(int slot) const { return contact.normal(contact.column_of(slot)); }

  /// row(slot) for the rows of group k.
  template <class Group, class Visit>
  RAILSTRATA_POINTWISE void visit(const Group& group, int k, const Visit& row) const {
    const RowGroup of(contact, now[0], k);
    group.each(of.size(), [&](std::ptrdiff_t i) {
      const int slot = of.slot(i, contact.inner);
      if (is_row(slot)) row(slot);
    });
  }
  /// visit(node of the band, weight)
  template <class Visit>
  RAILSTRATA_POINTWISE void each_weight(int slot, const Visit& visit_node) const {
    const RowRecord& row = contact.rows[slot];
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(slot) * contact.patch;
    for (int station = 0; station < row.stations; ++station)
      for (int column = 0; column < row.columns; ++column)
        visit_node((row.first + station) * contact.wheel.columns + row.column + column,
                   contact.weights[first + station * row.columns + column]);
  }
  RAILSTRATA_POINTWISE Vec3 relative(int slot, const View<Vec3>& rail, const View<Vec3>& wheel) const {
    Vec3 w = -rail[slot];
    each_weight(slot, [&](int node, double m) { w += m * wheel[node]; });
    return w;
  }
  /// The impulse of a traction on the rail over the step.
  RAILSTRATA_POINTWISE void push(int slot, Vec3 pushed) const {
    const Vec3 impulse = contact.law.dt * contact.rows[slot].area * pushed;
    contact.rail_after[slot] += contact.rail_answer[slot] * impulse;
    each_weight(slot,
                [&](int node, double m) { contact.wheel_after[node] += contact.wheel_answer[node] * (-m * impulse); });
  }
  RAILSTRATA_POINTWISE RowStart start(int slot) const {
    return contact.law.film > 0 ? contact.starts[slot] : row_start(traction(slot));
  }

  /// Of values by slot, in kRowParts parts: of one shape whatever the number of threads. use(result) by one thread.
  template <class Group, class Join, class Use>
  RAILSTRATA_POINTWISE void fold(const Group& group, const View<double>& values, const Join& join,
                                 const Use& use) const {
    group.each(kRowParts, [&](std::ptrdiff_t part) {
      double all = 0;
      for (std::ptrdiff_t slot = part; slot < contact.slots(); slot += kRowParts) all = join(all, values[slot]);
      contact.parts[part] = all;
    });
    group.once([&] {
      double all = 0;
      for (int part = 0; part < kRowParts; ++part) all = join(all, contact.parts[part]);
      use(all);
    });
  }
  /// NaN is no maximum: a run that has some ends by its forces.
  template <class Group, class Use>
  RAILSTRATA_POINTWISE void most(const Group& group, const View<double>& values, const Use& use) const {
    fold(
        group, values, [](double a, double b) { return a < b ? b : a; }, use);
  }
};

/// Whether the rows are as the groups want them: an index for every slot.
struct TestRows {
  RowScope scope;
  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const int slot = static_cast<int>(i);
    const ContactTables& t = scope.contact;
    int fault = t.rows[slot].fault;
    if (scope.is_row(slot) && (meets(slot, 0, 1) || meets(slot, 1, -1) || meets(slot, 1, 0) || meets(slot, 1, 1)))
      fault = static_cast<int>(Fault::rows_meet);
    t.numbers[i] = fault;
    t.changes[i] = slot / t.inner < scope.now[0].window ? t.at_edge[i] : 0;
  }

 private:
  // Shares wheel nodes with the row so many groups on.
  RAILSTRATA_POINTWISE bool meets(int slot, int along, int across) const {
    const ContactTables& t = scope.contact;
    const int c = t.column_of(slot) - 1 + across * t.apart, w = slot / t.inner + along * t.apart;
    if (c < 0 || c >= t.inner || w >= scope.now[0].window) return false;
    const RowRecord &a = t.rows[slot], &b = t.rows[w * t.inner + c];
    if (b.stations == 0) return false;
    return a.column < b.column + b.columns && b.column < a.column + a.columns && a.first < b.first + b.stations &&
           b.first < a.first + a.stations;
  }
};

/// What the search and TestRows have seen; the last step's tractions act on the free velocities: a group of threads.
struct PushRows {
  RowScope scope;
  template <class Group>
  RAILSTRATA_POINTWISE void operator()(const Group& group) const {
    const RowScope& s = scope;
    s.most(group, s.contact.numbers, [&](double largest) {
      if (s.now[0].fault == 0) s.now[0].fault = static_cast<int>(largest);
    });
    s.most(group, s.contact.changes, [&](double largest) {
      if (largest > 0) s.now[0].reached_edge = 1;
    });
    for (int k = 0; k < s.groups(); ++k)
      s.visit(group, k, [&](int slot) {
        const NodeTraction& t = s.traction(slot);
        if (t.p > 0) s.push(slot, traction_vector(t, s.normal(slot)));
      });
  }
};

/// Penalty tractions: an index for every slot. Before PushRows.
struct PressRows {
  RowScope scope;
  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const int slot = static_cast<int>(i);
    if (!scope.is_row(slot)) return;
    const ContactTables& t = scope.contact;
    const Vec3 w = scope.relative(slot, t.rail_before, t.wheel_before);
    t.slips[i] = press_row(t.law, t.rows[i].gap, scope.normal(slot), w, scope.traction(slot));
  }
};

/// The tractions of the step: a group of threads. After PushRows.
struct SweepRows {
  RowScope scope;

  template <class Group>
  RAILSTRATA_POINTWISE void operator()(const Group& group) const {
    const ContactTables& t = scope.contact;
    const int groups = scope.groups();
    group.each(t.slots(), [&](std::ptrdiff_t i) { t.changes[i] = 0; });
    int sweeps = 0;
    for (bool done = false; !done && sweeps < t.max_sweeps;) {
      for (int k = 0; k < groups; ++k)
        scope.visit(group, sweeps % 2 == 0 ? k : groups - 1 - k, [&](int slot) { t.changes[slot] = relax(slot); });
      ++sweeps;
      scope.most(group, t.changes, [&](double largest) {
        scope.now[0].largest_change = largest;
        scope.now[0].forces.sweeps = sweeps;
      });
      done = scope.now[0].largest_change * t.law.dt < t.tolerance;
    }
  }

 private:
  RAILSTRATA_POINTWISE double relax(int slot) const {
    const ContactTables& t = scope.contact;
    const RowRecord& row = t.rows[slot];
    const Vec3 w = scope.relative(slot, t.rail_after, t.wheel_after);
    const RowChange change =
        relax_row(t.law, row.gap, scope.normal(slot), row.compliance, w, scope.start(slot), scope.traction(slot));
    if (!change.acts) return 0;
    t.slips[slot] = change.slips;
    scope.push(slot, change.traction);
    return std::sqrt(dot(change.traction, change.traction)) * row.compliance;
  }
};

/// Slips, losses and forces of the rows: an index for every slot.
struct RecordRows {
  RowScope scope;
  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const ContactTables& t = scope.contact;
    const int slot = static_cast<int>(i);
    const std::ptrdiff_t each = t.slots();
    Vec3 force;
    RowLosses lost;
    double pressure = 0, deep = 0, count = 0;
    if (scope.is_row(slot)) {
      NodeTraction& traction = scope.traction(slot);
      const RowRecord& row = t.rows[slot];
      const Vec3 n = scope.normal(slot), after = scope.relative(slot, t.rail_after, t.wheel_after);
      record_row(t.law, n, after, scope.start(slot), t.slips[slot] != 0, traction);
      if (traction.p > 0) {
        force = row.area * traction_vector(traction, n);
        const Vec3 slip = 0.5 * (after + scope.relative(slot, t.rail_before, t.wheel_before));
        lost = row_losses(row.area, n, force, traction.p, slip);
        traction.friction_work += t.law.dt * lost.friction / row.area;
        pressure = traction.p;
        deep = row.gap < 0 ? -row.gap : 0;
        count = 1;
      }
    }
    t.rail_force[slot] = force;
    t.numbers[slot] = -force.x;
    t.numbers[each + slot] = -force.y;
    t.numbers[2 * each + slot] = -force.z;
    t.numbers[3 * each + slot] = lost.friction;
    t.numbers[4 * each + slot] = lost.normal;
    t.numbers[5 * each + slot] = count;
    t.numbers[6 * each + slot] = deep;
    t.numbers[7 * each + slot] = pressure;
  }
};

/// The rows' forces on the wheel and the sums of what RecordRows has left: a group of threads.
struct AddUpRows {
  RowScope scope;
  template <class Group>
  RAILSTRATA_POINTWISE void operator()(const Group& group) const {
    const ContactTables& t = scope.contact;
    const StepState& s = scope.now[0];
    for (int k = 0; k < scope.groups(); ++k)
      scope.visit(group, k, [&](int slot) {
        if (scope.traction(slot).p <= 0) return;
        const Vec3 turned = s.wheel.frame.to_frame(t.rail_force[slot]);
        scope.each_weight(slot, [&](int node, double m) { t.wheel_force[node] -= m * turned; });
      });
    const std::ptrdiff_t each = t.slots();
    group.each(kRowNumbers * kRowParts, [&](std::ptrdiff_t i) {
      const bool sum = i / kRowParts < kRowSums;
      double all = 0;
      for (std::ptrdiff_t slot = i % kRowParts; slot < each; slot += kRowParts) {
        const double value = t.numbers[i / kRowParts * each + slot];
        all = sum ? all + value : all < value ? value : all;
      }
      t.parts[i] = all;
    });
    group.each(kRowNumbers, [&](std::ptrdiff_t i) {
      double all = 0;
      for (int part = 0; part < kRowParts; ++part) {
        const double value = t.parts[i * kRowParts + part];
        all = i < kRowSums ? all + value : all < value ? value : all;
      }
      t.changes[i] = all;
    });
    group.once([&] { keep(scope.now[0]); });
  }

 private:
  RAILSTRATA_POINTWISE void keep(StepState& s) const {
    const View<double>& all = scope.contact.changes;
    s.forces.x = all[0];
    s.forces.y = all[1];
    s.forces.z = all[2];
    s.losses = {all[3], all[4]};
    s.forces.nodes = static_cast<int>(all[5]);
    s.forces.penetration = all[6];
    s.largest_pressure = all[7];
  }
};

/// A force on a surface node opposes the internal ones; what it meets of added mass, it passes on down its chain.
RAILSTRATA_POINTWISE void oppose(const SurfaceView& surface, const SurfaceChains& chains, const View<double>& f,
                                 int column, int station, Vec3 force) {
  const int chain = chains.at[column];
  const double all[3] = {force.x, force.y, force.z};
  RAILSTRATA_UNROLL
  for (int component = 0; component < 3; ++component) {
    const std::ptrdiff_t line = static_cast<std::ptrdiff_t>(component) * surface.stride;
    if (chain < 0) {
      f[surface.index(column, station) + line] -= all[component];
      continue;
    }
    const ChainRecord& c = chains.tables.chains[chain];
    for (int k = 0; k < c.nodes; ++k) {
      const std::ptrdiff_t factor = c.factor + static_cast<std::ptrdiff_t>(k) * c.stations + station;
      f[chains.tables.nodes[c.first_node + k].x + line + station] -= chains.tables.response[factor] * all[component];
    }
  }
}

/// The contact's forces on the rail: an index for every slot.
struct LoadRail {
  ContactTables contact;
  View<const StepState> now;
  SurfaceChains chains;
  View<double> f;
  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const int slot = static_cast<int>(i);
    if (contact.rows[slot].stations == 0) return;
    oppose(contact.rail, chains, f, contact.column_of(slot), contact.station_of(slot, now[0]),
           contact.rail_force[slot]);
  }
};

/// On the wheel: an index for every node of the band.
struct LoadWheel {
  ContactTables contact;
  View<const StepState> now;
  SurfaceChains chains;
  View<double> f;
  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const SurfaceView& surface = contact.wheel;
    const int station = (now[0].band_first + static_cast<int>(i / surface.columns)) % surface.stations.nodes();
    oppose(surface, chains, f, static_cast<int>(i % surface.columns), station, contact.wheel_force[i]);
  }
};

}  // namespace railstrata::device
