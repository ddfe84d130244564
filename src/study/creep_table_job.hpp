#pragma once
// A table of creep forces as a job: creep_table.h5 (io/table_file.hpp), creep_table.csv and creep_table.json at the
// end, creep_table.begun.h5 on the way.
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "jobs/job.hpp"
#include "many/table_error.hpp"

namespace railstrata {

struct CreepTableOrder : JobOrder {
  std::vector<std::string> overrides;  ///< of the case
  std::vector<NumberAxis> axes;
  double cell = 0.25e-3;  ///< m
  int places = 200;       ///< where interpolation is compared with direct solutions
};

/// Unsound where points have no answer. To resume where no table was begun begins one.
class CreepTableJob : public CaseJob {
 public:
  /// Throws CaseError as CreepTable, and where tables cannot be written here.
  CreepTableJob(LoadedCase base, CreepTableOrder order, Control& control);
  const CreepTable& table() const { return table_; }
  const TableError& error() const { return error_; }
  nlohmann::ordered_json json() const;  ///< creep_table.json

 private:
  std::string identity() const override;
  void begin() override;
  void resume() override;
  bool finished() const override { return solved_; }
  bool step() override;
  void save() override;
  void finish() override;

  CreepTable table_;
  CreepTableOptions options_;
  int places_;
  TableError error_;
  bool solved_ = false;
};

}  // namespace railstrata
