#pragma once
// The page of a creep curve.
#include <filesystem>
#include <string>
#include <vector>

#include "io/csv.hpp"

namespace railstrata {

/// `force`: what the curves are of ("F_x"). The table is that of creep_curve.csv: what varies, then a column for each
/// theory, the slip area, the other force and the moment. Throws EnvironmentError for the disk.
void write_creep_curve_page(const std::filesystem::path& page, const std::string& title, const std::string& force,
                            const std::vector<CsvColumn>& table, const std::vector<std::string>& notes);

}  // namespace railstrata
