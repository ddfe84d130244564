#pragma once
// A table of creep forces as a job: creep_table.h5 (io/table_file.hpp), creep_table.csv and creep_table.json at the
// end, creep_table.begun.h5 on the way.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "creep/table_error.hpp"
#include "jobs/job.hpp"

namespace railstrata {

struct CreepTableOrder : JobOrder {
  std::vector<NumberAxis> axes;
  std::optional<ScaledCounts> scaled{};  ///< none: a plain table
  double cell = kDefaultCell;            ///< m
  int places = 200;                      ///< where interpolation is compared with direct solutions
};

/// Carries the table out; checks fail where points have no answer. To resume where no table was begun begins one.
/// `at_end`: called with the table, its error and creep_table.json. Throws CaseError as CreepTable.
using CreepTableShown = std::function<void(const CreepTable&, const TableError&, const nlohmann::ordered_json&)>;
JobEnd carry_out_creep_table(LoadedCase base, CreepTableOrder order, Control& control,
                             const CreepTableShown& at_end = {});

}  // namespace railstrata
