// The program for Windows has no HDF5; io/table_file refuses before it asks (require_table_files).
#include "hdf5/table_image.hpp"

namespace railstrata {

std::string table_image(const ForceTable&, const TableRemarks&) { return {}; }

std::optional<ForceTable> table_in_file(const std::filesystem::path&) { return std::nullopt; }

}  // namespace railstrata
