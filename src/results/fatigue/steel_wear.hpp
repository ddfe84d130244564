#pragma once
// How the steel at a running surface wears, over the steel of the tests that the USFD function was fitted to.
#include "result/summary.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// Of the material at the body's surface now, the first layer's where there is one: wear_factor as given, that of its
/// grade, an estimate from its hardness (damage/pearlite_wear.hpp), in this order; 1 where none is known.
SteelWear steel_wear(const CaseSpec& spec, BodyId body);

}  // namespace railstrata
