#pragma once
// What people look for in a case and do not find: curves, yaw, an axle load, a prescribed creepage.
#include <string_view>

namespace railstrata {

/// How to do without the key or table of this name ("axle_load", "track"), a sentence without its full stop; empty for
/// any other name.
std::string_view answer_for_absent(std::string_view name);

}  // namespace railstrata
