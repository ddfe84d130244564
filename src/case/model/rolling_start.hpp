#pragma once
// How a rolling of finite elements starts, how long its run-up is, whether rail or wheel change on its way, and where
// a way ends.
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

/// m from the start, where a wheel stops: a transient at transient.distance or the last row of its history, finite
/// elements at the last of run.positions; infinite where the case leaves it open.
double end_of_way(const CaseSpec& spec);

}  // namespace railstrata
