#pragma once
// The explorer as one HTML file.
#include <filesystem>
#include <string>

#include "reader/case_file.hpp"
#include "report/page.hpp"
#include "report/report.hpp"

namespace railstrata {

/// The page on a case, with sliders at its values: one file without any reference outside it, scripts and styles by
/// their hashes, the engine as WebAssembly. It holds the case as it was read and the files that the case reads, but no
/// folder of this machine. as_given: the case as the command line names it, for commands that the page shows; cell: m,
/// of its half-space grids at rest. Throws CaseError: a history in time, a file of the case that cannot be read.
std::string explorer_page(const LoadedCase& loaded, const std::filesystem::path& as_given, double cell);

/// The same for a frame in a report. What is shown is compared with the report's own numbers and centre line until
/// another state is pinned.
FramedPage what_if_page(const LoadedCase& loaded, const std::filesystem::path& as_given, double cell,
                        const ReportRun& reported);

}  // namespace railstrata
