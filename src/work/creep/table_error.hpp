#pragma once
// How far interpolation in a creep-force table is from direct solutions at places spread over it.
#include <string>
#include <vector>

#include "creep/creep_table.hpp"

namespace railstrata {

struct TableError {
  /// |(dF_x, dF_y)| over friction times normal force.
  struct CreepForce {
    double half = 0, most = 0, largest = 0;  ///< half and 95 % of the places are below; the largest of all
    std::vector<double> where;               ///< the place of the largest, as asked for
  };
  struct Number {
    std::string name, unit;
    double largest = 0, mean = 0;  ///< absolute differences
    double scale = 0;              ///< the largest magnitude at the places, solved for
  };
  int places = 0;
  std::vector<Number> numbers;
  CreepForce creep_force;
};

/// Error at `places` points of a fixed sequence [Halton1960], which depend on the ends of the asked axes alone: even
/// between them; in every second one creepages and spin are dense about 0 as the values of "+-largest:count" are.
TableError interpolation_error(const CreepTable& table, int places, const CreepTableOptions& options);

}  // namespace railstrata
