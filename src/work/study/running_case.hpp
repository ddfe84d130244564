#pragma once
// A case of a study on its way: a process for finite elements, a thread of this one for half-spaces. What ends a case
// that way ends no other: a process may crash, and what a thread throws is caught.
#include <filesystem>
#include <memory>
#include <optional>
#include <semaphore>
#include <string>
#include <vector>

#include "ask/answer.hpp"
#include "bem/influence_operator.hpp"
#include "study/study_plan.hpp"

namespace railstrata {

class RunningCase {
 public:
  /// Kills it at once; unsaved work is lost.
  virtual ~RunningCase() = default;
  /// Once it has ended: why it has no result, empty if it has one.
  virtual std::optional<std::string> ended() = 0;
  /// Asks for an orderly stop: with a checkpoint, where it can have one.
  virtual void ask_to_stop() = 0;
  /// A checkpoint on its way, where it can have one.
  virtual void ask_to_save() {}
  /// Progress from 0 to 1.
  virtual double fraction() const = 0;
};

/// Settings common to the cases of one call.
struct CaseSettings {
  std::string cell;  ///< of the half-space engine; empty: its default
  int threads = 1;   ///< of each
  InfluenceCache* cache = nullptr;
  std::counting_semaphore<>* wake = nullptr;  ///< released when a thread has ended
  LifeOfFolder life_of = nullptr;             ///< as of StudyRun
};

/// The variable of the environment by which a program that study starts knows that a second signal is not to end it.
inline constexpr const char* kIgnoreSecondSignal = "RAILSTRATA_ONE_SIGNAL";

/// Sets kIgnoreSecondSignal for all programs started from now on. A terminal's Ctrl-C and a batch system's SIGTERM
/// reach them beside the signal that this program sends: two signals within one step would end them without a
/// checkpoint. This program kills those that take too long.
void ignore_second_signal_in_children();

/// The command line that computes a case into a folder.
std::vector<std::string> case_command(const StudyCase& c, const CaseSettings& settings,
                                      const std::filesystem::path& folder);

/// `begun`: goes on from the checkpoint in the folder. To be called from the main thread. Throws EnvironmentError.
std::unique_ptr<RunningCase> start_process(const StudyCase& c, const CaseSettings& settings,
                                           const std::filesystem::path& folder, bool begun);
std::unique_ptr<RunningCase> start_thread(const StudyCase& c, const CaseSettings& settings,
                                          const std::filesystem::path& folder);

}  // namespace railstrata
