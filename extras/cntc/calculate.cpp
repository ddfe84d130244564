#include "cntc/calculate.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "cntc/blocks.hpp"
#include "cntc/calls.hpp"
#include "cntc/discretise.hpp"
#include "cntc/drive.hpp"

namespace railstrata::cntc {
namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Adds what passes while it lives to the times of a problem.
class Clock {
 public:
  explicit Clock(Problem& problem) : problem_(problem) {}
  ~Clock() {
    problem_.cpu_s += cpu_seconds() - cpu_;
    problem_.wall_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
  }
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;

 private:
  Problem& problem_;
  double cpu_ = cpu_seconds();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

/// Threads inside of one problem, flag 2003, for the calling thread alone and until the solution is there.
class Threads {
 public:
  explicit Threads(int wanted) {
    if (wanted != -1) omp_set_num_threads(std::max(1, wanted));
  }
  ~Threads() { omp_set_num_threads(before_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

 private:
  int before_ = omp_get_max_threads();
};

std::unique_lock<std::mutex> alone(Problem& problem) {
  std::unique_lock<std::mutex> lock(problem.busy, std::try_to_lock);
  if (!lock) throw Refused(kOther, "another thread is at work on this problem");
  return lock;
}

/// Throws the refusal of a setting that was refused and has not been set again.
void require_all_taken(Problem& problem) {
  int code = 0;
  std::string text;
  for (const auto& [key, refusal] : problem.refused) {
    if (key == static_cast<int>(Setting::blocks)) continue;  // those are of subs_calculate
    if (code == 0) code = refusal.code;
    text += (text.empty() ? "" : "; ") + refusal.text;
  }
  if (code == 0) return;
  problem.solved.reset();
  problem.broken = true;
  throw Refused(code, text);
}

class Patches : public PatchProblems {
 public:
  explicit Patches(int ire) : ire_(ire) {}
  Problem& patch(int number) override { return registry().problem(ire_, number); }

 private:
  int ire_;
};

/// Of module 1: all patches. The elements at their borders.
int solve_patches(int ire, ModuleOne& wheel, Problem& base) {
  constexpr const char* kCall = "cntc_calculate";
  ++base.cases;
  require_all_taken(base);
  registry().clear_message(base);
  std::vector<std::string> remarks;
  Patches patches(ire);
  solve_wheel(wheel, base, patches, remarks);
  int at_border = 0;
  for (int k = 1; k <= static_cast<int>(wheel.found.patches.size()); ++k)
    at_border += patches.patch(k).solved->border_cells;
  for (const std::string& remark : remarks) registry().report(ire, -1, &base, kCall, 0, remark);
  return at_border;
}

void solve_case(int ire, int icp, Problem& problem) {
  constexpr const char* kCall = "cntc_calculate";
  ++problem.cases;
  for (Block& block : problem.blocks) block.table.clear();
  require_all_taken(problem);
  if (flag(problem.settings, kReturn) >= 2) {
    discretise(problem.settings);
    registry().report(ire, icp, &problem, kCall, 0, "R = 2, 3: the settings were looked at, nothing was solved");
    return;
  }
  registry().clear_message(problem);
  std::vector<std::string> remarks;
  solve(problem, remarks);
  if (problem.solved->border_cells > 0)
    remarks.push_back(
        fmt::format("{} elements at the border of the potential contact area are in contact: it is too "
                    "small",
                    problem.solved->border_cells));
  for (const std::string& remark : remarks) registry().report(ire, icp, &problem, kCall, 0, remark);
}

}  // namespace

int calculate(int ire, int icp) noexcept {
  int at_border = 0;
  const int code = with_problem(ire, icp, "cntc_calculate", [&](Problem& problem) {
    const std::unique_lock<std::mutex> lock = alone(problem);
    const Clock clock(problem);
    const Threads threads(registry().threads);
    if (ModuleOne* wheel = registry().find_wheel(ire)) {
      at_border = solve_patches(ire, *wheel, problem);
      return;
    }
    solve_case(ire, icp, problem);
    at_border = problem.solved ? problem.solved->border_cells : 0;
  });
  return code < 0 ? code : at_border;
}

int calculate_blocks(int ire, int icp) noexcept {
  return with_problem(ire, icp, "subs_calculate", [&](Problem& problem) {
    const std::unique_lock<std::mutex> lock = alone(problem);
    const Clock clock(problem);
    const Threads threads(registry().threads);
    const auto refused = problem.refused.find(static_cast<int>(Setting::blocks));
    if (refused != problem.refused.end()) throw Refused(refused->second.code, refused->second.text);
    const ModuleOne* wheel = icp < 1 ? registry().find_wheel(ire) : nullptr;
    if (!wheel) return solve_blocks(problem);
    Patches patches(ire);
    for (int k = 1; k <= static_cast<int>(wheel->found.patches.size()); ++k) {
      Problem& patch = patches.patch(k);
      patch.blocks = problem.blocks;
      solve_blocks(patch);
    }
  });
}

}  // namespace railstrata::cntc
