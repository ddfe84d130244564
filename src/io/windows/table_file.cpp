// Without HDF5 there are no tables of creep forces in files: what would write or read one says so.
#include "io/table_file.hpp"

#include "core/faults.hpp"

namespace railstrata {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file) {
  throw EnvironmentError(file.string() + ": the program for Windows writes and reads no HDF5",
                         "tables of creep forces are made and looked up on Linux");
}

}  // namespace

void write_force_table(const std::filesystem::path& file, const ForceTable&, const TableRemarks&) { refuse(file); }

ForceTable read_force_table(const std::filesystem::path& file) { refuse(file); }

}  // namespace railstrata
