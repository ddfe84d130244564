#pragma once
// Interface of the explorer's page to the half-space engine, as texts: the page runs this code in WebAssembly. Its
// numbers are those of `railstrata bem` with the same case, --set and --cell.
#include <memory>
#include <string>
#include <vector>

namespace railstrata {

/// head: JSON; numbers: arrays that it names, as {"first": index, "count": n}.
struct ExplorerAnswer {
  std::string head;
  std::vector<float> numbers;
};

/// Keeps the last contact and its influence operators, so that its stresses can be asked for later. For one thread.
class Explorer {
 public:
  Explorer();
  ~Explorer();

  /// The request is JSON:
  ///   case    text of a case file
  ///   file    its name, for messages and for the folder of profiles; default case.toml
  ///   set     overrides, "key=value", as --set
  ///   cell    m, between kSmallestCell and kLargestCell; default that of the engine
  ///   values  keys whose values the answer shall hold, SI; of a derived one (young_ratio) found from what it gives
  ///   want    of "patch", "stress", "section", "shakedown", "case"; what is not wanted is not computed
  /// The answer holds `ok`. If it is true: `summary` (as summary.json, of what is wanted), `values`, `layers`,
  /// `strengths`, `notes`, `milliseconds`, and `patch`, `section` and `cross` with their arrays,
  /// `case` as a text with every option. Else `faults`: a list of where,
  /// message and remedy. Throws nothing.
  ExplorerAnswer answer(const std::string& request) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace railstrata
