#include <fmt/format.h>

#include "judge/row_strength.hpp"
#include "study/study_run.hpp"

namespace railstrata {

std::vector<std::string> case_command(const StudyCase& c, const std::string& cell, int threads,
                                      const std::filesystem::path& folder) {
  std::vector<std::string> words{std::string(row_of(c.engine).command), c.loaded.file.string()};
  for (const std::string& o : c.overrides) words.insert(words.end(), {"--set", o});
  if (c.engine == Engine::bem && !cell.empty()) words.insert(words.end(), {"--cell", cell});
  const CaseSpec& spec = c.loaded.spec;
  if (c.engine == Engine::bem && (strength_given(spec, BodyId::rail) || strength_given(spec, BodyId::wheel)))
    words.emplace_back("--no-single-track");  // a third of the time of a case, and the same for hundreds of them
  words.insert(words.end(),
               {"--out", folder.string(), "--force", "--no-report", "--threads", fmt::format("{}", threads)});
  return words;
}

std::vector<std::string> resume_command(int threads, const std::filesystem::path& folder) {
  return {"run", "--resume", folder.string(), "--no-report", "--threads", fmt::format("{}", threads)};
}

}  // namespace railstrata
