#pragma once
// Kind of a folder without a finished result, for the message of a command that reads results.
#include <filesystem>
#include <string>
#include <vector>

#include "core/faults.hpp"

namespace railstrata {

/// Names what the folder is (not there, an unfinished run, a study, a sweep, a creep curve, a collective, a comparison,
/// a folder of results) and which command goes with it.
Diagnostic no_result_here(const std::filesystem::path& folder);

/// The words of the command line in provenance.json; none if it has none.
std::vector<std::string> command_line_of(const std::filesystem::path& folder);

/// The command line that began a folder, with --force, for the user to repeat; "railstrata run CASE --out FOLDER
/// --force" where provenance.json does not give it.
std::string command_again(const std::filesystem::path& folder);

}  // namespace railstrata
