#pragma once
// Files of passes over a yielding rail: passes.csv (a row a pass), residual.csv (a row a point of the section after the
// last pass), profile.csv (a row a depth), passes.json, and state.csv, from which the passes go on to the same bits.
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "case/case_fwd.hpp"
#include "passes/pass_point.hpp"
#include "passes/pass_way.hpp"
#include "passes/pass_words.hpp"
#include "passes/rail_passes.hpp"
#include "result/summary.hpp"

namespace railstrata {

/// Where a series of passes stands.
struct PassSeries {
  std::vector<std::vector<double>> table;  ///< passes.csv, in its units
  PassState state;
  int cycle = 1;  ///< passes that are judged as one: passes_per_cycle (passes/pass_plan.hpp)
  std::vector<std::vector<PassStrain>> points;  ///< per point of the section its last cycles, kPointPasses at most
  std::vector<std::array<double, 7>> begun;  ///< per point plastic strain where the cycle began, Δp since; empty: none
};
/// What classify() asks for at a point.
inline constexpr std::size_t kPointPasses = 4;

/// Adds a pass, `row` of it and what it has done to the points. Of a cycle of several passes Δp is the sum over them
/// and the net strain that from its beginning to its end.
void add_pass(const PassRow& row, const PassResult& result, PassSeries& series);
/// The largest strains of all points, of every whole cycle.
std::vector<PassStrain> cycles_of(const PassSeries& series);
/// Of them; its rate is per pass.
PassVerdict verdict_of(const PassSeries& series);
/// passes.csv: its columns, and a row of it.
std::vector<std::string> pass_columns();
std::vector<double> pass_values(const PassRow& row);
/// Writes such a table, a row a pass.
void write_pass_rows(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                     const std::vector<std::string>& names, const std::vector<std::vector<double>>& table);
/// The largest strains of all passes in such a table, and their verdict.
std::vector<PassStrain> strains_of(const std::vector<std::vector<double>>& table);
PassVerdict verdict_of(const std::vector<std::vector<double>>& table);
/// Adds a pass to the last ones of a point.
void remember_pass(const PassStrain& strain, std::vector<PassStrain>& passes);

/// Quantities of a series of passes (class, strain of the last pass), or none of a single run.
enum class PointColumns { of_passes, of_a_run };
/// A table of points: residual.csv and profile.csv. Of elements with their row and column in the fine zone, -1 deeper.
void write_pass_points(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                       const std::vector<PassPoint>& points, PointColumns which = PointColumns::of_passes);
/// What passes.json says by either method: classes, last pass; points: the last passes of each.
nlohmann::ordered_json pass_verdict(const std::string& title, const std::vector<std::string>& columns,
                                    const std::vector<std::vector<double>>& table,
                                    const std::vector<std::vector<PassStrain>>& points);

/// For passes/pass_words.hpp; last: the row of the last pass.
PassStanding standing_of(const PassSeries& series, const PassRow& last);
PassStanding standing_of(const PassVerdict& verdict, const std::vector<std::vector<double>>& table,
                         const PassRow& last);
/// Passes until the ductility [equivalent strain] is used up, and between which two numbers that lies; null: never by
/// this law. reached: the largest |E^p| so far; cycles of `cycle` passes.
nlohmann::ordered_json ductility_json(double ductility, double reached, const std::vector<PassStrain>& cycles,
                                      int cycle);

void write_pass_table(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                      const PassSeries& series);

/// The state, as one table that is whole or not there.
void write_pass_state(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                      const SteadyGrid& grid, const PassSeries& series);
/// Both back: the table as far as the state. Throws CaseError if they are of another grid.
PassSeries read_pass_series(const std::filesystem::path& state, const std::filesystem::path& table,
                            const SteadyGrid& grid);

/// residual.csv and profile.csv of the last pass.
void write_residual(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                    const RailPasses& rail, const PassSeries& series, const PassResult& last);

/// What passes.json says besides the series itself.
struct PassAnswer {
  std::string verdict, law;         ///< sentences (passes/pass_words.hpp)
  ShakedownSummary shakedown;       ///< of the elastic stress of the first of the tractions; empty: none
  std::optional<double> ductility;  ///< equivalent strain that the material bears
};
void write_pass_summary(const std::filesystem::path& file, const CaseSpec& spec, const RailPasses& rail,
                        const PassSeries& series, const PassResult& last, const PassWay& way, const PassAnswer& answer);

}  // namespace railstrata
