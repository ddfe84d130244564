#pragma once
// Profiles from files: Simpack, MiniProf, lists of points.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/profile.hpp"

namespace railstrata {

/// How the points of a file lie: y is turned round, then moved.
struct ProfileFrame {
  bool mirror = false;
  double offset = 0;  ///< m
};

/// Reads a Simpack file (.prr, .prw), a MiniProf file (.ban, .whl) or a two-column file (any other name: y z; blanks,
/// tabs, commas or semicolons; # % ! " comments; a header row; decimal commas; mm, metres or inches; z up or down;
/// either side's orientation). What was detected and flipped is appended to `notes`, one sentence each, with the knots
/// of the smoothing and what it moved. Throws CaseError naming the file and line.
Profile read_profile(ProfileKind kind, const std::filesystem::path& file, std::vector<std::string>* notes = nullptr,
                     const ProfileFrame& frame = {});

/// The same from a text; `file` names it in messages.
Profile parse_profile(ProfileKind kind, std::string_view text, const std::filesystem::path& file,
                      std::vector<std::string>* notes = nullptr, const ProfileFrame& frame = {});

/// The same from points along the curve, as a two-column file lists them.
Profile profile_of_points(ProfileKind kind, std::vector<Vec2> points, const std::string& name,
                          std::vector<std::string>* notes = nullptr);

}  // namespace railstrata
