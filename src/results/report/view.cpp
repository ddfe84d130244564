#include "report/view.hpp"

#include <cassert>
#include <nlohmann/json.hpp>
#include <string>

#include "record/json.hpp"
#include "record/output_file.hpp"
#include "report/assets.hpp"

namespace railstrata {

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
