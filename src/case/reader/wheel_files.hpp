#pragma once
// Measured wheels of a load: a profile, a folder of profiles, or a list of profiles with their shares.
//
//   file; share [%]          a list: files relative to its own folder; without the second column shares are equal
//   wheel_01.csv; 40
//   wheel_02.csv; 60
//
// A folder's list is the file in it with a column `file`; without one its files ending in .csv, .txt, .dat, .prw and
// .whl count, each the same.
#include <filesystem>
#include <string>
#include <vector>

namespace railstrata {

struct WheelShare {
  std::filesystem::path file;
  double share = 1;  ///< of the passages; all of a load add up to 1
};

/// Whether a text is such a list: its line of names has a column `file`.
bool lists_wheels(const std::string& text);

/// The wheels of a folder or of a list. Throws CaseError with file, line and remedy.
std::vector<WheelShare> measured_wheels(const std::filesystem::path& folder_or_list);

}  // namespace railstrata
