#include "io/table_file.hpp"

#include <fmt/format.h>

#include "core/faults.hpp"
#include "record/output_file.hpp"

namespace railstrata {

void write_force_table(const std::filesystem::path& file, const ForceTable& table, const TableRemarks& remarks) {
  require_table_files();
  check(table);
  const std::string image = table_image(table, remarks);
  if (image.empty())
    throw EnvironmentError(fmt::format("cannot make {}: HDF5 could not hold the table in memory", file.string()),
                           "free memory and start the command again");
  write_whole_file(file, image);
}

ForceTable read_force_table(const std::filesystem::path& file) {
  require_table_files();
  const std::string remedy = "name a creep_table.h5 of railstrata creep --axis";
  if (!std::filesystem::is_regular_file(file)) throw CaseError("there is no such file", remedy, file.string());
  const std::optional<ForceTable> out = table_in_file(file);
  if (!out) throw CaseError("is no creep-force table", remedy, file.string());
  check(*out);
  return *out;
}

}  // namespace railstrata
