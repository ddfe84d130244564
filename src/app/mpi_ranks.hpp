#pragma once
// The ranks among which mpirun (or srun with PMIx) has started this process. The plug-in that speaks MPI is loaded here
// and only where there are any.
#include <string>

#include "core/rank_plug_in.hpp"
#include "core/ranks.hpp"

namespace railstrata {

class MpiRanks {
 public:
  /// Joins the others; alone where nobody has started any. Throws EnvironmentError where the plug-in is not there or
  /// refuses.
  MpiRanks();
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  Ranks ranks();

  /// Waits for all and parts from them.
  void leave();
  /// Any of them has been asked to stop; all call it and get the same answer.
  bool any_asked(bool this_one);
  /// Of a rank with a fault that all have: those that do not speak wait for the end, which rank 0 brings when it has
  /// told it. Who ends without leave() ends them all.
  void let_rank_0_speak() const;

 private:
  RailstrataRanks joined_{1, 0, 1, nullptr, nullptr};
};

/// Throws CaseError among ranks: so many of a command that knows nothing of them would do the same work and write the
/// same files.
void refuse_ranks(const std::string& command);

/// Before a message that all ranks have: those that do not speak wait for the end, which rank 0 brings when it has told
/// it.
void leave_words_to_rank_0();

/// The programs that this one starts from now on are no ranks, whatever it is.
void start_children_alone();

}  // namespace railstrata
