#include "io/result_files.hpp"

#include <algorithm>
#include <array>

#include "material/elastic.hpp"
#include "mesh/split_interface.hpp"

namespace railstrata {
namespace {

using P = PatchPoint;

std::vector<P> patch_points(const std::vector<const ContactField*>& fields) {
  std::vector<P> out;
  for (std::size_t k = 0; k < fields.size(); ++k)
    for (std::size_t i = 0; i < fields[k]->x.size(); ++i) out.push_back({fields[k], static_cast<int>(k) + 1, i});
  return out;
}

/// A point of a body; plastic: null where nothing may yield.
struct StressPoint {
  double x = 0, y = 0, depth = 0;
  Sym3 stress;
  int material = 0;
  const ElementPlasticity* plastic = nullptr;
};
using S = StressPoint;

const ElementPlasticity* plastic_at(const std::vector<ElementPlasticity>& states, std::size_t i) {
  return states.empty() ? nullptr : &states[i];
}

Columns<S> place_columns() {
  return {{"x", unit::kMillimetres, &S::x}, {"y", unit::kMillimetres, &S::y}, {"depth", unit::kMillimetres, &S::depth}};
}

/// Scalars of the stress, beside its components.
Columns<S> measure_columns() {
  return {{"von_mises", unit::kMPa, [](const S& s) { return von_mises(s.stress); }},
          {"sigma_1", unit::kMPa, [](const S& s) { return principal_stresses(s.stress).x; }},
          {"sigma_2", unit::kMPa, [](const S& s) { return principal_stresses(s.stress).y; }},
          {"sigma_3", unit::kMPa, [](const S& s) { return principal_stresses(s.stress).z; }},
          {"sigma_xz", unit::kMPa, [](const S& s) { return s.stress.xz; }},
          {"tau_max", unit::kMPa, [](const S& s) { return largest_shear(principal_stresses(s.stress)); }},
          {"material", unit::kCount, &S::material}};
}

Columns<S> accumulated_columns() {
  return {{"plastic_strain_accumulated", unit::kNone, [](const S& s) { return s.plastic->accumulated; }}};
}
Columns<S> plastic_strain_columns() {
  return tensor_columns<S>("plastic", unit::kNone, [](const S& s) { return s.plastic->strain; });
}
Columns<S> backstress_columns() {
  return tensor_columns<S>("backstress", unit::kMPa, [](const S& s) { return s.plastic->backstress; });
}
Columns<S> stress_columns() { return tensor_columns<S>("sigma", unit::kMPa, &S::stress); }

/// Behind the columns of the stress those of what has yielded.
void write_stress_table(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                        const std::vector<S>& points, Columns<S> columns) {
  if (!points.empty() && points.front().plastic)
    for (const Columns<S>& more : {accumulated_columns(), plastic_strain_columns(), backstress_columns()})
      append(columns, more);
  write_csv(file, provenance, points, columns);
}

std::vector<S> section_points(const StressSection& section, bool longitudinal) {
  std::vector<S> out;
  const std::size_t n = section.along.size();
  for (std::size_t i = 0; i < section.stress.size(); ++i) {
    const double along = section.along[i % n];
    out.push_back({longitudinal ? along : section.at, longitudinal ? section.at : along, section.depth[i / n],
                   section.stress[i], section.material[i], plastic_at(section.plastic, i)});
  }
  return out;
}

void write_section(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                   const StressSection& section, bool longitudinal) {
  Columns<S> columns = rounded(place_columns(), 6);
  append(columns, rounded(stress_columns(), 3));
  append(columns, rounded(select(measure_columns(), {"von_mises", "sigma_1", "material"}), 3));
  write_stress_table(file, provenance, section_points(section, longitudinal), columns);
}

/// Slices of a body without layers are written for the rail only: the wheel's would be equal.
bool shows_slices(const std::string& body, const StressSections& sections) {
  const auto& material = sections.cross.material;
  return !sections.slices.empty() &&
         (body == "rail" || std::any_of(material.begin(), material.end(), [](int m) { return m > 0; }));
}

/// To a tenth of an MPa: they are looked at.
void write_slices(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                  const std::vector<StressSection>& slices) {
  std::vector<S> points;
  for (const StressSection& slice : slices)
    for (const S& point : section_points(slice, false)) points.push_back(point);
  Columns<S> columns = rounded(place_columns(), 4);
  append(columns, rounded(select(measure_columns(), {"von_mises", "sigma_1", "sigma_xz", "tau_max", "material"}), 1));
  write_csv(file, provenance, points, columns);
}

/// The points of a band's picture: the nodes of its grid, station by station, then those below split interfaces.
class BandPoints {
 public:
  explicit BandPoints(const BandStress& b)
      : sample_(b.sample),
        grid_((b.body->contact.columns + 1) * (b.body->contact.rows + 1)),
        below_(nodes_below(*b.body)) {}

