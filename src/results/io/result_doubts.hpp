#pragma once
// Reasons to doubt a result folder although its files can be read.
#include <string>
#include <vector>

#include "io/result_folder.hpp"

namespace railstrata {

/// name: "case_edited", "other_version" or "summary_contradicted"; `grave`: the page must not call such a result sound.
struct ResultDoubt {
  std::string name, text;
  bool grave = false;
};

/// By provenance.json: another version of the program wrote the result; case.toml is not the one of the run (its
/// SHA-256 differs); summary.json marks a check as holding whose value is beyond its limit, or has other largest
/// tractions or another normal force than patch.csv. Folders from before 0.2.0 do not have that hash and are not asked
/// for it. A position_<mm> folder has both files in the folder it stands in.
std::vector<ResultDoubt> result_doubts(const ResultFolder& result);

}  // namespace railstrata
