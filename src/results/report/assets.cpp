#include "report/assets.hpp"

#include <cassert>
#include <nlohmann/json.hpp>
#include <string>

#include "core/embedded_file.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"

// RAILSTRATA_WEB_FOLDER and RAILSTRATA_VIEW_FILE come from CMake.
#define RAILSTRATA_ASSET(name, file) RAILSTRATA_EMBED(railstrata_##name, RAILSTRATA_WEB_FOLDER "/" file)

RAILSTRATA_ASSET(script, "report.js")
RAILSTRATA_ASSET(style, "report.css")
RAILSTRATA_EMBED(railstrata_view, RAILSTRATA_VIEW_FILE)

namespace railstrata {

std::string_view report_script() { return {railstrata_script_begin, railstrata_script_end}; }
std::string_view report_style() { return {railstrata_style_begin, railstrata_style_end}; }
std::string_view view_script() { return {railstrata_view_begin, railstrata_view_end}; }

void write_view_script(const std::filesystem::path& folder, const std::filesystem::path& place) {
  const std::string blank = "WRITTEN_TO = \"\"";
  std::string script(view_script());
  const auto at = script.find(blank);
  assert(at != std::string::npos);
  script.replace(
      at, blank.size(),
      "WRITTEN_TO = " + json_text(nlohmann::json(
                            std::filesystem::absolute(place.empty() ? folder : place).lexically_normal().string())));
  write_whole_file(folder / "view.py", script);
}

}  // namespace railstrata
