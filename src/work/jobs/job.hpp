#pragma once
// A job: what takes long and lives in a folder. The frame is the same for all: one process holds the folder; a new job
// removes older results of its kind and writes where it comes from and its identity, one that is resumed compares the
// identity and reads its state; then it takes steps until it is finished. The state is saved every so often and when a
// stop is requested. So a job that was stopped or killed and resumed gives the same bits as one in one go.
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/control.hpp"
#include "io/folder_hold.hpp"
#include "reader/case_file.hpp"

namespace railstrata {

/// Where a result comes from, for its provenance.json.
struct RunCommand {
  std::vector<std::string> command_line;
  int threads = 0;
};

/// Settings common to all jobs.
struct JobOrder {
  std::filesystem::path folder;
  bool resume = false;  ///< go on with the job of the folder
  bool force = false;   ///< the folder may hold older results, which are removed
  bool page = true;     ///< report.html at the end
  RunCommand command;
};

/// Names of a kind of job and of the files that identify its folder.
struct JobKind {
  const char* name;       ///< of its results: "passes"
  const char* identity;   ///< file with the identity of the folder's job; null: the state has it
  const char* to_repeat;  ///< what must be given again to resume: "the case and the --set of its beginning"
};

enum class JobEnd { finished, failed_checks, stopped, out_of_time };

class Job {
 public:
  Job(const JobKind& kind, JobOrder order, Control& control);
  virtual ~Job() = default;
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// Carries the job out. `results_are_there` is called between the results and the page. Throws CaseError: a folder in
  /// use or with other files, another job to resume; what the steps throw, with what can be done with the folder.
  JobEnd carry_out(const std::function<void()>& results_are_there = {});

  const std::filesystem::path& folder() const { return order_.folder; }

 protected:
  // Implemented by each kind of job; called in this order, but for save().
  /// Locks the folder, after the checks that may refuse it.
  virtual FolderHold hold();
  /// One line; a job resumes only a state with the same identity.
  virtual std::string identity() const { return {}; }
  /// A new job: removes older results of this kind, writes its origin.
  virtual void begin() = 0;
  /// Reads the state that an earlier call has left.
  virtual void resume() = 0;
  virtual bool finished() const = 0;
  /// False: abandoned because a stop was requested; work since the last save may be lost.
  virtual bool step() = 0;
  /// The state as it is after the last step: whole or not there.
  virtual void save() {}
  /// The results.
  virtual void finish() = 0;
  /// Their page. False: a check of it fails.
  virtual bool write_page() { return true; }
  /// Called instead of finish() after a stop: saves what is done.
  virtual void stop() { save(); }
  /// True: stopped by itself, at a limit of time.
  virtual bool out_of_time() const { return false; }

  // For "stopped after pass 3; go on with --resume"; where nothing is to be added, to_resume() is empty.
  virtual std::string how_far() const { return {}; }
  virtual std::string to_resume() const { return " --resume"; }
  /// The folder has a state to resume from.
  virtual bool has_state() const { return true; }

  /// For steps that take long: saves if the last save was more than 20 s ago or a save is requested.
  void save_when_due();

  const JobOrder order_;
  Control& control_;
  bool sound_ = true;  ///< no check of the results has failed

 private:
  void require_identity() const;
  JobEnd work(const std::function<void()>& results_are_there);
  JobKind kind_;
  std::chrono::steady_clock::time_point saved_;
};

/// A job on one case.
class CaseJob : public Job {
 public:
  CaseJob(const JobKind& kind, LoadedCase loaded, JobOrder order, Control& control);

 protected:
  FolderHold hold() override;
  std::string identity() const override;
  /// Removes files of these names, and writes case and provenance.
  void begin() override;
  virtual std::vector<std::string> older_results() const { return {}; }
  /// The "#" lines of its tables.
  std::vector<std::string> origin() const;

  LoadedCase loaded_;
};

}  // namespace railstrata
