#pragma once
// Pages that a command writes after its results: where they are, or why there is none.
#include <filesystem>
#include <functional>

#include "runs/write_report.hpp"

namespace railstrata {

/// write(), which makes `page`, and logs its verdict and where it is. Failing, it warns: the results are there without
/// a page. Returns whether the page's verdict holds, true without a page: the exit code says what the page says.
bool write_page_or_warn(const std::filesystem::path& page, const std::function<WrittenPage()>& write);

/// Logs what a written page has to say: its notes and its verdict, a failed one as a warning.
void log_page(const WrittenPage& page);

/// What `run` and `bem` do when they are done: report.html in the folder, or a warning. Returns whether
/// its verdict holds, true without a page.
bool add_report(const std::filesystem::path& folder);

}  // namespace railstrata
