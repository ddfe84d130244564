#pragma once
// Completion of the command line in bash.
#include <string>
#include <vector>

#include "app/help_texts.hpp"
#include "options/case_schema.hpp"

namespace railstrata {

/// The script that bash reads: commands, options and their words; of --set and --vary the keys of a case step by step,
/// the words of a key, its default, and after a number the units.
std::string bash_completion(const std::vector<CommandHelp>& commands, const std::vector<CaseKey>& keys);

}  // namespace railstrata
