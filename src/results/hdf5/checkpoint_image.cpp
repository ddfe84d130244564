#include "hdf5/checkpoint_image.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <sstream>
#include <type_traits>

#include "hdf5/hdf5_handle.hpp"

namespace railstrata {
namespace {

using Damage = CheckpointDamage;

constexpr std::size_t kSlowestGrowth = std::size_t{64} << 10, kFastestGrowth = std::size_t{16} << 20;

/// Throws CheckpointDamage where HDF5 has failed in this step of its work.
hid_t checked(hid_t id, const char* step) {
  if (id < 0) throw Damage{fmt::format("HDF5 could not {}", step)};
  return id;
}
/// The same of a part of a checkpoint that is read.
hid_t readable(hid_t id, const char* part) {
  if (id < 0) throw Damage{fmt::format("{} cannot be read", part)};
  return id;
}

struct Handle : Hdf5Handle {
  Handle(hid_t id, Close close, const char* step) : Hdf5Handle(checked(id, step), close) {}
};
struct PartHandle : Hdf5Handle {
  PartHandle(hid_t id, Close close, const char* part) : Hdf5Handle(readable(id, part), close) {}
};

/// A file in memory only, that grows by so many bytes at a time.
Handle memory_access(std::size_t growth) {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make a file in memory");
  checked(H5Pset_fapl_core(access, growth, 0), "make a file in memory");
  return Handle(H5Pcopy(access), H5Pclose, "make a file in memory");
}

// describe() names the same entries in the same order to both archives: row: one record of numbers; rows: a table of
// them; numbers: a long array; text; group: a part.
class Writer {
 public:
  static constexpr bool reading = false;
  explicit Writer(hid_t at) : at_(at) {}

  void text(const char* name, std::string& value) {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "describe a text");
    checked(H5Tset_size(type, value.size() + 1), "describe a text");
    Handle space(H5Screate(H5S_SCALAR), H5Sclose, "describe a text"), how = timeless();
    Handle set(H5Dcreate2(at_, name, type, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose, "add a text");
    checked(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.c_str()), "write a text");
  }
  template <class Array>
  void numbers(const char* name, Array& values) {
    write(name, values.data(), {values.size()}, {});
  }
  template <class T, class Visit>
  void rows(const char* name, std::vector<T>& all, Visit&& visit) {
    T sample{};
    table(name, sample, all.data(), all.size(), visit);
  }
  /// Rows that older formats lack.
  template <class T, class Visit>
  void later_rows(const char* name, std::vector<T>& all, Visit&& visit) {
    rows(name, all, visit);
  }
  template <class T, class Visit>
  void row(const char* name, T& value, Visit&& visit) {
    table(name, value, &value, 1, visit);
  }
  template <class Describe>
  void group(const std::string& name, Describe&& describe) {
    Handle group(H5Gcreate2(at_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "add a group");
    Writer inner(group);
    describe(inner);
  }

 private:
  template <class T, class Visit>
  void table(const char* name, T& sample, T* first, std::size_t count, Visit&& visit) {
    std::vector<std::string> names;
    visit(sample, [&](const char* column, auto&) { names.emplace_back(column); });
    std::vector<double> values;
    values.reserve(count * names.size());
    for (std::size_t k = 0; k < count; ++k)
      visit(first[k], [&](const char*, auto& v) { values.push_back(static_cast<double>(v)); });
    write(name, values.data(), {count, names.size()}, names);
  }
  void write(const char* name, const double* values, const std::vector<hsize_t>& size,
             const std::vector<std::string>& columns) {
    Handle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose, "describe an array"),
        how = timeless();
    Handle set(H5Dcreate2(at_, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose, "add an array");
    double none = 0;
    checked(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values ? values : &none), "write an array");
    if (columns.empty()) return;
    const std::string text = fmt::format("{}", fmt::join(columns, ","));
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "describe a text");
    checked(H5Tset_size(type, text.size() + 1), "describe a text");
    Handle one(H5Screate(H5S_SCALAR), H5Sclose, "describe a text");
    Handle attribute(H5Acreate2(set, "columns", type, one, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "add a text");
    checked(H5Awrite(attribute, type, text.c_str()), "write a text");
  }
  /// Without the time of day in it: the same state has the same bytes.
  static Handle timeless() {
    const hid_t how = checked(H5Pcreate(H5P_DATASET_CREATE), "describe an array");
    H5Pset_obj_track_times(how, false);
    return Handle(how, H5Pclose, "describe an array");
  }
  hid_t at_;
};

// Takes only what a Writer writes: arrays in one piece inside the file, no longer than it. Links, filters, other files
// and other types, which HDF5 would follow, are damage.
class Reader {
 public:
  static constexpr bool reading = true;
  /// bytes: of the whole image.
  Reader(hid_t at, std::size_t bytes) : at_(at), bytes_(bytes) {}

