#include "report/view.hpp"

#include <cassert>
#include <nlohmann/json.hpp>
#include <string>

#include "io/output_file.hpp"
#include "report/assets.hpp"

namespace railstrata {

void write_view_script(const std::filesystem::path& folder) {
  const std::string place = "WRITTEN_TO = \"\"";
  std::string script(view_script());
  const auto at = script.find(place);
  assert(at != std::string::npos);
  script.replace(at, place.size(), "WRITTEN_TO = " + nlohmann::json(std::filesystem::absolute(folder).lexically_normal().string()).dump());
  write_whole_file(folder / "view.py", script);
}

}  // namespace railstrata
