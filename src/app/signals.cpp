#include "app/signals.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "core/faults.hpp"
#include "study/child_process.hpp"

namespace railstrata {
namespace {

std::atomic<bool> stop_asked{false}, save_asked{false};
bool patient = false;
static_assert(std::atomic<bool>::is_always_lock_free, "only lock-free atomics may be touched in a signal handler");

void ask_to_stop(int) {
  if (stop_asked.exchange(true) && !patient) _exit(static_cast<int>(ExitCode::interrupted));
}

void ask_to_save(int) { save_asked = true; }

}  // namespace

std::atomic<bool>& save_flag() { return save_asked; }

std::atomic<bool>& stop_flag() {
  static const bool installed = [] {
    patient = std::getenv(kIgnoreSecondSignal) != nullptr;
    std::signal(SIGINT, ask_to_stop);
    std::signal(SIGTERM, ask_to_stop);
    if (std::signal(SIGHUP, ask_to_stop) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup: it outlives its terminal
    std::signal(SIGUSR1, ask_to_save);
    return true;
  }();
  static_cast<void>(installed);
  return stop_asked;
}

}  // namespace railstrata
