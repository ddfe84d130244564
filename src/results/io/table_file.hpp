#pragma once
// A creep-force table as an HDF5 file: a data set for each axis, as a dimension scale, and one for each number over all
// of them, with the unit as the attribute `units`. h5py, h5dump, MATLAB and netCDF's readers (xarray) open it.
#include <filesystem>

#include "hdf5/table_image.hpp"

namespace railstrata {

/// Throws EnvironmentError where the program has no HDF5.
void require_table_files();

/// Writes the whole file (record/output_file). The same table has the same bytes. Throws EnvironmentError.
void write_force_table(const std::filesystem::path& file, const ForceTable& table, const TableRemarks& remarks);

/// Throws CaseError: the file cannot be read, or is no such table.
ForceTable read_force_table(const std::filesystem::path& file);

}  // namespace railstrata
