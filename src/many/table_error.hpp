#pragma once
// How far interpolation in a creep-force table is from direct solutions at places spread over it.
#include <string>
#include <vector>

#include "many/creep_table.hpp"

namespace railstrata {

struct TableError {
  struct Number {
    std::string name, unit;
    double largest = 0, mean = 0;  ///< absolute differences
    double scale = 0;              ///< the table's largest magnitude
  };
  int places = 0;
  std::vector<Number> numbers;
};

/// Error at `places` points of a fixed sequence. [Halton1960]
TableError interpolation_error(const CreepTable& table, int places, const CreepTableOptions& options);

}  // namespace railstrata
