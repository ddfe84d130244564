#pragma once
// How a rolling of finite elements starts, how long its run-up is, and whether rail or wheel change on its way.
#include <string>

#include "spec/case_fwd.hpp"

namespace railstrata {

/// The key that makes rail or wheel vary along the way, apart from sleepers; empty: nothing does.
std::string varying_key(const CaseSpec& spec);
/// Whether a wheel rolls over what is not the same everywhere, sleepers too.
bool changes_on_way(const CaseSpec& spec);

/// Why a rolling starts from rest and not with the friction of steady rolling (run.start); empty: it starts steadily.
std::string why_from_rest(const CaseSpec& spec);

/// run.run_up, or what stands for it: from rest 120 mm, from a steady start `patch_length` [m] twice.
double run_up_of(const CaseSpec& spec, double patch_length);

}  // namespace railstrata