  void text(const char* name, std::string& value) {
    const PartHandle set = open_array(name);
    const PartHandle type(H5Dget_type(set), H5Tclose, name), space(H5Dget_space(set), H5Sclose, name);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 ||
        H5Sget_simple_extent_type(space) != H5S_SCALAR || H5Tget_size(type) == 0 || H5Tget_size(type) > bytes_)
      throw Damage{fmt::format("{} is no text", name)};
    require_stored(set, name, H5Tget_size(type));
    std::string raw(H5Tget_size(type), '\0');
    readable(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()), name);
    value = raw.substr(0, raw.find('\0'));
  }
  template <class Array>
  void numbers(const char* name, Array& values) {
    const PartHandle set = open_array(name);
    values.resize(size_of(set, name, 1)[0]);
    read(set, name, values.data(), values.empty());
  }
  template <class T, class Visit>
  void rows(const char* name, std::vector<T>& all, Visit&& visit) {
    T sample{};
    const auto [values, count] = table(name, sample, visit);
    all.assign(count, T{});
    const double* next = values.data();
    for (T& one : all) take(one, next, visit);
  }
  template <class T, class Visit>
  void later_rows(const char* name, std::vector<T>& all, Visit&& visit) {
    if (H5Lexists(at_, name, H5P_DEFAULT) > 0) rows(name, all, visit);
  }
  template <class T, class Visit>
  void row(const char* name, T& value, Visit&& visit) {
    const auto [values, count] = table(name, value, visit);
    if (count != 1) throw Damage{fmt::format("{} is not one row", name)};
    const double* next = values.data();
    take(value, next, visit);
  }
  template <class Describe>
  void group(const std::string& name, Describe&& describe) {
    require_part_of_file(name.c_str());
    PartHandle group(H5Gopen2(at_, name.c_str(), H5P_DEFAULT), H5Gclose, name.c_str());
    Reader inner(group, bytes_);
    describe(inner);
  }
  /// How many parts a list has cannot be more than the file has bytes.
  void require_count(const std::vector<std::size_t>& count) const {
    if (count.size() != 1 || count[0] > bytes_) throw Damage{"a list has no sound count"};
  }

 private:
  void require_part_of_file(const char* name) const {
    H5L_info_t link;
    if (H5Lget_info(at_, name, &link, H5P_DEFAULT) < 0) throw Damage{fmt::format("{} is missing", name)};
    if (link.type != H5L_TYPE_HARD) throw Damage{fmt::format("{} is a link", name)};
  }
  /// Refuses data that HDF5 would fill in because they were never written. Only data in one piece in this file have an
  /// offset: no chunks, which may be filtered, and no external file.
  static void require_stored(hid_t set, const char* name, hsize_t bytes) {
    if (H5Dget_storage_size(set) != bytes || (bytes > 0 && H5Dget_offset(set) == HADDR_UNDEF))
      throw Damage{fmt::format("{} is not stored in one piece", name)};
  }
  PartHandle open_array(const char* name) const {
    require_part_of_file(name);
    return PartHandle(H5Dopen2(at_, name, H5P_DEFAULT), H5Dclose, name);
  }
  template <class T, class Visit>
  std::pair<std::vector<double>, std::size_t> table(const char* name, T& sample, Visit&& visit) {
    const PartHandle set = open_array(name);
    const std::vector<hsize_t> size = size_of(set, name, 2);
    std::size_t columns = 0;
    visit(sample, [&](const char*, auto&) { ++columns; });
    if (columns != size[1]) throw Damage{fmt::format("{} has {} columns, not {}", name, size[1], columns)};
    std::vector<double> values(size[0] * size[1]);
    read(set, name, values.data(), values.empty());
    return {std::move(values), size[0]};
  }
  template <class T, class Visit>
  static void take(T& to, const double*& next, Visit&& visit) {
    visit(to,
          [&](const char* column, auto& v) { v = number_as<std::remove_reference_t<decltype(v)>>(*next++, column); });
  }
  /// A whole number must be one, and one that its type holds.
  template <class T>
  static T number_as(double value, const char* name) {
    if constexpr (!std::is_floating_point_v<T>) {
      const double end = std::ldexp(1.0, std::numeric_limits<T>::digits), begin = std::is_signed_v<T> ? -end : 0.0;
      if (!(value >= begin && value < end && value == std::floor(value)))
        throw Damage{fmt::format("{} has the value {}, which it cannot have", name, value)};
    }
    return static_cast<T>(value);
  }
  std::vector<hsize_t> size_of(hid_t set, const char* name, int dimensions) const {
    const PartHandle space(H5Dget_space(set), H5Sclose, name), type(H5Dget_type(set), H5Tclose, name);
    std::vector<hsize_t> size(dimensions);
    if (H5Sget_simple_extent_ndims(space) != dimensions)
      throw Damage{fmt::format("{} is no array of {} dimensions", name, dimensions)};
    if (H5Tequal(type, H5T_IEEE_F64LE) <= 0) throw Damage{fmt::format("{} is no array of numbers of 8 bytes", name)};
    readable(H5Sget_simple_extent_dims(space, size.data(), nullptr), name);
    hsize_t most = bytes_ / sizeof(double);
    for (const hsize_t n : size) {
      if (n > most) throw Damage{fmt::format("{} is longer than the file", name)};
      most = n > 0 ? most / n : most;
    }
    require_stored(set, name, std::accumulate(size.begin(), size.end(), hsize_t{sizeof(double)}, std::multiplies<>()));
    return size;
  }
  static void read(hid_t set, const char* name, double* values, bool empty) {
    if (!empty) readable(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
  }
  hid_t at_;
  std::size_t bytes_;
};

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
  on("strain_xx", p.strain.xx);
  on("strain_yy", p.strain.yy);
  on("strain_zz", p.strain.zz);
  on("strain_xy", p.strain.xy);
  on("strain_yz", p.strain.yz);
  on("strain_xz", p.strain.xz);
  on("back_xx", p.backstress.xx);
  on("back_yy", p.backstress.yy);
  on("back_zz", p.backstress.zz);
  on("back_xy", p.backstress.xy);
  on("back_yz", p.backstress.yz);
  on("back_xz", p.backstress.xz);
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
constexpr auto visit_facet = [](auto& f, auto&& on) {
  on("column", f.column);
  on("station", f.station);
  on("x0", f.correction[0].x);
  on("y0", f.correction[0].y);
  on("x1", f.correction[1].x);
  on("y1", f.correction[1].y);
  on("x2", f.correction[2].x);
  on("y2", f.correction[2].y);
  on("x3", f.correction[3].x);
  on("y3", f.correction[3].y);
};

