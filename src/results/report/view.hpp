#pragma once
// view.py: the result in ParaView or VTK.
#include <filesystem>

namespace railstrata {

/// Writes view.py into a result folder with its absolute path: the script finds its files beside itself, and by
/// that path where it does not know its own place. `place`, if given: the path that the folder will have in the end.
void write_view_script(const std::filesystem::path& folder, const std::filesystem::path& place = {});

}  // namespace railstrata
