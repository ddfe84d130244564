#include "report/assets.hpp"

#include "core/embedded_file.hpp"

// RAILSTRATA_REPORT_FOLDER comes from CMake.
#define RAILSTRATA_ASSET(name, file) RAILSTRATA_EMBED(railstrata_##name, RAILSTRATA_REPORT_FOLDER "/" file)

RAILSTRATA_ASSET(script, "dist/report.js")
RAILSTRATA_ASSET(style, "dist/report.css")
RAILSTRATA_ASSET(licences, "dist/LICENSES.txt")
RAILSTRATA_ASSET(view, "view.py")

namespace railstrata {

std::string_view report_script() { return {railstrata_script_begin, railstrata_script_end}; }
std::string_view report_style() { return {railstrata_style_begin, railstrata_style_end}; }
std::string_view report_licences() { return {railstrata_licences_begin, railstrata_licences_end}; }
std::string_view view_script() { return {railstrata_view_begin, railstrata_view_end}; }

}  // namespace railstrata
