#pragma once
// The cases of a study for those who distribute them: batch systems, parallel, people.
#include <filesystem>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "batch/batch_script.hpp"
#include "study/study_results.hpp"

namespace railstrata {

struct StudyOptions {
  int jobs = 0;                     ///< --jobs; 0: as many as threads
  std::string shard = "1/1";        ///< --shard
  std::string engine;               ///< --engine; empty: all
  std::vector<std::string> groups;  ///< --group; empty: all
  bool dry_run = false;             ///< --dry-run
  std::string lease = "5 min";      ///< --lease: a time
  bool list = false;                ///< --list
  std::string batch;                ///< --batch: the word of a batch system
  int only = 0;                     ///< --only: from 1; 0: all
  bool wait = true;                 ///< --no-wait: for cases that others compute
};

/// A case with its place in the list of all, from 1.
struct ListedCase {
  int index = 0;
  const StudyCase* study_case = nullptr;
  std::string state;
  CaseNeed need;  ///< of one that is to do
};

/// These cases with what those to do are estimated to need: seconds for each by finite elements, since it is meshed
/// and its forces are timed on this machine. cell: of the half-spaces.
std::vector<ListedCase> listed_cases(const std::vector<StudyCase>& cases, const std::vector<CaseRow>& rows,
                                     const std::vector<bool>& ours, const std::string& cell);

/// study: its file. --list: a case a line; with json an array, each of its lines an object.
void print_cases(const std::vector<ListedCase>& cases, const CommandOptions& options,
                 const std::filesystem::path& study, const std::filesystem::path& out);

/// --batch slurm: the script.
void print_batch(const std::vector<ListedCase>& cases, const StudyOptions& own, const CommandOptions& options,
                 const std::filesystem::path& study, const std::filesystem::path& out);

}  // namespace railstrata
