#pragma once
// A report as one HTML file.
#include <string>

#include "report/framed_page.hpp"
#include "report/report.hpp"

namespace railstrata {

/// The page: one file without any reference outside it. Scripts and styles run by their hashes alone
/// (Content-Security-Policy).
std::string report_page(const Report& report);
/// The same with another page in a frame that opens on demand ("What if?").
std::string report_page(const Report& report, const FramedPage& what_if);

}  // namespace railstrata
