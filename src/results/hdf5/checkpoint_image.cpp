#include "hdf5/checkpoint_image.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>
#include <malloc.h>

#include <algorithm>
#include <sstream>

#include "hdf5/checkpoint_archive.hpp"

namespace railstrata {
namespace {

using namespace checkpoint_archive;

constexpr std::size_t kSlowestGrowth = std::size_t{64} << 10, kFastestGrowth = std::size_t{16} << 20;

constexpr auto visit_vec = [](auto& v, auto&& on) { on("x", v.x), on("y", v.y), on("z", v.z); };
constexpr auto visit_sym = [](auto& s, auto&& on) {
  on("xx", s.xx);
  on("yy", s.yy);
  on("zz", s.zz);
  on("xy", s.xy);
  on("yz", s.yz);
  on("xz", s.xz);
};
constexpr auto visit_plasticity = [](auto& p, auto&& on) {
  visit_sym(p.strain, [&](const char* name, auto& v) { on(("strain_" + std::string(name)).c_str(), v); });
  visit_sym(p.backstress, [&](const char* name, auto& v) { on(("back_" + std::string(name)).c_str(), v); });
  on("accumulated", p.accumulated);
};
constexpr auto visit_traction = [](auto& t, auto&& on) {
  on("p", t.p);
  on("q1", t.q1);
  on("q2", t.q2);
  on("slip1", t.slip1);
  on("slip2", t.slip2);
  on("plastic", t.plastic);
  on("lost_friction", t.lost_friction);
  on("mean_slip1", t.mean_slip1);
  on("mean_slip2", t.mean_slip2);
  on("stuck", t.stuck);
  on("contact_time", t.contact_time);
  on("slip_time", t.slip_time);
  on("friction_work", t.friction_work);
  on("pressed_slip", t.pressed_slip);
};
constexpr auto visit_axle = [](auto& a, auto&& on) {
  on("x", a.x);
  on("y", a.y);
  on("z", a.z);
  on("psi", a.psi);
  on("vx", a.vx);
  on("vy", a.vy);
  on("vz", a.vz);
  on("spin", a.spin);
};
constexpr auto visit_mass = [](auto& m, auto&& on) { on("z", m.z), on("vz", m.vz); };
constexpr auto visit_forces = [](auto& f, auto&& on) {
  on("F_x", f.x);
  on("F_y", f.y);
  on("F_z", f.z);
  on("penetration", f.penetration);
  on("nodes", f.nodes);
  on("sweeps", f.sweeps);
};
constexpr auto visit_energy = [](auto& balance, auto&& on) {
  for (const EnergyEntry& e : kEnergyEntries) on(e.name, balance.*e.value);
};
constexpr auto visit_history = [](auto& h, auto&& on) {
  on("time", h.time);
  on("position", h.position);
  on("torque", h.torque);
  visit_forces(h.forces, on);
  on("p_max", h.p_max);
  on("creepage", h.creepage);
  on("axle_vx", h.axle_vx);
  on("axle_vz", h.axle_vz);
  on("spin", h.spin);
  visit_energy(h.energy, on);
  on("closure", h.closure);
  on("lateral_creepage", h.lateral_creepage);
  on("axle_y", h.axle_y);
};
constexpr auto visit_way = [](auto& h, auto&& on) {
  on("height", h.way.height);
  on("lowering", h.way.lowering);
  on("length", h.way.length);
  on("width", h.way.width);
  on("patches", h.way.patches);
  on("p_max_x", h.way.p_max_x);
  on("von_mises", h.stress.von_mises);
  on("von_mises_x", h.stress.x);
  on("von_mises_depth", h.stress.depth);
};
constexpr auto visit_facet = [](auto& f, auto&& on) {
  on("column", f.column);
  on("station", f.station);
  for (std::size_t k = 0; k < 4; ++k) {
    on(fmt::format("x{}", k).c_str(), f.correction[k].x);
    on(fmt::format("y{}", k).c_str(), f.correction[k].y);
  }
};

template <class Archive>
void describe(Archive& a, RestartState& m) {
  RollingState& s = m.state;
  a.row("now", m, [](auto& v, auto&& on) {
    on("time", v.state.time);
    on("step", v.state.step);
    on("dt", v.dt);
    on("axle_z0", v.start.axle_z);
    on("side_force", v.start.side_force);
    on("torque_ramp", v.start.torque_ramp);
    on("reached_edge", v.reached_edge);
    on("mean_x", v.mean.x);
    on("mean_z", v.mean.z);
    on("mean_spin", v.mean.spin);
  });
  for (const BodyId id : kBodies) {
    BodyState& body = s.bodies[index_of(id)];
    for (const StateArray& array : kStateArrays)
      a.numbers(fmt::format("{}_{}", array.name, body_word(id)).c_str(), body.*array.values);
    a.numbers(fmt::format("history_{}", body_word(id)).c_str(), body.history.numbers);
    if (!body.history.numbers.empty())
      a.rows(fmt::format("plastic_places_{}", body_word(id)).c_str(), body.history.places,
             [](auto& v, auto&& on) { on("candidate", v); });
  }
  a.row("axle", s.axle, visit_axle);
  a.rows("suspension", s.groups, visit_mass);
  a.later_rows("sleepers", s.sleepers, visit_mass);
  a.row("energy", m.balance, visit_energy);
  a.rows("contact_facets", m.facets, visit_facet);
  std::vector<int> stations{s.tractions.stations()};
  a.rows("traction_stations", stations, [](auto& v, auto&& on) { on("stations", v); });
  std::vector<NodeTraction> tractions = s.tractions.all();
  a.rows("tractions", tractions, visit_traction);
  if (Archive::reading) {
    if (stations.size() != 1 || stations[0] <= 0 || tractions.size() % stations[0] != 0)
      throw Damage{"the tractions are not a grid"};
    s.tractions = SurfaceTractions(static_cast<int>(tractions.size()) / stations[0], stations[0]);
    s.tractions.all() = std::move(tractions);
  }
}

template <class Archive>
void describe(Archive& a, BandSample& b) {
  a.row("size", b,
        [](auto& v, auto&& on) { on("columns", v.columns), on("rows", v.rows), on("stations", v.stations); });
  a.numbers("along", b.along);
  a.later_rows(
      "element", b.element, [](auto& v, auto&& on) { on("element", v); }, !b.element.empty());
  if (!b.element.empty() && b.element.size() != static_cast<std::size_t>(b.stations))
    throw Damage{"elements are not those of the stations"};
  a.rows("stress", b.stress, visit_sym);
  a.rows("plasticity", b.plastic, visit_plasticity);
  a.rows("displacement", b.displacement, visit_vec);
  a.later_rows("below", b.below, visit_vec, !b.below.empty());
}

template <class Archive>
void describe(Archive& a, RollingSample& s) {
  a.row("now", s, [](auto& v, auto&& on) {
    on("time", v.time);
    on("position", v.position);
    on("first_station", v.first_station);
    visit_axle(v.axle, on);
    visit_forces(v.forces, on);
    on("creepage", v.creepage);
    on("lateral_creepage", v.lateral_creepage);
  });
  a.group("rail", [&](auto& inner) { describe(inner, s.rail); });
  a.group("wheel", [&](auto& inner) { describe(inner, s.wheel); });
  a.rows("tractions", s.tractions, visit_traction);
}

template <class Archive, class T, class Describe>
void each(Archive& a, const char* name, std::vector<T>& all, Describe&& one) {
  std::vector<std::size_t> count{all.size()};
  a.group(name, [&](auto& inner) {
    inner.rows("count", count, [](auto& v, auto&& on) { on("count", v); });
    if constexpr (Archive::reading) {
      inner.require_count(count);
      all.resize(count[0]);
    }
    for (std::size_t k = 0; k < all.size(); ++k)
      inner.group(fmt::format("{}", k), [&](auto& part) { one(part, all[k]); });
  });
}

/// Stresses at the points of a way, row by row.
template <class Archive>
void describe_points(Archive& a, std::vector<HistoryRow>& history) {
  std::vector<WatchedStress> all;
  for (const HistoryRow& row : history) all.insert(all.end(), row.points.begin(), row.points.end());
  const auto visit = [](auto& v, auto&& on) { visit_sym(v.stress, on), on("plastic_strain", v.plastic_strain); };
  a.later_rows("watched_points", all, visit, !all.empty());
  if (!Archive::reading || all.empty() || history.empty()) return;
  if (all.size() % history.size() != 0) throw Damage{"the points of the way are not those of the history"};
  const std::size_t points = all.size() / history.size();
  for (std::size_t k = 0; k < history.size(); ++k)
    history[k].points.assign(all.begin() + static_cast<std::ptrdiff_t>(k * points),
                             all.begin() + static_cast<std::ptrdiff_t>((k + 1) * points));
}

template <class Archive>
void describe(Archive& a, RunResult& r) {
  a.row("preload", r.preload, [](auto& v, auto&& on) {
    on("axle_z", v.axle_z);
    on("residual", v.residual);
    on("penetration", v.penetration);
    visit_vec(v.contact_force, on);
    on("newton_steps", v.newton_steps);
    on("cg_iterations", v.cg_iterations);
    on("wall_seconds", v.wall_seconds);
  });
  a.row("so_far", r, [](auto& v, auto&& on) {
    on("hourglass_share", v.hourglass_share);
    on("penetration", v.penetration);
    on("run_up_damping_energy", v.run_up_damping_energy);
    on("wall_seconds", v.wall_seconds);
    on("preload_wall_seconds", v.preload_wall_seconds);
    on("elements", v.elements);
    on("nodes", v.nodes);
  });
  a.rows("history", r.history, visit_history);
  std::vector<double> foot{r.preload.foot_z};
  a.later_rows("preload_foot", foot, [](auto& z, auto&& on) { on("foot_z", z); });
  if (Archive::reading && !foot.empty()) r.preload.foot_z = foot.front();
  a.later_columns("track_history", r.history,
                  [](auto& h, auto&& on) { on("foot_z", h.foot_z), on("sleeper_z", h.sleeper_z); });
  const auto any = [&](auto&& says) { return std::any_of(r.history.begin(), r.history.end(), says); };
  a.later_columns("way_history", r.history, visit_way, any([](const HistoryRow& h) { return h.way.patches > 0; }));
  a.later_columns(
      "interface_history", r.history,
      [](auto& h, auto&& on) { on("opening", h.interface.opening), on("slip", h.interface.slip); },
      any([](const HistoryRow& h) { return h.interface.slip > 0; }));
  describe_points(a, r.history);
  each(a, "positions", r.positions, [](auto& part, PositionSamples& p) {
    part.row("wanted", p, [](auto& v, auto&& on) { on("position", v.position); });
    each(part, "samples", p.samples, [](auto& inner, RollingSample& s) { describe(inner, s); });
  });
}

template <class Archive>
void describe(Archive& a, CheckpointOrigin& c, RunState& r) {
  a.text("case_sha256", c.case_sha256);
  a.text("program", c.program);
  std::string lines = fmt::format("{}", fmt::join(c.provenance, "\n"));
  a.text("provenance", lines);
  if (Archive::reading) {
    std::istringstream in(lines);
    for (std::string line; std::getline(in, line);) c.provenance.push_back(line);
  }
  a.group("state", [&](auto& inner) { describe(inner, r.stepper); });
  a.group("result", [&](auto& inner) { describe(inner, r.result); });
  a.row("progress", r, [](auto& v, auto&& on) {
    on("next_sample", v.next_sample);
    on("next_history", v.next_history);
    on("next_frame", v.next_frame);
    on("started", v.started);
    on("largest_closure", v.largest_closure);
    on("largest_energy", v.largest_energy);
  });
  a.row("start_energy", r.start_energy, visit_energy);
  a.numbers("frame_times", r.frame_times);
}

}  // namespace

std::string checkpoint_image(const CheckpointOrigin& origin, const RunState& run, std::size_t room_before) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Handle access = memory_access(
      std::clamp(sizeof(double) * (run.stepper.state.bodies[0].u.size() + run.stepper.state.bodies[1].u.size()),
                 kSlowestGrowth, kFastestGrowth));
  Handle file(H5Fcreate("checkpoint", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "make a file in memory");
  Writer writer(file);
  CheckpointOrigin from = origin;
  describe(writer, from, const_cast<RunState&>(run));  // a Writer changes nothing
  checked(H5Fflush(file, H5F_SCOPE_GLOBAL), "finish a file in memory");
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  checked(size, "finish a file in memory");
  std::string bytes(room_before + static_cast<std::size_t>(size), '\0');
  checked(H5Fget_file_image(file, bytes.data() + room_before, static_cast<std::size_t>(size)),
          "finish a file in memory");
  return bytes;
}

Checkpoint checkpoint_of_image(std::string_view image) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Handle access = memory_access(kSlowestGrowth);
  checked(H5Pset_file_image(access, const_cast<char*>(image.data()), image.size()), "open it");  // copied
  Handle opened(H5Fopen("checkpoint", H5F_ACC_RDONLY, access), H5Fclose, "open it");
  Checkpoint checkpoint;
  Reader reader(opened, image.size());
  describe(reader, checkpoint.origin, checkpoint.run);
  return checkpoint;
}

void give_memory_back() {
  H5garbage_collect();
  malloc_trim(0);
}

}  // namespace railstrata
