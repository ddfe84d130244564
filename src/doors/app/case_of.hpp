#pragma once
// The case that a command line names, and the folder where its results go.
#include <filesystem>
#include <string>

#include "app/commands.hpp"
#include "jobs/job.hpp"
#include "reader/case_file.hpp"
#include "rules/clashes.hpp"

namespace railstrata {

/// The case with the overrides applied, for a use that supports it; its notes for this use are logged. Throws
/// CaseError.
LoadedCase load_case_of(const CommandOptions& options, const Use& use);

/// One line, before a verdict, of what it rests on and the case does not give.
void report_assumed(const LoadedCase& loaded, const Use& use);

/// --out, or results/<case name><suffix>.
std::filesystem::path output_folder_of(const CommandOptions& options, const LoadedCase& loaded,
                                       const std::string& suffix = {});

/// Options of a job in this folder, from the command line.
JobOrder job_order_of(const CommandOptions& options, const std::filesystem::path& folder, bool resume);

ExitCode code_of(JobEnd end);

}  // namespace railstrata
