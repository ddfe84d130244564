#pragma once
// A report as one HTML file.
#include <string>

#include "report/report.hpp"

namespace railstrata {

/// The page: one file without any reference outside it. Scripts and styles run by their hashes alone
/// (Content-Security-Policy).
std::string report_page(const Report& report);

}  // namespace railstrata
