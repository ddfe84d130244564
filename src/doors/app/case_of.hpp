#pragma once
// The case that a command line names, and the folder where its results go.
#include <filesystem>
#include <string>

#include "app/commands.hpp"
#include "jobs/job.hpp"
#include "reader/case_file.hpp"

namespace railstrata {

/// How a command uses a case. contact: elastic, rolling or at rest; steady_rolling: elastic, run.rolling is ignored;
/// yielding: the same over a body that yields.
enum class CaseUse { contact, steady_rolling, yielding };

/// The case with the overrides applied; those of its notes that hold for the use are logged.
LoadedCase load_case_of(const CommandOptions& options, CaseUse use = CaseUse::contact);

/// The same for the half-space engine, which warns that it ignores run.device.
LoadedCase load_half_space_case_of(const CommandOptions& options, CaseUse use = CaseUse::contact);

/// Throws CaseError with what the finite element engine refuses of the case.
void require_finite_elements(const LoadedCase& loaded);

/// --out, or results/<case name><suffix>.
std::filesystem::path output_folder_of(const CommandOptions& options, const LoadedCase& loaded,
                                       const std::string& suffix = {});

/// Folder and options of a job, from the command line.
JobOrder job_order_of(const CommandOptions& options, const LoadedCase& loaded, const std::string& suffix, bool resume);

ExitCode code_of(JobEnd end);

}  // namespace railstrata
