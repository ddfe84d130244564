#pragma once
// What `check` reports about a profile file alone.
#include <filesystem>
#include <string>

#include "app/commands.hpp"

namespace railstrata {

/// Whether a path ends as profile files do: .csv, .txt, .dat, .prr, .prw, .ban, .whl.
bool names_profile_file(const std::filesystem::path& file);

/// Prints what was read: points, digits, scatter, origin, side, inclination, radii, with the reader's notes. `kind`:
/// "rail", "wheel", or empty: by the ending, else by the shape. With --out: profile.svg, and the points as .csv and as
/// files of Simpack and MiniProf. Throws CaseError.
ExitCode check_profile(const CommandOptions& options, const std::string& kind);

}  // namespace railstrata
