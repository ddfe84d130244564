#include "io/result_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/si_prefix.hpp"
#include "material/elastic.hpp"

namespace railstrata {
namespace {

std::vector<double> state_numbers(const ContactField& f) {
  std::vector<double> out;
  for (ContactState s : f.state) out.push_back(static_cast<double>(s));
  return out;
}

std::string slip_column(const char* direction, const ContactField& f) {
  return fmt::format("slip_{}_{}", direction, f.slip_is_distance ? "mm" : "mm_s");
}

void push(std::vector<float>& out, const Sym3& s) {
  for (double v : {s.xx, s.yy, s.zz, s.xy, s.yz, s.xz}) out.push_back(static_cast<float>(kToMega * v));
}

constexpr const char* kComponents[] = {"xx", "yy", "zz", "xy", "yz", "xz"};

/// Columns of what has yielded, behind those of the stress; none where nothing may yield.
void add_plastic(const std::vector<ElementPlasticity>& states, std::vector<CsvColumn>& columns) {
  if (states.empty()) return;
  const auto components = [](const Sym3& s) { return std::array{s.xx, s.yy, s.zz, s.xy, s.yz, s.xz}; };
  const auto add = [&](std::string name, auto&& value) {
    columns.push_back({std::move(name), {}});
    for (const ElementPlasticity& state : states) columns.back().values.push_back(value(state));
  };
  add("plastic_p", [](const ElementPlasticity& e) { return e.accumulated; });
  for (std::size_t i = 0; i < 6; ++i)
    add(fmt::format("plastic_{}", kComponents[i]), [&](const ElementPlasticity& e) { return components(e.strain)[i]; });
  for (std::size_t i = 0; i < 6; ++i)
    add(fmt::format("backstress_{}_MPa", kComponents[i]),
        [&](const ElementPlasticity& e) { return kToMega * components(e.backstress)[i]; });
}

void write_section(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                   const StressSection& section, bool longitudinal) {
  const char* names[] = {"x_mm",         "y_mm",          "depth_mm",     "sigma_xx_MPa",
                         "sigma_yy_MPa", "sigma_zz_MPa",  "sigma_xy_MPa", "sigma_yz_MPa",
                         "sigma_xz_MPa", "von_mises_MPa", "sigma_1_MPa",  "material"};
  std::vector<CsvColumn> columns;
  for (const char* n : names) columns.push_back({n, {}});
  for (std::size_t i = 0; i < section.stress.size(); ++i) {
    const Sym3& s = section.stress[i];
    const double along = section.along[i % section.along.size()], depth = section.depth[i / section.along.size()];
    const double row[] = {kToMilli * (longitudinal ? along : section.at),
                          kToMilli * (longitudinal ? section.at : along),
                          kToMilli * depth,
                          kToMega * s.xx,
                          kToMega * s.yy,
                          kToMega * s.zz,
                          kToMega * s.xy,
                          kToMega * s.yz,
                          kToMega * s.xz,
                          kToMega * von_mises(s),
                          kToMega * principal_stresses(s).x,
                          static_cast<double>(section.material[i])};
    for (std::size_t k = 0; k < columns.size(); ++k)
      columns[k].values.push_back(k < 3 ? std::round(1e6 * row[k]) / 1e6 : std::round(1e3 * row[k]) / 1e3);
  }
  add_plastic(section.plastic, columns);
  write_csv(file, provenance, columns);
}

/// Of a body without layers only the rail's: the wheel's would say the same.
bool shows_slices(const std::string& body, const StressSections& sections) {
  const auto& material = sections.cross.material;
  return !sections.slices.empty() &&
         (body == "rail" || std::any_of(material.begin(), material.end(), [](int m) { return m > 0; }));
}

/// To a tenth of an MPa: they are looked at.
void write_slices(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                  const std::vector<StressSection>& slices) {
  std::vector<CsvColumn> columns{{"x_mm", {}},        {"y_mm", {}},         {"depth_mm", {}},    {"von_mises_MPa", {}},
                                 {"sigma_1_MPa", {}}, {"sigma_xz_MPa", {}}, {"tau_max_MPa", {}}, {"material", {}}};
  for (const StressSection& slice : slices)
    for (std::size_t i = 0; i < slice.stress.size(); ++i) {
      const Sym3& s = slice.stress[i];
      const Vec3 principal = principal_stresses(s);
      const double y = slice.along[i % slice.along.size()], depth = slice.depth[i / slice.along.size()];
      const double row[] = {kToMilli * slice.at,
                            kToMilli * y,
                            kToMilli * depth,
                            kToMega * von_mises(s),
                            kToMega * principal.x,
                            kToMega * s.xz,
                            kToMega * largest_shear(principal),
                            static_cast<double>(slice.material[i])};
      for (std::size_t k = 0; k < columns.size(); ++k)
        columns[k].values.push_back(k < 3 ? std::round(1e4 * row[k]) / 1e4 : std::round(10 * row[k]) / 10);
    }
  write_csv(file, provenance, columns);
}

std::vector<CsvColumn> patch_columns(const ContactField& f) {
  return {{"x_mm", scaled(f.x, kToMilli)},
          {"y_mm", scaled(f.y, kToMilli)},
          {"z_mm", scaled(f.z, kToMilli)},
          {"area_mm2", scaled(f.area, 1e6)},
          {"p_MPa", scaled(f.p, kToMega)},
          {"q_x_MPa", scaled(f.q_x, kToMega)},
          {"q_y_MPa", scaled(f.q_y, kToMega)},
          {slip_column("x", f), scaled(f.slip_x, kToMilli)},
          {slip_column("y", f), scaled(f.slip_y, kToMilli)},
          {"state_0separated_1stick_2slip", state_numbers(f)}};
}

/// The rows of a further table of the same columns.
void append(std::vector<CsvColumn>& columns, const std::vector<CsvColumn>& more) {
  if (columns.empty()) {
    columns = more;
    return;
  }
  for (std::size_t k = 0; k < columns.size(); ++k)
    columns[k].values.insert(columns[k].values.end(), more[k].values.begin(), more[k].values.end());
}

/// Of every point the number of its patch, from 1 on.
std::vector<double> patch_numbers(const std::vector<const ContactField*>& fields) {
  std::vector<double> out;
  for (std::size_t k = 0; k < fields.size(); ++k)
    out.insert(out.end(), static_cast<std::size_t>(fields[k]->size()), static_cast<double>(k + 1));
  return out;
}

}  // namespace

void write_sections(const std::filesystem::path& folder, const std::string& body,
                    const std::vector<std::string>& provenance, const StressSections& sections) {
  write_section(folder / (body + "_longitudinal_section.csv"), provenance, sections.longitudinal, true);
  write_section(folder / (body + "_cross_section.csv"), provenance, sections.cross, false);
  if (shows_slices(body, sections)) write_slices(folder / (body + "_slices.csv"), provenance, sections.slices);
}

void write_patch_tables(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                        const std::vector<const ContactField*>& fields) {
  std::vector<CsvColumn> columns;
  for (const ContactField* field : fields) append(columns, patch_columns(*field));
  if (fields.size() > 1) columns.insert(columns.begin(), {"patch", patch_numbers(fields)});
  write_csv(folder / "patch.csv", provenance, columns);
  const ContactField& f = *fields.front();
  const CentreLine line = centre_line(f);
  write_csv(folder / "centre_line.csv", provenance,
            {{"x_mm", scaled(line.x, kToMilli)},
             {"p_MPa", scaled(line.p, kToMega)},
             {"q_x_MPa", scaled(line.q_x, kToMega)},
             {"q_y_MPa", scaled(line.q_y, kToMega)},
             {slip_column("x", f), scaled(line.slip_x, kToMilli)}});
}

void write_depth_line(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                      const DepthLine& line) {
  const char* names[] = {"depth_mm",     "sigma_xx_MPa", "sigma_yy_MPa", "sigma_zz_MPa",
                         "sigma_xy_MPa", "sigma_yz_MPa", "sigma_xz_MPa", "von_mises_MPa",
                         "sigma_1_MPa",  "sigma_2_MPa",  "sigma_3_MPa",  "material"};
  std::vector<CsvColumn> columns;
  for (const char* n : names) columns.push_back({n, {}});
  for (std::size_t i = 0; i < line.depth.size(); ++i) {
    const Sym3& s = line.stress[i];
    const Vec3 p = principal_stresses(s);
    const double row[] = {kToMilli * line.depth[i],
                          kToMega * s.xx,
                          kToMega * s.yy,
                          kToMega * s.zz,
                          kToMega * s.xy,
                          kToMega * s.yz,
                          kToMega * s.xz,
                          kToMega * von_mises(s),
                          kToMega * p.x,
                          kToMega * p.y,
                          kToMega * p.z,
                          static_cast<double>(line.material[i])};
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].values.push_back(row[k]);
  }
  add_plastic(line.plastic, columns);
  write_csv(file, provenance, columns);
}

