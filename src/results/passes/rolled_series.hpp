#pragma once
// A series of passes by the finite elements.
#include <vector>

#include "passes/rolled_pass.hpp"
#include "record/csv.hpp"

namespace railstrata {

/// All passes so far.
struct RolledSeries {
  int passes = 0;
  PlasticSection section;                       ///< after the last one; without quadrilaterals before the first
  std::vector<std::vector<PassStrain>> points;  ///< per quadrilateral its last passes
  CsvTable table;                               ///< passes.csv
  std::vector<PassStrain> strains;              ///< the largest of all points, of every pass
  double creepage_shift = 0;  ///< by what the creepage for a wanted traction differs from the estimate
};

/// Contact in the middle of the evaluated end of a pass.
struct PassContact {
  double traction = 0, creepage = 0;  ///< F_x over F_z on the wheel; longitudinal
  double p_max = 0;                   ///< Pa
  double lateral = 0;                 ///< m, of the wheel, to the field side of the case's own place
};

/// Adds a pass to the series: its row, its points and their class.
void add_rolled_pass(const PlasticSection& section, const PassContact& contact, RolledPass& pass, RolledSeries& series);

}  // namespace railstrata
