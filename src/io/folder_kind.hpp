#pragma once
// What a folder without a finished result holds, for people who gave it to a command that reads results.
#include <filesystem>

#include "core/faults.hpp"

namespace railstrata {

/// Says what the folder is (not there, an unfinished run, a study, a sweep, a creep curve, a comparison, a folder of
/// results) and which command goes with it.
Diagnostic no_result_here(const std::filesystem::path& folder);

}  // namespace railstrata
