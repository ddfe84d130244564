#include "io/transient_files.hpp"

#include <algorithm>
#include <cmath>
#include "core/si_prefix.hpp"

namespace railstrata {
namespace {

struct HistoryColumn {
  enum class Of { both, rolling, shift, timed };
  const char* name;
  double (*value)(const TransientRow&);
  Of of = Of::both;
};

using Row = TransientRow;
using Of = HistoryColumn::Of;
constexpr HistoryColumn kColumns[] = {
    {"step", [](const Row& r) { return static_cast<double>(r.step); }},
    {"distance_mm", [](const Row& r) { return kToMilli * r.distance; }, Of::rolling},
    {"time_ms", [](const Row& r) { return kToMilli * r.time; }, Of::timed},
    {"wheel_load_N", [](const Row& r) { return r.load; }},
    {"displacement_um", [](const Row& r) { return kToMicro * r.displacement_x; }, Of::shift},
    {"lateral_displacement_um", [](const Row& r) { return kToMicro * r.displacement_y; }, Of::shift},
    {"creepage", [](const Row& r) { return r.creepage_x; }, Of::rolling},
    {"lateral_creepage", [](const Row& r) { return r.creepage_y; }, Of::rolling},
    {"spin_1_m", [](const Row& r) { return r.spin; }, Of::rolling},
    {"F_x_N", [](const Row& r) { return r.F_x; }},
    {"F_y_N", [](const Row& r) { return r.F_y; }},
    {"F_z_N", [](const Row& r) { return r.F_z; }},
    {"normal_force_N", [](const Row& r) { return r.normal_force; }},
    {"lateral_force_N", [](const Row& r) { return r.lateral_force; }},
    {"spin_moment_N_m", [](const Row& r) { return r.spin_moment; }},
    {"approach_um", [](const Row& r) { return kToMicro * r.approach; }},
    {"p_max_MPa", [](const Row& r) { return kToMega * r.p_max; }},
    {"q_max_MPa", [](const Row& r) { return kToMega * r.q_max; }},
    {"contact_area_mm2", [](const Row& r) { return kToMicro * r.contact_area; }},
    {"stick_area_mm2", [](const Row& r) { return kToMicro * r.stick_area; }},
    {"slip_area_mm2", [](const Row& r) { return kToMicro * r.slip_area; }},
    {"friction_power_W", [](const Row& r) { return r.friction_power; }, Of::rolling},
    {"friction_work_J", [](const Row& r) { return r.friction_work; }},
};

bool has(const HistoryColumn& c, bool rolls, bool timed) {
  return c.of == Of::both || (c.of == Of::timed && timed) || c.of == (rolls ? Of::rolling : Of::shift);
}

std::vector<std::string> names_of(bool rolls, bool timed) {
  std::vector<std::string> out;
  for (const HistoryColumn& c : kColumns)
    if (has(c, rolls, timed)) out.emplace_back(c.name);
  return out;
}

double rounded(double value, double to) { return std::round(value / to) * to; }

}  // namespace

TransientLog::TransientLog(const std::filesystem::path& file, const std::vector<std::string>& provenance, bool rolls,
                           bool timed)
    : rolls_(rolls), timed_(timed), log_(file, provenance, names_of(rolls, timed)) {}

void TransientLog::add(const TransientRow& row) {
  std::vector<double> values;
  for (const HistoryColumn& c : kColumns)
    if (has(c, rolls_, timed_)) values.push_back(c.value(row));
  log_.add(values);
}

PatchFilm::PatchFilm(const std::filesystem::path& file, const std::vector<std::string>& provenance)
    : log_(file, provenance,
           {"step", "distance_mm", "x_mm", "y_mm", "p_MPa", "q_x_MPa", "q_y_MPa", "state_0separated_1stick_2slip"}) {}

void PatchFilm::add(int step, double distance, const ContactField& f) {
  constexpr int kMostCells = 80;
  const int stride = 1 + (std::max(f.columns, f.stations) - 1) / kMostCells;
  for (int s = (f.stations / 2) % stride; s < f.stations; s += stride)
    for (int c = (f.columns / 2) % stride; c < f.columns; c += stride) {
      const auto k = static_cast<std::size_t>(s) * static_cast<std::size_t>(f.columns) + static_cast<std::size_t>(c);
      if (!(f.p[k] > 0)) continue;
      log_.add({static_cast<double>(step), kToMilli * distance, rounded(kToMilli * f.x[k], 1e-6),
                rounded(kToMilli * f.y[k], 1e-6), rounded(kToMega * f.p[k], 0.1), rounded(kToMega * f.q_x[k], 0.1),
                rounded(kToMega * f.q_y[k], 0.1), static_cast<double>(f.state[k])});
    }
}

void PatchFilm::keep(const CsvTable& earlier, int end) {
  for (std::size_t i = 0; i < earlier.rows(); ++i) {
    std::vector<double> row;
    for (const CsvColumn& c : earlier.columns) row.push_back(c.values[i]);
    if (row.front() < end) log_.add(row);
  }
}

}  // namespace railstrata
