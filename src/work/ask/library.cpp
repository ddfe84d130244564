#include "ask/library.hpp"

#include "ask/answer.hpp"
#include "model/model.hpp"

namespace railstrata {
CaseResult solve_by_half_spaces(const LoadedCase& loaded, const HalfSpaceSettings& settings) {
  AskOptions how{.threads = settings.threads};
  how.bem.cell = settings.cell;
  Placement placement = place(loaded.spec, loaded.folder());
  Answer answer = ask(loaded.spec, placement, {.other_fits = true}, how);
  std::vector<std::string> notes = std::move(placement.doubts);
  notes.insert(notes.end(), placement.notes.begin(), placement.notes.end());
  notes.insert(notes.end(), answer.result.notes.begin(), answer.result.notes.end());
  return {std::move(answer.summary), std::move(answer.result.field), std::move(notes)};
}

}  // namespace railstrata
