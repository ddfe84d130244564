#include "runs/stop_flag.hpp"

#include <csignal>
#include <cstdlib>

#include <unistd.h>

#include "core/faults.hpp"

namespace railstrata {
namespace {

constexpr const char* kPatient = "RAILSTRATA_ONE_SIGNAL";
std::atomic<bool> stop_asked{false}, save_asked{false};
bool patient = false;
static_assert(std::atomic<bool>::is_always_lock_free, "only lock-free atomics may be touched in a signal handler");

void ask_to_stop(int) {
  if (stop_asked.exchange(true) && !patient) _exit(static_cast<int>(ExitCode::interrupted));
}

void ask_to_save(int) { save_asked = true; }

}  // namespace

void leave_the_end_to_the_parent() { setenv(kPatient, "1", 1); }

bool take_save_wish() { return save_asked.load(std::memory_order_relaxed) && save_asked.exchange(false); }

std::atomic<bool>& stop_flag() {
  static const bool installed = [] {
    patient = std::getenv(kPatient) != nullptr;
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
