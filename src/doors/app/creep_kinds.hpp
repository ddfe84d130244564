#pragma once
// What `creep` computes: a curve, or a table of creep forces. Both are of steady rolling.
#include <string>
#include <vector>

#include "app/commands.hpp"

namespace railstrata {

struct CreepCurveOptions {
  std::string of = "creepage";  ///< --of: the word of what varies
  double largest = 0;           ///< --largest: creepage, or spin in 1/m; 0: chosen
  int points = 21;              ///< --points
  bool both_sides = false;      ///< --both-sides: braking and driving, left and right
};
ExitCode creep_curve_in_folder(const CreepCurveOptions& wanted, const CommandOptions& options);

struct CreepTableWords {
  std::vector<std::string> axes;  ///< --axis
  std::string scaled;             ///< --scaled ANGLES:SPINS:SIZES; empty: a plain table
  int places = 200;               ///< --places, where interpolation is compared with direct solutions
  bool resume = false;            ///< --resume
};
ExitCode creep_table_in_folder(const CreepTableWords& wanted, const CommandOptions& options);

}  // namespace railstrata