VtkQuads patch_mesh(const std::vector<const ContactField*>& fields, double wheel_x) {
  VtkQuads mesh;
  std::vector<float> pressure, traction, slip;
  std::vector<std::int32_t> state;
  for (const ContactField* field : fields) {
    const ContactField& f = *field;
    const auto first = static_cast<long long>(mesh.points.size());
    for (int i = 0; i < f.size(); ++i) {
      mesh.points.push_back({wheel_x + f.x[i], f.y[i], f.z[i]});
      pressure.push_back(static_cast<float>(kToMega * f.p[i]));
      for (double v : {f.q_x[i], f.q_y[i], 0.0}) traction.push_back(static_cast<float>(kToMega * v));
      for (double v : {f.slip_x[i], f.slip_y[i], 0.0}) slip.push_back(static_cast<float>(kToMilli * v));
      state.push_back(static_cast<std::int32_t>(f.state[i]));
    }
    for (long long s = 0; s + 1 < f.stations; ++s)
      for (long long c = 0; c + 1 < f.columns; ++c) {
        const long long a = first + s * f.columns + c;
        mesh.cells.push_back({a, a + f.columns, a + f.columns + 1, a + 1});
      }
  }
  mesh.point_fields = {{"pressure_MPa", 1, pressure},
                       {"traction_MPa", 3, traction},
                       {fields.front()->slip_is_distance ? "slip_mm" : "slip_velocity_mm_s", 3, slip},
                       {"state", 1, state}};
  return mesh;
}

