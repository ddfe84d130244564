#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "ask/answer.hpp"
#include "runs/solve_fem.hpp"
#include "tests/places.hpp"
#include "tests/runs/small_run.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

/// The working folder for as long as it lives: empty at first, removed at the end.
class EmptyWorkingFolder {
 public:
  EmptyWorkingFolder() { fs::current_path(folder_.path()); }
  ~EmptyWorkingFolder() { fs::current_path(before_); }
  EmptyWorkingFolder(const EmptyWorkingFolder&) = delete;
  EmptyWorkingFolder& operator=(const EmptyWorkingFolder&) = delete;
  bool empty() const { return fs::is_empty(folder_.path()); }

 private:
  const fs::path before_ = fs::current_path();
  const TemporaryFolder folder_;
};

bool is_default(int signal) {
  struct sigaction action {};
  sigaction(signal, nullptr, &action);
  return action.sa_handler == SIG_DFL;
}

}  // namespace

// From the text of a case to patch, stresses and summary by both engines, as a program that links the library does.
TEST(NoTraces, SolvingLeavesNoFileNoLineAndNoSignalHandler) {
  const EmptyWorkingFolder folder;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const LoadedCase loaded = run_checks::small_case();
  const RollingSystem system = fem_system(loaded.spec, loaded.folder());
  const FemSolution fem = solve_fem(system);
  const Answer half_space = ask(loaded.spec, place(loaded.spec, loaded.folder()));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(folder.empty());
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) EXPECT_TRUE(is_default(signal)) << signal;
  EXPECT_GT(fem.positions.back().summary.contact.patch.p_max, 0);
  EXPECT_GT(half_space.summary.contact.patch.p_max, 0);
}

}  // namespace railstrata
