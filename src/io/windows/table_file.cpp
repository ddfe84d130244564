// Without HDF5 there are no tables of creep forces in files: what would write or read one says so.
#include "io/table_file.hpp"

#include "core/faults.hpp"

namespace railstrata {

void require_table_files() {
  throw EnvironmentError("the program for Windows has no HDF5: it makes and reads no tables of creep forces",
                         "make the table on Linux; its numbers stand in creep_table.csv too");
}

void write_force_table(const std::filesystem::path&, const ForceTable&, const TableRemarks&) { require_table_files(); }

ForceTable read_force_table(const std::filesystem::path&) {
  require_table_files();
  return {};
}

}  // namespace railstrata
