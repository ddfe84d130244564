#pragma once
// Lives of a rail from what its traffic has done to it.
#include <string>
#include <vector>

#include "clock/clock_state.hpp"

namespace railstrata {

/// Of all zones by all mechanisms; infinite where nothing has failed yet.
std::vector<LifeRow> clock_lives(const CaseSpec& spec, const ClockState& at, const Profile& unworn);

/// A note with the ductility that gives first cracks at spec.life.first_cracks; empty without that key.
std::string fitted_ductility(const CaseSpec& spec, const std::vector<ClockMoment>& history);

/// A note where one kind of wheels in one place has worn a groove so deep [m]; NaN: there are several.
std::string one_track(double groove);

/// A note where the rate of strain falls by less than the root of the traffic in the second half of it; else empty.
std::string ratchets_on(const std::vector<ClockMoment>& history);

/// A note where single steps of wear end the first stretches and damage has gathered by then; else empty.
/// max_wear: m, of such a step.
std::string unresolved_days(const std::vector<ClockMoment>& history, const std::vector<LifeRow>& lives,
                            double max_wear);

/// A note where the first failure comes before the largest pressure has fallen to near that of the end; else empty.
std::string wearing_in(const std::vector<ClockMoment>& history, const std::vector<LifeRow>& lives);

}  // namespace railstrata
