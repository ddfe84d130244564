#include "runs/library.hpp"

#include <fmt/format.h>

#include "bem/solve_bem.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "io/provenance.hpp"
#include "model/model.hpp"
#include "post/bem_summary.hpp"
#include "runs/run_bem.hpp"

namespace railstrata {
namespace {

constexpr double kSmallestCell = 0.02e-3, kLargestCell = 5e-3;  // m

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
  const CaseSpec spec = half_space_case(loaded.spec);
  BemOptions options;
  options.cell = settings.cell;
  BemResult result = solve_bem(spec, place(spec, loaded.folder()), options);
  CaseResult out;
  out.summary = bem_summary(spec, result);
  out.summary.run.commit = build_info().commit + (build_info().dirty ? "+dirty" : "");
  out.summary.run.threads = max_threads();
  out.patch = std::move(result.field);
  out.notes = std::move(result.notes);
  return out;
}

}  // namespace railstrata
