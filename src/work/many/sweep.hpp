#pragma once
// Half-space solutions over every combination of values of a case's keys.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "ask/answer.hpp"
#include "bem/bem_options.hpp"
#include "core/control.hpp"
#include "many/axis.hpp"
#include "many/case_row.hpp"
#include "reader/case_file.hpp"
#include "record/output_file.hpp"

namespace railstrata {

struct SweepCase {
  std::vector<std::string> values;   ///< one per varied key
  std::optional<LoadedCase> loaded;  ///< none: the case refuses the values
  nlohmann::ordered_json summary;    ///< null: there is none
  std::string fault;                 ///< empty: the result is there and its checks hold
  bool done = false;
};

/// The cases of all rows of values, one per key, in their order, with `further` overrides after the base's own. One
/// whose values are refused carries the fault; if all are, the first one's CaseError is thrown: a key that does not
/// exist, most likely. Throws CaseError for a key without values.
std::vector<SweepCase> plan_rows(const LoadedCase& base, const std::vector<std::string>& further,
                                 const std::vector<std::string>& keys, std::vector<std::vector<std::string>> rows);
/// The same for all combinations.
std::vector<SweepCase> plan_sweep(const LoadedCase& base, const std::vector<Axis>& axes);

struct SweepOptions {
  BemOptions bem;
  bool stresses = false;             ///< the rail's largest stresses too, and what else `bem` judges but one track
  LifeOfFolder life_of = nullptr;    ///< with stresses, of cases with life.until; null: lives are left out
  const Control* control = nullptr;  ///< asked to stop, cases that have not begun are left out
  std::function<void()> ended;       ///< after every case, from any thread, one at a time
};

/// Solves the cases side by side, one thread each: their grids are too small to share one. What goes wrong with a case
/// is its fault; what `ended` throws, the last one of it, is thrown at the end.
void run_sweep(std::vector<SweepCase>& cases, const SweepOptions& options);

/// The cases that are done, in their order: keys, numbers, remarks.
CaseTable sweep_table(const std::vector<SweepCase>& cases, const std::vector<Axis>& axes,
                      const std::vector<ResultColumn>& columns);

/// The page: a chart for each number over the key with most values on an axis, a line for each combination of the other
/// keys', and all cases in a table. Throws EnvironmentError for the disk.
void write_sweep_page(const std::filesystem::path& page, const std::string& title, const std::vector<Axis>& keys,
                      const std::vector<CaseRow>& rows);

}  // namespace railstrata
