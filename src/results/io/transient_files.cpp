#include "io/transient_files.hpp"

#include <algorithm>

namespace railstrata {

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
