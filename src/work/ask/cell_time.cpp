#include "ask/cell_time.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>

#include "ask/solve_settings.hpp"
#include "bem/case_patch.hpp"
#include "bem/transient.hpp"
#include "core/faults.hpp"

namespace railstrata {
namespace {

constexpr double kTrialCells = 4000;  // of the finer trial, at most
constexpr double kSmallWork = 500;    // cells

/// Cells as small grids would take them: 26, 96 and 230 thousand took 0.6, 3.5 and 12 s.
double like_small(double cells) {
  constexpr double kGrows = 2e4, kBy = 0.4;
  return cells * std::pow(std::max(1.0, cells / kGrows), kBy);
}

}  // namespace

double processor_seconds(const std::function<void()>& call) {
  const ThreadsOfCaller one(1);
  const std::clock_t begin = std::clock();
  call();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double estimated_seconds(const CellWork& work, double cell) {
  const double wanted = work.cells(cell);
  const double fine = cell * std::max(2.0, std::sqrt(wanted / kTrialCells)), coarse = work.apart * fine;
  if (wanted < kSmallWork || coarse > kLargestCell) return work.seconds(cell);
  try {
    const double of_coarse = work.seconds(coarse), of_fine = work.seconds(fine);
    const double cells_of_fine = work.cells(fine);
    const double each = std::max(0.0, of_fine - of_coarse) / (cells_of_fine - work.cells(coarse));
    return of_fine + each * (like_small(wanted) - cells_of_fine);
  } catch (const CaseError&) {
  } catch (const NumericalError&) {
  }
  return work.seconds(cell);
}

double cells_to_solve(const CaseSpec& spec, const Placement& placement, double cell) {
  BemOptions bem;
  bem.cell = cell;
  const double steps = spec.transient.kind == TransientKind::none ? 0 : transient_steps(spec, placement, cell);
  return (1 + steps) * static_cast<double>(first_grid(spec, placement, bem).size());
}

std::vector<std::size_t> sample_of(std::size_t count) {
  const std::size_t wanted = std::min(count, std::clamp<std::size_t>(count / 5, 3, 8));
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < wanted; ++k) out.push_back((2 * k + 1) * count / (2 * wanted));
  if (!out.empty()) out.front() = 0;
  return out;
}

double seconds_of_all(const std::vector<double>& sample, std::size_t count) {
  if (sample.size() < 2) return sample.empty() ? 0 : sample.front() * static_cast<double>(count);
  const double further = std::accumulate(sample.begin() + 1, sample.end(), 0.0);
  return sample.front() + further / static_cast<double>(sample.size() - 1) * static_cast<double>(count - 1);
}

}  // namespace railstrata
