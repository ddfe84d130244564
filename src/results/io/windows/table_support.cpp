#include "core/faults.hpp"
#include "io/table_file.hpp"

namespace railstrata {

void require_table_files() {
  throw EnvironmentError("the program for Windows has no HDF5: it makes and reads no tables of creep forces",
                         "make the table on Linux; its numbers stand in creep_table.csv too");
}

}  // namespace railstrata
