#pragma once
// Makes the cases to be computed from a study file.
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reader/case_file.hpp"
#include "study/study_file.hpp"

namespace railstrata {

/// Raised whenever a change of the program alters the numbers of a result: results of an older version are computed
/// anew.
inline constexpr int kResultVersion = 15;

/// A case of a study by one engine.
struct StudyCase {
  std::string group, name;         ///< name: "thickness 0.2 mm, young_ratio 4"
  Engine engine = Engine::fem;     ///< that gives its result
  Engine chosen_as = Engine::fem;  ///< of the file's engines; by the case's own bem.bodies "bem" gives sections too
  std::vector<std::pair<std::string, std::string>> values;  ///< key and text of what is varied, then the group's tags
  std::vector<std::string> overrides;
  LoadedCase loaded;
  std::string key;                   ///< SHA-256 of what decides the result
  std::filesystem::path folder;      ///< of its result, below the study's; shared by cases of the same key
  std::filesystem::path own_folder;  ///< where it would stand if no other case had its key
  bool first = true;                 ///< false: an earlier case of the list has the same key and is computed for both
  std::string label() const { return group + "/" + name + " (" + std::string(engine_title(engine)) + ")"; }
};

/// "thickness" of "layer.0.thickness".
std::string last_part(const std::string& key);

/// Every case of the study, in the order of the file, per group and case the engines. `overrides` hold for all cases.
/// Throws CaseError with every value that a case refuses, at its place in the study file.
std::vector<StudyCase> plan_study(const LoadedStudy& study, const std::vector<std::string>& overrides);

/// "2/8": the cases 2, 10, 18, …
struct Shard {
  int index = 1, count = 1;
};
Shard parse_shard(const std::string& text);

/// Which cases one call of the program computes: those of an engine (none: of all) and of groups (empty for all), of
/// these every shard.count-th. One flag for each case; of several cases with the same key only the one that is computed
/// for all of them can be chosen. Throws CaseError for a group that does not exist.
std::vector<bool> chosen(const LoadedStudy& study, const std::vector<StudyCase>& cases, std::optional<Engine> engine,
                         const std::vector<std::string>& groups, const Shard& shard);

/// The case of this index, from 1, alone: of several with the same key the one that is computed for all of them. Throws
/// CaseError if there is none, or none `among` the chosen ones.
std::vector<bool> only(const std::vector<StudyCase>& cases, int index, const std::vector<bool>& among);

/// Keys that the study varies and an override holds fast: cases that are named after other values have this one.
std::vector<std::string> varied_and_set(const LoadedStudy& study, const std::vector<std::string>& overrides);

}  // namespace railstrata
