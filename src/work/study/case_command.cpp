#include <fmt/format.h>

#include "fatigue/row_strength.hpp"
#include "study/running_case.hpp"

namespace railstrata {

std::vector<std::string> case_command(const StudyCase& c, const CaseSettings& settings,
                                      const std::filesystem::path& folder) {
  std::vector<std::string> words{"railstrata", std::string(row_of(c.engine).command), c.loaded.file.string()};
  for (const std::string& o : c.overrides) words.insert(words.end(), {"--set", o});
  if (c.engine != Engine::fem && !settings.cell.empty()) words.insert(words.end(), {"--cell", settings.cell});
  const CaseSpec& spec = c.loaded.spec;
  if (c.engine != Engine::fem && strength_to_judge(spec))
    words.emplace_back("--no-single-track");  // a third of the time of a case, and the same for hundreds of them
  words.insert(words.end(),
               {"--out", folder.string(), "--force", "--no-report", "--threads", fmt::format("{}", settings.threads)});
  return words;
}

}  // namespace railstrata
