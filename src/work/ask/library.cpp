#include "ask/library.hpp"

#include <fmt/format.h>

#include "ask/solve_half_space.hpp"
#include "ask/solve_settings.hpp"
#include "core/faults.hpp"
#include "model/model.hpp"

namespace railstrata {
CaseResult solve_by_half_spaces(const LoadedCase& loaded, const HalfSpaceSettings& settings) {
  require_cell(settings.cell);
  if (settings.threads < 0)
    throw CaseError(fmt::format("{} threads are fewer than none", settings.threads), "give 0 for OpenMP's own number");
  const ThreadsOfCaller threads(settings.threads);
  BemOptions options;
  options.cell = settings.cell;
  HalfSpaceSolution solution = solve_half_space(loaded.spec, place(loaded.spec, loaded.folder()), options);
  CaseResult out;
  out.summary = std::move(solution.summary);
  out.patch = std::move(solution.result.field);
  out.notes = std::move(solution.result.notes);
  return out;
}

}  // namespace railstrata
