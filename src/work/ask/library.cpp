#include "ask/library.hpp"

#include "ask/answer.hpp"
#include "model/model.hpp"

namespace railstrata {
CaseResult solve_by_half_spaces(const LoadedCase& loaded, const HalfSpaceSettings& settings) {
  AskOptions how{.threads = settings.threads};
  how.bem.cell = settings.cell;
  Answer answer = ask(loaded.spec, place(loaded.spec, loaded.folder()), {}, how);
  return {std::move(answer.summary), std::move(answer.result.field), std::move(answer.result.notes)};
}

}  // namespace railstrata
