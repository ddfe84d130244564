// Study files. Base cases are looked for beside the study: case.toml of cases/quick.
#include "study/study_file.hpp"

#include <cmath>

#include "reader.hpp"
#include "reader/case_file.hpp"
#include "text/units.hpp"

using namespace railstrata;
using fuzz::promise;

namespace {

void check(const LoadedStudy& loaded) {
  promise(!loaded.spec.groups.empty(), "a study has cases");
  if (!loaded.spec.cell.empty()) {
    const double cell = parse_quantity(loaded.spec.cell, dimension::kLength);
    promise(std::isfinite(cell) && cell > 0, "the cell is a length");
  }
  for (const StudyGroup& g : loaded.spec.groups) {
    promise(!g.name.empty() && g.name[0] != '.' && g.name.find('/') == std::string::npos,
            "a group's name is a folder below the study's");
    promise(std::filesystem::is_regular_file(g.base), "a group's base case is a file");
    promise(!g.points.empty() && !g.engines.empty(), "a group has cases and engines");
    std::vector<std::string> overrides;
    for (const StudyPoint* part : {&g.set, &g.points.front()})
      for (const StudyValue& v : *part) overrides.push_back(v.key + "=" + v.toml);
    fuzz::accepts([&] { parse_case("", "case.toml", overrides); });
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  LoadedStudy loaded;
  if (fuzz::accepts([&] {
        loaded = parse_study(std::string(fuzz::text_of(data, size)), RAILSTRATA_SOURCE_DIR "/cases/quick/study.toml");
      }))
    check(loaded);
  return 0;
}
