#pragma once
// How long a rail lasts if all its wheels are the one of a case.
#include <filesystem>

#include "ask/answer.hpp"
#include "core/control.hpp"

namespace railstrata {

/// For AskOptions::life_of: the rail through spec.life.until [kg] of traffic (clock/clock.hpp), the files of the case
/// in `folder`. Gives the reason instead where it cannot be followed. Throws Interrupted.
LifeOf life_of_wheels(std::filesystem::path folder, const Control* control = nullptr);

}  // namespace railstrata
