#pragma once
// Files of passes by the finite elements: those of passes/pass_files.hpp with the contact of every pass besides.
#include <filesystem>
#include <string>
#include <vector>

#include "passes/pass_files.hpp"
#include "passes/rolled_pass.hpp"

namespace railstrata {

/// Lengths and steady range of a pass.
struct PassRoll {
  double half_length = 0;   ///< m, of Hertz's ellipse along the rail
  double length = 0;        ///< m, from where the wheel is put on to where it is lifted off
  double from = 0, to = 0;  ///< m, the steady stations
};

/// A series of passes by the finite elements: all so far.
struct RolledSeries {
  int passes = 0;
  PlasticSection section;                       ///< after the last one; without quadrilaterals before the first
  std::vector<std::vector<PassStrain>> points;  ///< per quadrilateral its last passes
  CsvTable table;                               ///< passes.csv
  std::vector<PassStrain> strains;              ///< the largest of all points, of every pass
  double creepage_shift = 0;  ///< by what the creepage for a wanted traction differs from the estimate
};

/// Adds a pass to the series: its row, its points and their class.
void add_rolled_pass(const PlasticSection& section, RolledPass& pass, RolledSeries& series);

/// The state as one table that is whole or not there: a row a pair of Gauss points.
void write_rolled_state(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                        const RolledSeries& series);
/// Reads both; the table up to the pass of the state. Throws CaseError if they do not belong together.
RolledSeries read_rolled_series(const std::filesystem::path& state, const std::filesystem::path& table);

/// residual.csv, profile.csv, section.vtp, loops.csv (the last two not where nothing has yielded) and passes.json.
/// pass: the last one.
void write_rolled_result(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                         const CaseSpec& spec, const PassRoll& roll, const RolledSeries& series, const RolledPass& pass,
                         const std::vector<PassLoop>& loops);

/// residual.json of a single run, and where there is residual stress residual.csv and section.vtp.
void write_run_residual(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                        const RunResidual& residual);

}  // namespace railstrata
