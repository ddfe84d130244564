#include "app/stop_flag.hpp"

#include <csignal>

#include <unistd.h>

#include "core/faults.hpp"

namespace railstrata {
namespace {

std::atomic<bool> stop_asked{false}, save_asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "only lock-free atomics may be touched in a signal handler");

void ask_to_stop(int) {
  if (stop_asked.exchange(true)) _exit(static_cast<int>(ExitCode::interrupted));
}

void ask_to_save(int) { save_asked = true; }

}  // namespace

bool take_save_wish() {
  static const bool installed = [] { return std::signal(SIGUSR1, ask_to_save) != SIG_ERR; }();
  static_cast<void>(installed);
  return save_asked.load(std::memory_order_relaxed) && save_asked.exchange(false);
}

std::atomic<bool>& stop_flag() {
  static const bool installed = [] {
    std::signal(SIGINT, ask_to_stop);
    std::signal(SIGTERM, ask_to_stop);
    return true;
  }();
  static_cast<void>(installed);
  return stop_asked;
}

}  // namespace railstrata
