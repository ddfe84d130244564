#pragma once
// What a verdict rests on and the case does not give.
#include <string>

#include "reader/case_file.hpp"
#include "rules/clashes.hpp"

namespace railstrata {

/// "assumed, for the case does not give them: friction coefficient 0.5, wheel load 84.95 kN"; empty: it gives all. Of
/// collectives the wear factor too.
std::string assumed_in(const LoadedCase& loaded, const Use& use);

}  // namespace railstrata
