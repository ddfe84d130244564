#pragma once
// Files of passes over a yielding rail: passes.csv (a row a pass), residual.csv (a row a point of the section after the
// last pass), profile.csv (a row a depth), passes.json, and state.csv, from which the passes go on to the same bits.
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "case/case_spec.hpp"
#include "post/rail_passes.hpp"

namespace railstrata {

/// Where a series of passes stands.
struct PassSeries {
  std::vector<std::vector<double>> table;  ///< passes.csv, in its units
  PassState state;
  std::vector<std::vector<PassStrain>> points;  ///< per point of the section its last passes, kPointPasses at most
};
/// What classify() asks for at a point.
inline constexpr std::size_t kPointPasses = 4;

/// Adds the pass whose state the series has already.
void add_pass(const SteadyGrid& grid, const PassResult& result, PassSeries& series);
/// Of the largest strains of all passes.
PassVerdict verdict_of(const PassSeries& series);

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
void write_pass_summary(const std::filesystem::path& file, const CaseSpec& spec, const RailPasses& rail,
                        const PassSeries& series);

}  // namespace railstrata
