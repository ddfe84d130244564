#pragma once
// Files of the folder report/ that the program carries with it.
#include <string_view>

namespace railstrata {

std::string_view report_script();  ///< web/dist/report.js
std::string_view report_style();   ///< web/dist/report.css
std::string_view view_script();    ///< src/results/report/view.py

}  // namespace railstrata
