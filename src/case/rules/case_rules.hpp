#pragma once
// Rules between the options of a case.
#include <string>
#include <vector>

#include "spec/case_fwd.hpp"
#include "text/case_source.hpp"

namespace railstrata {

/// Records every broken rule in `source`.
void check_case_rules(const CaseSpec& spec, CaseSource& source);

/// Settings that have no effect in this case, one sentence each.
std::vector<std::string> idle_settings(const CaseSpec& spec);

/// The drive that run.rolling = false makes void, for it presses without friction: creepages, lateral forces, a spin, a
/// traction that is not the default's or that an override gives, and those of passes. One sentence each.
std::vector<std::string> void_drive(const CaseSpec& spec, const CaseSource& source);

/// Laws of yielding of a case that is computed elastically (run.plasticity = false), one sentence each.
std::vector<std::string> unread_hardening(const CaseSpec& spec);

}  // namespace railstrata
