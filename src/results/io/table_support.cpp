#include "io/table_file.hpp"

namespace railstrata {

void require_table_files() {}

}  // namespace railstrata
