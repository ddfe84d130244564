#pragma once
// Options of the command line that are texts with units.
#include <string>

namespace railstrata {

/// The cell size of --cell ("0.25 mm"), m; the half-space engine's own default for an empty text. Throws CaseError.
double cell_size(const std::string& text);

/// A length in m. `option` names it in the CaseError of a text that is none.
double length_of(const std::string& option, const std::string& text);

/// "10 min", "90 s", "1.5 h" in s; "0" and "never" are 0. `option` names it in the CaseError of a text that is no time.
double wall_time(const std::string& option, const std::string& text);

}  // namespace railstrata
