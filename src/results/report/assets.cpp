#include "report/assets.hpp"

#include "core/embedded_file.hpp"

// RAILSTRATA_WEB_FOLDER and RAILSTRATA_VIEW_FILE come from CMake.
#define RAILSTRATA_ASSET(name, file) RAILSTRATA_EMBED(railstrata_##name, RAILSTRATA_WEB_FOLDER "/" file)

RAILSTRATA_ASSET(script, "report.js")
RAILSTRATA_ASSET(style, "report.css")
RAILSTRATA_EMBED(railstrata_view, RAILSTRATA_VIEW_FILE)

namespace railstrata {

std::string_view report_script() { return {railstrata_script_begin, railstrata_script_end}; }
std::string_view report_style() { return {railstrata_style_begin, railstrata_style_end}; }
std::string_view view_script() { return {railstrata_view_begin, railstrata_view_end}; }

}  // namespace railstrata