template <class Archive>
void describe(Archive& a, RestartState& m) {
  RollingState& s = m.state;
  a.row("now", m, [](auto& v, auto&& on) {
    on("time", v.state.time);
    on("step", v.state.step);
    on("dt", v.dt);
    on("axle_z0", v.axle_z0);
    on("side_force", v.side_force);
    on("reached_edge", v.reached_edge);
    on("mean_x", v.mean.x);
    on("mean_z", v.mean.z);
    on("mean_spin", v.mean.spin);
  });
  for (const BodyId id : kBodies) {
    BodyState& body = s.bodies[index_of(id)];
    for (const StateArray& array : kStateArrays)
      if (array.restart) a.numbers(fmt::format("{}_{}", array.name, body_word(id)).c_str(), body.*array.values);
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
  if (Archive::reading || !b.element.empty())
    a.later_rows("element", b.element, [](auto& v, auto&& on) { on("element", v); });
  if (!b.element.empty() && b.element.size() != static_cast<std::size_t>(b.stations))
    throw Damage{"elements are not those of the stations"};
  a.rows("stress", b.stress, visit_sym);
  a.rows("plasticity", b.plastic, visit_plasticity);
  a.rows("displacement", b.displacement, visit_vec);
  if (Archive::reading || !b.below.empty()) a.later_rows("below", b.below, visit_vec);
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
  if (Archive::reading || !all.empty())
    a.later_rows("watched_points", all, [](auto& v, auto&& on) {
      visit_sym(v.stress, on);
      on("plastic_strain", v.plastic_strain);
    });
  if (!Archive::reading || all.empty() || history.empty()) return;
  if (all.size() % history.size() != 0) throw Damage{"the points of the way are not those of the history"};
  const std::size_t points = all.size() / history.size();
  for (std::size_t k = 0; k < history.size(); ++k)
    history[k].points.assign(all.begin() + static_cast<std::ptrdiff_t>(k * points),
                             all.begin() + static_cast<std::ptrdiff_t>((k + 1) * points));
}

template <class Archive>
void describe_interface(Archive& a, std::vector<HistoryRow>& history) {
  const bool apart =
      std::any_of(history.begin(), history.end(), [](const HistoryRow& h) { return h.interface.slip > 0; });
  std::vector<HistoryRow> rows = Archive::reading ? std::vector<HistoryRow>{} : history;
  if (Archive::reading || apart)
    a.later_rows("interface_history", rows,
                 [](auto& h, auto&& on) { on("opening", h.interface.opening), on("slip", h.interface.slip); });
  if (Archive::reading)
    for (std::size_t k = 0; k < std::min(rows.size(), history.size()); ++k) history[k].interface = rows[k].interface;
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
  std::vector<HistoryRow> on_track = Archive::reading ? std::vector<HistoryRow>{} : r.history;
  a.later_rows("track_history", on_track,
               [](auto& h, auto&& on) { on("foot_z", h.foot_z), on("sleeper_z", h.sleeper_z); });
  if (Archive::reading)
    for (std::size_t k = 0; k < std::min(on_track.size(), r.history.size()); ++k) {
      r.history[k].foot_z = on_track[k].foot_z;
      r.history[k].sleeper_z = on_track[k].sleeper_z;
    }
  const bool over_heights =
      std::any_of(r.history.begin(), r.history.end(), [](const HistoryRow& h) { return h.way.patches > 0; });
  std::vector<HistoryRow> on_way = Archive::reading ? std::vector<HistoryRow>{} : r.history;
  if (Archive::reading || over_heights)
    a.later_rows("way_history", on_way, [](auto& h, auto&& on) {
      on("height", h.way.height);
      on("lowering", h.way.lowering);
      on("length", h.way.length);
      on("width", h.way.width);
      on("patches", h.way.patches);
      on("p_max_x", h.way.p_max_x);
      on("von_mises", h.stress.von_mises);
      on("von_mises_x", h.stress.x);
      on("von_mises_depth", h.stress.depth);
    });
  if (Archive::reading)
    for (std::size_t k = 0; k < std::min(on_way.size(), r.history.size()); ++k) {
      r.history[k].way = on_way[k].way;
      r.history[k].stress = on_way[k].stress;
    }
  describe_interface(a, r.history);
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
