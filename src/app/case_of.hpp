#pragma once
// The case that a command line names, and the folder where its results go.
#include <filesystem>
#include <string>

#include "app/commands.hpp"
#include "case/case_file.hpp"

namespace railstrata {

/// The case with the overrides applied; its notes are logged.
LoadedCase load_case_of(const CommandOptions& options);

/// The work's result; CaseErrors of it get their places in the case (in_case_file).
template <class Work>
auto with_places(const LoadedCase& loaded, Work&& work) {
  try {
    return work();
  } catch (const CaseError& e) {
    throw in_case_file(loaded, e);
  }
}

/// Throws CaseError with what the finite element engine refuses of the case.
void require_finite_elements(const LoadedCase& loaded);

/// --out, or results/<case name><suffix>.
std::filesystem::path output_folder_of(const CommandOptions& options, const LoadedCase& loaded,
                                       const std::string& suffix = {});

}  // namespace railstrata