  /// visit(node of the section, station, displacement), in order.
  template <class Visit>
  void each(Visit&& visit) const {
    for (int s = 0; s <= sample_.stations; ++s)
      for (int node = 0; node < grid_; ++node)
        visit(node, s, sample_.displacement[static_cast<std::size_t>(s) * grid_ + node]);
    std::size_t k = 0;
    for (int s = 0; s <= sample_.stations; ++s)
      for (int node : below_) visit(node, s, sample_.below[k++]);
  }
  long long number(int node, int station) const {
    const long long s = station;
    if (node < grid_) return s * grid_ + node;
    const auto doubled = static_cast<long long>(below_.size());
    return (sample_.stations + 1LL) * grid_ + s * doubled +
           (std::find(below_.begin(), below_.end(), node) - below_.begin());
  }

 private:
  const BandSample& sample_;
  int grid_;
  std::vector<int> below_;
};

}  // namespace

void write_sections(const std::filesystem::path& folder, const std::string& body,
                    const std::vector<std::string>& provenance, const StressSections& sections) {
  write_section(folder / (body + "_longitudinal_section.csv"), provenance, sections.longitudinal, true);
  write_section(folder / (body + "_cross_section.csv"), provenance, sections.cross, false);
  if (shows_slices(body, sections)) write_slices(folder / (body + "_slices.csv"), provenance, sections.slices);
}

std::vector<PatchNumber> patch_numbers(bool slip_is_distance) {
  using F = ContactField;
  const Unit slip = slip_is_distance ? unit::kMillimetres : unit::kMillimetresPerSecond;
  return {{"x", unit::kMillimetres, &F::x}, {"y", unit::kMillimetres, &F::y},
          {"z", unit::kMillimetres, &F::z}, {"area", unit::kSquareMillimetres, &F::area},
          {"p", unit::kMPa, &F::p},         {"q_x", unit::kMPa, &F::q_x},
          {"q_y", unit::kMPa, &F::q_y},     {"slip_x", slip, &F::slip_x},
          {"slip_y", slip, &F::slip_y}};
}

Columns<P> patch_columns(bool slip_is_distance) {
  Columns<P> out{{"patch", unit::kCount, &P::patch}};
  for (const PatchNumber& n : patch_numbers(slip_is_distance))
    out.push_back({n.symbol, n.unit, [of = n.values](const P& p) { return (p.field->*of)[p.i]; }});
  append(out, {{kPatchState, unit::kCount, [](const P& p) { return static_cast<double>(p.field->state[p.i]); }}});
  return out;
}

void write_patch_tables(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                        const std::vector<const ContactField*>& fields) {
  Columns<P> columns = patch_columns(fields.front()->slip_is_distance);
  const Columns<P> line = select(columns, {"x", "p", "q_x", "q_y", "slip_x"});
  if (fields.size() == 1) columns.erase(columns.begin());
  write_csv(folder / "patch.csv", provenance, patch_points(fields), columns);
  const CentreLine centre = centre_line(*fields.front());
  ContactField along;
  along.x = centre.x;
  along.p = centre.p;
  along.q_x = centre.q_x;
  along.q_y = centre.q_y;
  along.slip_x = centre.slip_x;
  write_csv(folder / "centre_line.csv", provenance, patch_points({&along}), line);
}

void write_depth_line(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                      const StressSection& line) {
  Columns<S> columns = select(place_columns(), {"depth"});
  append(columns, stress_columns());
  append(columns, select(measure_columns(), {"von_mises", "sigma_1", "sigma_2", "sigma_3", "material"}));
  write_stress_table(file, provenance, section_points(line, true), columns);
}

VtkQuads patch_mesh(const std::vector<const ContactField*>& fields, double wheel_x) {
  VtkQuads mesh;
  for (const ContactField* field : fields) {
    const ContactField& f = *field;
    const auto first = static_cast<long long>(mesh.points.size());
    for (int i = 0; i < f.size(); ++i) mesh.points.push_back({wheel_x + f.x[i], f.y[i], f.z[i]});
    for (long long s = 0; s + 1 < f.stations; ++s)
      for (long long c = 0; c + 1 < f.columns; ++c) {
        const long long a = first + s * f.columns + c;
        mesh.cells.push_back({a, a + f.columns, a + f.columns + 1, a + 1});
      }
  }
  const std::vector<P> points = patch_points(fields);
  const Columns<P> all = patch_columns(fields.front()->slip_is_distance),
                   none{{"", unit::kNone, [](const P&) { return 0.0; }}};
  const auto vector = [&](const char* name, const char* x, const char* y) {
    Columns<P> parts = select(all, {x, y});
    append(parts, none);
    return vtk_field<float>(name, points, parts);
  };
  mesh.point_fields = {vtk_field<float>("pressure", points, select(all, {"p"})), vector("traction", "q_x", "q_y"),
                       vector(fields.front()->slip_is_distance ? "slip" : "slip_velocity", "slip_x", "slip_y"),
                       vtk_field<std::int32_t>("state", points, select(all, {kPatchState}))};
  return mesh;
}

VtkHexahedra band_mesh(const BandStress& b, double wheel_x) {
  VtkHexahedra mesh;
  const ContactBand& band = b.body->contact;
  const Section& section = b.body->blocks[band.block].section;
  const bool turning = b.body->kind == SweepKind::revolve;
  const BandPoints points(b);
  std::vector<float> displacement;
  points.each([&](int node, int s, Vec3 u) {
    // the wheel as it stands over the rail: station angle counted from the vertical below the axle
    const double radius = turning ? -section.nodes[static_cast<std::size_t>(band.columns / 2)].z : 1.0;
    const double along = turning ? b.sample.along[s] / radius : b.sample.along[s];
    const double t = b.body->rises() ? b.body->contact_at - along : along;
    Vec3 p = swept_point(b.body->kind, b.body->origin, section.nodes[node], t);
    p.x += wheel_x;
    mesh.points.push_back(p);
    for (double v : {u.x, u.y, u.z}) displacement.push_back(static_cast<float>(kToMilli * v));
  });
  std::vector<S> cells;
  std::vector<Sym3> sum(mesh.points.size());
  std::vector<int> count(mesh.points.size(), 0), top_material(mesh.points.size(), -1);
  for (int s = 0; s < b.sample.stations; ++s)
    for (int r = 0; r < band.rows; ++r)
      for (int c = 0; c < band.columns; ++c) {
        const auto& q = section.quads[static_cast<std::size_t>(r) * band.columns + c];
        const int one = b.body->rises() ? 3 : 1, three = 4 - one;  // a section on its head is seen from behind
        const std::array<int, 4> around{q[0], q[one], q[2], q[three]};
        std::array<long long, 8> corners{};
        for (int k = 0; k < 8; ++k) corners[k] = points.number(around[k % 4], s + k / 4);
        mesh.cells.push_back(corners);
        const Sym3 value = b.at(c, r, s);
        const int m = b.layer(c, r, s);
        cells.push_back({0, 0, 0, value, m, plastic_at(b.sample.plastic, cells.size())});
        for (long long n : mesh.cells.back()) {
          // at an interface the points belong to the material met first, from the surface down
          if (top_material[n] < 0) top_material[n] = m;
          if (top_material[n] != m) continue;
          sum[n] = sum[n] + value;
          ++count[n];
        }
      }
  std::vector<float> smooth;
  for (std::size_t n = 0; n < sum.size(); ++n)
    smooth.push_back(static_cast<float>(kToMega * von_mises((1.0 / std::max(count[n], 1)) * sum[n])));
  mesh.point_fields = {{"displacement_mm", 3, displacement}, {"von_mises_smooth_MPa", 1, smooth}};
  const Columns<S> measures = measure_columns();
  mesh.cell_fields = {vtk_field<float>("stress", cells, stress_columns())};
  add_vtk_fields<float>(mesh.cell_fields, cells, select(measures, {"von_mises", "sigma_1", "material"}));
  if (b.sample.plastic.empty()) return mesh;
  add_vtk_fields<float>(mesh.cell_fields, cells, accumulated_columns());
  mesh.cell_fields.push_back(vtk_field<float>("plastic_strain", cells, plastic_strain_columns()));
  mesh.cell_fields.push_back(vtk_field<float>("backstress", cells, backstress_columns()));
  return mesh;
}

Columns<HistoryRow> history_columns(bool on_track, bool varies_along, bool unbonded) {
  using H = HistoryRow;
  Columns<H> out{{"time", unit::kMilliseconds, &H::time},
                 {"position", unit::kMillimetres, &H::position},
                 {"torque", unit::kNewtonMetres, &H::torque},
                 {"F_x", unit::kNewtons, [](const H& h) { return h.forces.x; }},
                 {"F_y", unit::kNewtons, [](const H& h) { return h.forces.y; }},
                 {"F_z", unit::kNewtons, [](const H& h) { return h.forces.z; }},
                 {"p_max", unit::kMPa, &H::p_max},
                 {"creepage", unit::kNone, &H::creepage},
                 {"lateral_creepage", unit::kNone, &H::lateral_creepage},
                 {"penetration", unit::kMicrometres, [](const H& h) { return h.forces.penetration; }},
                 {"contact_nodes", unit::kCount, [](const H& h) { return h.forces.nodes; }},
                 {"axle_y", unit::kMillimetres, &H::axle_y},
                 {"axle_vx", unit::kMetresPerSecond, &H::axle_vx},
                 {"axle_vz", unit::kMetresPerSecond, &H::axle_vz},
                 {"spin", unit::kRadiansPerSecond, &H::spin}};
  for (const EnergyEntry& e : kEnergyEntries)
    out.push_back({e.name, unit::kJoules, [value = e.value](const H& h) { return h.energy.*value; }});
  out.push_back({"closure", unit::kJoules, &H::closure});
  if (on_track)
    append(out, {{"foot_z", unit::kMillimetres, &H::foot_z}, {"sleeper_z", unit::kMillimetres, &H::sleeper_z}});
  if (varies_along)
    append(out, {{"height", unit::kMicrometres, [](const H& h) { return h.way.height; }},
                 {"lowering", unit::kMicrometres, [](const H& h) { return h.way.lowering; }},
                 {"patch_length", unit::kMillimetres, [](const H& h) { return h.way.length; }},
                 {"patch_width", unit::kMillimetres, [](const H& h) { return h.way.width; }},
                 {"patches", unit::kCount, [](const H& h) { return h.way.patches; }},
                 {"p_max_x", unit::kMillimetres, [](const H& h) { return h.way.p_max_x; }},
                 {"von_mises", unit::kMPa, [](const H& h) { return h.stress.von_mises; }},
                 {"von_mises_x", unit::kMillimetres, [](const H& h) { return h.stress.x; }},
                 {"von_mises_depth", unit::kMillimetres, [](const H& h) { return h.stress.depth; }}});
  if (unbonded)
    append(out, {{"interface_opening", unit::kMicrometres, [](const H& h) { return h.interface.opening; }},
                 {"interface_slip", unit::kMicrometres, [](const H& h) { return h.interface.slip; }}});
  return out;
}

Columns<PointRow> point_columns(bool yields) {
  using P = PointRow;
  Columns<P> out{{"time", unit::kMilliseconds, &P::time},
                 {"position", unit::kMillimetres, &P::position},
                 {"point", unit::kCount, [](const P& p) { return p.number; }},
                 {"x", unit::kMillimetres, &P::x},
                 {"depth", unit::kMillimetres, &P::depth},
                 {"material", unit::kCount, [](const P& p) { return p.layer; }},
                 {"von_mises", unit::kMPa, [](const P& p) { return von_mises(p.at.stress); }}};
  append(out, tensor_columns<P>("sigma", unit::kMPa, [](const P& p) { return p.at.stress; }));
  out = rounded(out, 3);
  if (yields)
    out.push_back({"plastic_strain_accumulated", unit::kNone, [](const P& p) { return p.at.plastic_strain; }});
  return out;
}

Columns<TransientRow> transient_columns(bool rolls, bool timed) {
  using R = TransientRow;
  Columns<R> out{{"step", unit::kCount, &R::step}};
  if (rolls) out.push_back({"distance", unit::kMillimetres, &R::distance});
  if (timed) out.push_back({"time", unit::kMilliseconds, &R::time});
  out.push_back({"wheel_load", unit::kNewtons, &R::load});
  if (rolls)
    append(out, {{"creepage", unit::kNone, &R::creepage_x},
                 {"lateral_creepage", unit::kNone, &R::creepage_y},
                 {"spin", unit::kPerMetre, &R::spin}});
  else
    append(out, {{"displacement", unit::kMicrometres, &R::displacement_x},
                 {"lateral_displacement", unit::kMicrometres, &R::displacement_y}});
  append(out, {{"F_x", unit::kNewtons, &R::F_x},
               {"F_y", unit::kNewtons, &R::F_y},
               {"F_z", unit::kNewtons, &R::F_z},
               {"normal_force", unit::kNewtons, &R::normal_force},
               {"lateral_force", unit::kNewtons, &R::lateral_force},
               {"spin_moment", unit::kNewtonMetres, &R::spin_moment},
               {"approach", unit::kMicrometres, &R::approach},
               {"p_max", unit::kMPa, &R::p_max},
               {"q_max", unit::kMPa, &R::q_max},
               {"contact_area", unit::kSquareMillimetres, &R::contact_area},
               {"stick_area", unit::kSquareMillimetres, &R::stick_area},
               {"slip_area", unit::kSquareMillimetres, &R::slip_area}});
  if (rolls) out.push_back({"friction_power", unit::kWatts, &R::friction_power});
  out.push_back({"friction_work", unit::kJoules, &R::friction_work});
  return out;
}

Columns<FilmCell> film_columns() {
  using C = FilmCell;
  const Columns<PatchPoint> all = patch_columns(false);
  Columns<C> out{{"step", unit::kCount, &C::step}, {"distance", unit::kMillimetres, &C::distance}};
  append(out, of_part<C>(rounded(select(all, {"x", "y"}), 6), &C::point));
  append(out, of_part<C>(rounded(select(all, {"p", "q_x", "q_y"}), 1), &C::point));
  append(out, of_part<C>(select(all, {kPatchState}), &C::point));
  return out;
}

PatchFilm::PatchFilm(const std::filesystem::path& file, const std::vector<std::string>& provenance)
    : log_(file, provenance, film_columns()) {}

void PatchFilm::add(int step, double distance, const ContactField& f) {
  constexpr int kMostCells = 80;
  const int stride = 1 + (std::max(f.columns, f.stations) - 1) / kMostCells;
  for (int s = (f.stations / 2) % stride; s < f.stations; s += stride)
    for (int c = (f.columns / 2) % stride; c < f.columns; c += stride) {
      const auto k = static_cast<std::size_t>(s) * static_cast<std::size_t>(f.columns) + static_cast<std::size_t>(c);
      if (f.p[k] > 0) log_.add({step, distance, {&f, 1, k}});
    }
}

void PatchFilm::keep(const CsvTable& earlier, int end) {
  for (std::size_t i = 0; i < earlier.rows(); ++i) {
    std::vector<double> row;
    for (const CsvColumn& c : earlier.columns) row.push_back(c.values[i]);
    if (row.front() < end) log_.add_row(row);
  }
}

}  // namespace railstrata
