#include "core/faults.hpp"
#include "io/table_file.hpp"

namespace railstrata {

void require_table_files() {
  throw EnvironmentError("the Windows program has no HDF5, so it cannot write or read tables of creep forces",
                         "compute the table on Linux; its numbers are also in creep_table.csv");
}

}  // namespace railstrata
