#pragma once
// The ranks among which mpirun (or srun with PMIx) has started this process. The plug-in with MPI is loaded here and
// only where there are any.
#include <string>

#include "core/rank_plug_in.hpp"
#include "core/ranks.hpp"

namespace railstrata {

class MpiRanks {
 public:
  /// Joins the other ranks; a single rank without a launcher. Throws EnvironmentError where the plug-in is not there or
  /// refuses.
  MpiRanks();
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  Ranks ranks();

  /// Waits for all and parts from them.
  void leave();
  /// Any of them has been asked to stop; all call it and get the same answer.
  bool any_asked(bool this_one);
  /// After a fault that all ranks have. Ranks other than 0 wait until rank 0 has reported it and ends them. A rank that
  /// ends without leave() ends all.
  void wait_for_rank_0() const;

 private:
  [[maybe_unused]] RailstrataRanks joined_{1, 0, 1, nullptr, nullptr};  // a build without ranks has no use for it
};

/// Throws CaseError among several ranks: without this, a command that does not share its work would run once on each
/// rank and write the same files.
void refuse_ranks(const std::string& command);

/// Before a message that all ranks have. Ranks other than 0 wait until rank 0 ends them, after it has reported it.
void log_on_rank_0_only();

/// The programs that this one starts from now on are no ranks, whatever it is.
void start_children_alone();

}  // namespace railstrata
