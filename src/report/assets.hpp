#pragma once
// Files of the folder report/ that the program carries with it.
#include <string_view>

namespace railstrata {

std::string_view report_script();    ///< report/dist/report.js
std::string_view report_style();     ///< report/dist/report.css
std::string_view report_licences();  ///< report/dist/LICENSES.txt: of the software inside report.js
std::string_view view_script();      ///< report/view.py

}  // namespace railstrata
