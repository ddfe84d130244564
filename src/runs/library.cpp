#include "runs/library.hpp"

#include <fmt/format.h>

#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "model/model.hpp"
#include "runs/solve_half_space.hpp"

namespace railstrata {
namespace {

// The number of threads of the calling thread, for as long as this lives.
class Threads {
 public:
  explicit Threads(int wanted) : before_(max_threads()) {
    if (wanted > 0) set_threads(wanted);
  }
  ~Threads() { set_threads(before_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

 private:
  int before_;
};

}  // namespace

CaseResult solve_by_half_spaces(const LoadedCase& loaded, const HalfSpaceSettings& settings) {
  if (!(settings.cell >= kSmallestCell && settings.cell <= kLargestCell))
    throw CaseError(fmt::format("a cell of {} m is out of range", settings.cell),
                    "give a length from 0.02e-3 to 5e-3 m");
  if (settings.threads < 0)
    throw CaseError(fmt::format("{} threads are fewer than none", settings.threads), "give 0 for OpenMP's own number");
  const Threads threads(settings.threads);
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
