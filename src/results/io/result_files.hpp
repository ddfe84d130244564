#pragma once
// The files of a result folder: tables for people and scripts, VTK files for pictures. Millimetres and MPa in what
// people read; every column names its unit.
#include <filesystem>
#include <string>
#include <vector>

#include "record/csv.hpp"
#include "record/vtk.hpp"
#include "result/rolling_mean.hpp"
#include "result/stress_maxima.hpp"
#include "result/stress_sections.hpp"
#include "result/transient_row.hpp"

namespace railstrata {

/// A number of the points of a field in patch.csv, written and read back by this list. Slip in mm/s, of a shift in mm.
struct PatchNumber {
  const char* symbol;
  Unit unit;
  std::vector<double> ContactField::*values;
  std::string column_name() const { return symbol + std::string(unit.column_ending); }
};
std::vector<PatchNumber> patch_numbers(bool slip_is_distance);
/// A point of a patch, and its columns: the patch, those numbers, the state.
struct PatchPoint {
  const ContactField* field;
  int patch;  ///< from 1 on
  std::size_t i;
};
Columns<PatchPoint> patch_columns(bool slip_is_distance);
inline constexpr const char* kPatchState = "state_0separated_1stick_2slip";

/// patch.csv: every point of the fields, of several patches one after the other with their numbers from 1 on in the
/// column `patch`; centre_line.csv: along the rolling direction through the largest pressure of the first.
void write_patch_tables(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                        const std::vector<const ContactField*>& fields);

/// depth_line.csv: the six stresses, von Mises and the principal stresses against depth; of a run with plasticity the
/// accumulated plastic strain, plastic strains and backstresses, here and in the sections.
void write_depth_line(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                      const StressSection& line);

/// <body>_longitudinal_section.csv (plane y = const) and <body>_cross_section.csv (plane x = const): cell centres x, y,
/// depth, the six stresses to 1e-3 MPa, von Mises, the largest principal stress and the material; rows of one depth
/// together, from the surface down. <body>_slices.csv (the wheel's where it has layers): coarser cross sections along
/// the patch with von Mises stress, largest principal stress, sigma_xz and the largest shear stress.
void write_sections(const std::filesystem::path& folder, const std::string& body,
                    const std::vector<std::string>& provenance, const StressSections& sections);

/// The patches as quadrilaterals with pressure_MPa, traction_MPa, slip_velocity_mm_s (of a shift slip_mm), state.
VtkQuads patch_mesh(const std::vector<const ContactField*>& fields, double wheel_x);

/// A body's contact band around the wheel: nodes displaced by displacement_mm (a point field, not applied to the
/// points), cell fields stress_MPa, von_mises_MPa, sigma_1_MPa, material; the same stresses averaged to the points
/// within each material, for smooth pictures (von_mises_smooth_MPa). Of a run with plasticity
/// plastic_strain_accumulated (accumulated), plastic_strain and backstress_MPa (tensors) besides, means over an
/// element.
VtkHexahedra band_mesh(const BandStress& band, double wheel_x);

/// history.csv, a row at a time (RecordLog); of a rail on a track with its foot and the nearest sleeper.
Columns<HistoryRow> history_columns(bool on_track, bool varies_along, bool unbonded);

/// A row of points_history.csv: stress at one of the points where the rail changes (fem/watched_points.hpp).
struct PointRow {
  double time, position;
  int number;  ///< from 1
  double x, depth;
  int layer;
  WatchedStress at;
};
Columns<PointRow> point_columns(bool yields);

// ---- files that grow while a transient is followed: history.csv, a row a step, and the patch on its way
/// history.csv of half-spaces (RecordLog). Columns that do not apply to what is followed are left out: a shift has
/// displacements and no creepages, what rolls the other way round.
Columns<TransientRow> transient_columns(bool rolls, bool timed);

/// A cell in contact, in a state of the patch on its way.
struct FilmCell {
  int step;
  double distance;  ///< m
  PatchPoint point;
};

/// patch_film.csv: cells in contact in a number of states (of finite elements nodes in frames, `distance` the wheel's
/// position), for the film of the page: at most some 80 cells along a side, pressures and tractions to a tenth of an
/// MPa.
class PatchFilm {
 public:
  PatchFilm(const std::filesystem::path& file, const std::vector<std::string>& provenance);
  void add(int step, double distance, const ContactField& field);
  /// The rows of an earlier film whose steps come before `end`.
  void keep(const CsvTable& earlier, int end);

 private:
  RecordLog<FilmCell> log_;
};

}  // namespace railstrata
