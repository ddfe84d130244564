#pragma once
// Files of passes over a yielding rail: passes.csv (a row a pass), residual.csv (a row a point of the section after the
// last pass), profile.csv (a row a depth), passes.json, and state.csv, from which the passes go on to the same bits.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "passes/pass_series.hpp"
#include "record/column.hpp"
#include "result/summary.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

struct PassWay;  // passes/pass_way.hpp

/// passes.csv: the columns that both methods have.
Columns<PassRow> pass_columns();
/// Plastic strain of passes read back from such a table.
std::vector<PassStrain> pass_strains(const CsvTable& table);
/// A row of the stationary method; cycle: that which the pass completes, else NaN.
struct StationaryRow {
  const PassRow& pass;
  PassStrain cycle;
};
Columns<StationaryRow> stationary_columns();
/// Quantities of a series of passes (class, strain of the last pass), or none of a single run.
enum class PointColumns { of_passes, of_a_run };
/// The columns of points: of the files of passes those of the last one too.
struct PointLists {
  Columns<PassPoint> zone, of_pass, stress, plastic, accumulated;
};
PointLists point_lists(PointColumns which);
/// Meaning of their numbers.
inline constexpr const char* kPointRemark =
    "class: 0 elastic shakedown, 1 plastic shakedown, 2 ratchetting, 3 transient. plastic_xy ...: tensor shears; "
    "plastic_strain_accumulated: accumulated over all passes.";
/// A table of points: residual.csv and profile.csv. Of elements with their row and column in the fine zone, -1 deeper.
void write_pass_points(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                       const std::vector<PassPoint>& points, PointColumns which = PointColumns::of_passes);

/// The state, as one table that is whole or not there.
void write_pass_state(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                      const SteadyGrid& grid, const PassSeries& series);
/// Stations of the grid that a state belongs to, as in SteadyGrid::active_stations.
int active_stations(const std::filesystem::path& state);
/// Reads both; the table up to the pass of the state. cycle: see PassSeries. Throws CaseError if they are of
/// another grid.
PassSeries read_pass_series(const std::filesystem::path& state, const std::filesystem::path& table,
                            const SteadyGrid& grid, int cycle = 1);

/// All points, row by row.
std::vector<PassPoint> section_points(const RailPasses& rail, const PassSeries& series, const PassResult& last);
/// residual.csv and profile.csv of the last pass.
void write_residual(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                    const RailPasses& rail, const PassSeries& series, const PassResult& last);

// ---- contents of passes.json that both methods have
/// The last row of passes.csv, but for its number; null for what is not finite.
nlohmann::ordered_json last_pass_json(const CsvTable& table);

/// Number of points of each class. points: the last passes of each; whole: the class of the series.
nlohmann::ordered_json points_json(const std::vector<std::vector<PassStrain>>& points, PassClass whole);

/// Passes until the ductility [equivalent strain] is used up, and between which two numbers that lies; null: never by
/// this law. reached: the largest equivalent plastic strain so far; cycles of `cycle` passes.
nlohmann::ordered_json ductility_json(double ductility, double reached, const std::vector<PassStrain>& cycles,
                                      int cycle);

/// A zone of the rail: 0 the rail itself, then its layers from the surface down.
struct ZoneTop {
  int zone = 0;
  double top = 0;  ///< m below the surface
};
nlohmann::ordered_json zones_json(const CaseSpec& spec, const std::vector<ZoneTop>& zones);

/// Positions of the points whose loops are in loops.csv.
nlohmann::ordered_json loops_json(const std::vector<PassLoop>& loops);

/// Contents of passes.json besides the series itself.
struct PassAnswer {
  std::string verdict, law;         ///< sentences (passes/pass_series.hpp)
  Summary elastic;                  ///< of the first of the tractions, with its shakedown where there are strengths
  std::vector<std::string> doubts;  ///< failed checks and warnings of the contact that all passes use
  std::optional<double> ductility;  ///< equivalent strain that the material bears
  PassErrors error;
  std::string no_error;  ///< why it is not known
};
void write_pass_summary(const std::filesystem::path& file, const CaseSpec& spec, const RailPasses& rail,
                        const PassSeries& series, const PassResult& last, const PassWay& way, const PassAnswer& answer);

}  // namespace railstrata
