#pragma once
// The finite element run of a case, from the spec to the files of its folder.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "case/case_spec.hpp"
#include "io/checkpoint_file.hpp"
#include "post/summary.hpp"
#include "runs/run_control.hpp"

namespace railstrata {

/// What the caller wants to hear: a phase ("mesh", "preload", "rolling", "results"), how far it is (0..1, negative:
/// unknown) and a line of numbers; or an event on the way
/// ("checkpoint", "warning") in words.
using RunReporter = std::function<void(const std::string& phase, double fraction, const std::string& detail)>;

struct FemRequest {
  CaseSpec spec;
  std::filesystem::path case_folder;    ///< of relative profile names
  std::filesystem::path out;            ///< exists
  std::vector<std::string> provenance;  ///< "#" lines of the tables
  std::string commit;
  int threads = 0;
  RunReporter report;
  std::function<void()> begin;  ///< called when mesh and memory are known to do, before the first file is written
  RunTimes times;
  std::string case_sha256;         ///< names the case in checkpoints
  std::string program;             ///< version_text()
  std::optional<RunState> resume;  ///< from a checkpoint of this folder
};

struct FemOutcome {
  std::vector<Summary> summaries;  ///< one per wanted position, in order of position; the last one is summary.json
  bool stopped = false;        ///< before the last position, with a checkpoint: results of the finished positions only
  bool limit_reached = false;  ///< that was for RunTimes::limit
};

/// Writes into request.out: history.csv, and per position (in the folder itself for the last, in position_<mm>/ for the
/// others) summary.json, patch.csv, centre_line.csv, depth_line.csv, patch.vtp, rail.vtu, wheel.vtu; patch.pvd with its
/// frames; checkpoint.h5 while it runs, removed when all results are there. A checkpoint on the way that cannot be
/// written is a warning to `report`, a last one an error. Throws as build_model and run_rolling do.
FemOutcome run_fem(const FemRequest& request);

}  // namespace railstrata