namespace {

/// In the order of the cells.
void add_plastic(const std::vector<ElementPlasticity>& states, std::vector<VtkField>& fields) {
  if (states.empty()) return;
  std::vector<float> accumulated, strain, backstress;
  for (const ElementPlasticity& e : states) {
    accumulated.push_back(static_cast<float>(e.accumulated));
    for (double v : {e.strain.xx, e.strain.yy, e.strain.zz, e.strain.xy, e.strain.yz, e.strain.xz})
      strain.push_back(static_cast<float>(v));
    push(backstress, e.backstress);
  }
  fields.push_back({"plastic_p", 1, std::move(accumulated)});
  fields.push_back({"plastic_strain", 6, std::move(strain)});
  fields.push_back({"backstress_MPa", 6, std::move(backstress)});
}

}  // namespace

VtkHexahedra band_mesh(const BandStress& b, double wheel_x) {
  VtkHexahedra mesh;
  const ContactBand& band = b.body->contact;
  const Section& section = b.body->blocks[band.block].section;
  const int nc = band.columns + 1, nr = band.rows + 1, per_station = nc * nr;
  const bool turning = b.body->kind == SweepKind::revolve;
  std::vector<float> displacement;
  for (int s = 0; s <= b.sample.stations; ++s)
    for (int k = 0; k < per_station; ++k) {
      // the wheel as it stands over the rail: station angle counted from the vertical below the axle
      const double radius = turning ? -section.nodes[static_cast<std::size_t>(band.columns / 2)].z : 1.0;
      const double t = turning ? b.sample.along[s] / radius : b.sample.along[s];
      Vec3 p = swept_point(b.body->kind, b.body->origin, section.nodes[k], t);
      p.x += wheel_x;
      mesh.points.push_back(p);
      const Vec3 u = b.sample.displacement[static_cast<std::size_t>(s) * per_station + k];
      for (double v : {u.x, u.y, u.z}) displacement.push_back(static_cast<float>(kToMilli * v));
    }
  std::vector<float> stress, equivalent, principal;
  std::vector<std::int32_t> material;
  std::vector<Sym3> sum(mesh.points.size());
  std::vector<int> count(mesh.points.size(), 0), top_material(mesh.points.size(), -1);
  for (int s = 0; s < b.sample.stations; ++s)
    for (int r = 0; r < band.rows; ++r)
      for (int c = 0; c < band.columns; ++c) {
        const long long a = static_cast<long long>(s) * per_station;
        const auto& q = section.quads[static_cast<std::size_t>(r) * band.columns + c];
        mesh.cells.push_back({a + q[0], a + q[1], a + q[2], a + q[3], a + per_station + q[0], a + per_station + q[1],
                              a + per_station + q[2], a + per_station + q[3]});
        const Sym3 value = b.at(c, r, s);
        push(stress, value);
        equivalent.push_back(static_cast<float>(kToMega * von_mises(value)));
        principal.push_back(static_cast<float>(kToMega * principal_stresses(value).x));
        const int m = b.body->layer_of(section.quad_material[static_cast<std::size_t>(r) * band.columns + c]);
        material.push_back(m);
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
  mesh.cell_fields = {{"stress_MPa", 6, stress},
                      {"von_mises_MPa", 1, equivalent},
                      {"sigma1_MPa", 1, principal},
                      {"material", 1, material}};
  add_plastic(b.sample.plastic, mesh.cell_fields);
  return mesh;
}

HistoryLog::HistoryLog(const std::filesystem::path& file, const std::vector<std::string>& provenance)
    : log_(
          file, provenance,
          {"time_ms",          "position_mm", "torque_N_m",       "F_x_N",          "F_y_N",         "F_z_N",
           "p_max_MPa",        "creepage",    "lateral_creepage", "penetration_um", "contact_nodes", "axle_y_mm",
           "axle_vx_m_s",      "axle_vz_m_s", "spin_rad_s",       "kinetic_J",      "strain_J",      "hourglass_J",
           "weight_J",         "spring_J",    "torque_work_J",    "guide_work_J",   "friction_J",    "contact_normal_J",
           "run_up_damping_J", "absorbed_J",  "dashpot_J",        "plastic_J",      "closure_J"}) {}

void HistoryLog::add(const HistoryRow& r) {
  const EnergyBalance& e = r.energy;
  log_.add({1e3 * r.time,
            kToMilli * r.position,
            r.torque,
            r.forces.x,
            r.forces.y,
            r.forces.z,
            kToMega * r.p_max,
            r.creepage,
            r.lateral_creepage,
            1e6 * r.forces.penetration,
            static_cast<double>(r.forces.nodes),
            kToMilli * r.axle_y,
            r.axle_vx,
            r.axle_vz,
            r.spin,
            e.kinetic,
            e.strain,
            e.hourglass,
            e.weight,
            e.spring,
            e.torque_work,
            e.guide_work,
            e.friction,
            e.contact_normal,
            e.damping,
            e.absorbed,
            e.dashpot,
            e.plastic,
            r.closure});
}

}  // namespace railstrata
