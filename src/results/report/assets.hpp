#pragma once
// Files of the folder report/ that the program carries with it; view.py: the result in ParaView or VTK.
#include <filesystem>
#include <string_view>

namespace railstrata {

std::string_view report_script();  ///< web/dist/report.js
std::string_view report_style();   ///< web/dist/report.css
std::string_view view_script();    ///< src/results/report/view.py

/// Writes view.py into a result folder with its absolute path: the script finds its files beside itself, and by
/// that path where it does not know its own place. `place`, if given: the path that the folder will have in the end.
void write_view_script(const std::filesystem::path& folder, const std::filesystem::path& place = {});

}  // namespace railstrata
