#pragma once
// The case that a command line names, and the folder where its results go.
#include <filesystem>
#include <string>

#include "app/commands.hpp"
#include "case/case_file.hpp"

namespace railstrata {

/// The case with the overrides applied; its notes are logged.
LoadedCase load_case_of(const CommandOptions& options);

/// Throws CaseError with what the finite element engine refuses of the case.
void require_finite_elements(const LoadedCase& loaded);

/// --out, or results/<case name><suffix>.
std::filesystem::path output_folder_of(const CommandOptions& options, const LoadedCase& loaded,
                                       const std::string& suffix = {});

}  // namespace railstrata
