#pragma once
// A result as text for the terminal, the same for both engines.
#include <string>

#include "result/summary.hpp"

namespace railstrata {

/// The summary as lines of text in mm, MPa and kN; numbers that do not apply are left out.
std::string summary_text(const Summary& summary);

/// Text or JSON to standard output. The result is there whether or not it can be shown: a failure to write it shows
/// only in std::ferror(stdout).
void print_summary(const Summary& summary, bool json);

/// Every check of the result holds.
bool all_checks_hold(const Summary& summary);

}  // namespace railstrata
