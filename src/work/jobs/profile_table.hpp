#pragma once
// A profile that the program has made, as rail_profile and wheel_profile read it.
#include <filesystem>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace railstrata {

/// Two columns, y and z in mm, as profiles are read (geometry/read_profile.hpp).
void write_profile_table(const std::filesystem::path& file, const std::vector<std::string>& origin,
                         const std::vector<Vec2>& points);
std::vector<Vec2> read_profile_table(const std::filesystem::path& file);

}  // namespace railstrata
