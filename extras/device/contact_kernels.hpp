#pragma once
// The tractions of a step. The sweeps are one group of threads with barriers: rows of a group of contact/mortar.hpp
// share no wheel node, so that they may be visited together, and the groups follow one another as they do on the
// processor. What is recorded of the rows, and their forces on the bodies, are kernels of independent threads.
#include "device/search_kernels.hpp"

namespace railstrata::device {

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

/// Arguments of the kernels that work on rows.
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
    const Vec3 impulse = contact.enforcement.law.dt * contact.rows[slot].area * pushed;
    contact.rail_nodes.after[slot] += contact.rail_nodes.answer[slot] * impulse;
    each_weight(slot, [&](int node, double m) {
      contact.wheel_nodes.after[node] += contact.wheel_nodes.answer[node] * (-m * impulse);
    });
  }
  RAILSTRATA_POINTWISE RowStart start(int slot) const {
    return contact.enforcement.law.film > 0 ? contact.starts[slot] : row_start(traction(slot));
  }

  /// Joins values by slot in kRowParts parts, the same parts for any number of threads. One thread calls use(result).
  template <class Group, class Join, class Use>
  RAILSTRATA_POINTWISE void fold(const Group& group, const View<double>& values, const Join& join,
                                 const Use& use) const {
    group.each(kRowParts, [&](std::ptrdiff_t part) {
      double all = 0;
      for (std::ptrdiff_t slot = part; slot < contact.slots(); slot += kRowParts) all = join(all, values[slot]);
      contact.totals.parts[part] = all;
    });
    group.once([&] {
      double all = 0;
      for (int part = 0; part < kRowParts; ++part) all = join(all, contact.totals.parts[part]);
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
    t.totals.numbers[i] = fault;
    t.changes[i] = slot / t.inner < scope.now[0].window ? t.found.at_edge[i] : 0;
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

/// Takes over the findings of the search and of TestRows, and applies the last step's tractions to the free velocities;
/// by a group of threads.
struct PushRows {
  RowScope scope;
  template <class Group>
  RAILSTRATA_POINTWISE void operator()(const Group& group) const {
    const RowScope& s = scope;
    s.most(group, s.contact.totals.numbers, [&](double largest) {
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

/// The tractions of the step: a group of threads. After PushRows.
struct SweepRows {
  RowScope scope;

  template <class Group>
  RAILSTRATA_POINTWISE void operator()(const Group& group) const {
    const ContactTables& t = scope.contact;
    const int groups = scope.groups();
    group.each(t.slots(), [&](std::ptrdiff_t i) { t.changes[i] = 0; });
    int sweeps = 0;
    for (bool done = false; !done && sweeps < t.enforcement.max_sweeps;) {
      for (int k = 0; k < groups; ++k)
        scope.visit(group, sweeps % 2 == 0 ? k : groups - 1 - k, [&](int slot) { t.changes[slot] = relax(slot); });
      ++sweeps;
      scope.most(group, t.changes, [&](double largest) {
        scope.now[0].contact.largest_change = largest;
        scope.now[0].contact.forces.sweeps = sweeps;
      });
      done = scope.now[0].contact.largest_change * t.enforcement.law.dt < t.enforcement.tolerance;
    }
  }

 private:
  RAILSTRATA_POINTWISE double relax(int slot) const {
    const ContactTables& t = scope.contact;
    const RowRecord& row = t.rows[slot];
    const Vec3 w = scope.relative(slot, t.rail_nodes.after, t.wheel_nodes.after);
    const RowChange change = relax_row(t.enforcement.law, row.gap, scope.normal(slot), row.compliance, w,
                                       scope.start(slot), scope.traction(slot));
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
      const Vec3 n = scope.normal(slot), after = scope.relative(slot, t.rail_nodes.after, t.wheel_nodes.after);
      record_row(t.enforcement.law, n, after, scope.start(slot), t.slips[slot] != 0, traction);
      if (traction.p > 0) {
        force = row.area * traction_vector(traction, n);
        const Vec3 slip = 0.5 * (after + scope.relative(slot, t.rail_nodes.before, t.wheel_nodes.before));
        lost = row_losses(row.area, n, force, traction.p, slip);
        traction.friction_work += t.enforcement.law.dt * lost.friction / row.area;
        pressure = traction.p;
        deep = row.gap < 0 ? -row.gap : 0;
        count = 1;
      }
    }
    t.rail_nodes.force[slot] = force;
    t.totals.numbers[slot] = -force.x;
    t.totals.numbers[each + slot] = -force.y;
    t.totals.numbers[2 * each + slot] = -force.z;
    t.totals.numbers[3 * each + slot] = lost.friction;
    t.totals.numbers[4 * each + slot] = lost.normal;
    t.totals.numbers[5 * each + slot] = count;
    t.totals.numbers[6 * each + slot] = deep;
    t.totals.numbers[7 * each + slot] = pressure;
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
        const Vec3 turned = s.wheel.frame.to_frame(t.rail_nodes.force[slot]);
        scope.each_weight(slot, [&](int node, double m) { t.wheel_nodes.force[node] -= m * turned; });
      });
    const std::ptrdiff_t each = t.slots();
    group.each(kRowNumbers * kRowParts, [&](std::ptrdiff_t i) {
      const bool sum = i / kRowParts < kRowSums;
      double all = 0;
      for (std::ptrdiff_t slot = i % kRowParts; slot < each; slot += kRowParts) {
        const double value = t.totals.numbers[i / kRowParts * each + slot];
        all = sum ? all + value : all < value ? value : all;
      }
      t.totals.parts[i] = all;
    });
    group.each(kRowNumbers, [&](std::ptrdiff_t i) {
      double all = 0;
      for (int part = 0; part < kRowParts; ++part) {
        const double value = t.totals.parts[i * kRowParts + part];
        all = i < kRowSums ? all + value : all < value ? value : all;
      }
      t.changes[i] = all;
    });
    group.once([&] { keep(scope.now[0]); });
  }

 private:
  RAILSTRATA_POINTWISE void keep(StepState& s) const {
    const View<double>& all = scope.contact.changes;
    s.contact.forces.x = all[0];
    s.contact.forces.y = all[1];
    s.contact.forces.z = all[2];
    s.contact.losses = {all[3], all[4]};
    s.contact.forces.nodes = static_cast<int>(all[5]);
    s.contact.forces.penetration = all[6];
    s.contact.largest_pressure = all[7];
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
           contact.rail_nodes.force[slot]);
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
    oppose(surface, chains, f, static_cast<int>(i % surface.columns), station, contact.wheel_nodes.force[i]);
  }
};

}  // namespace railstrata::device
