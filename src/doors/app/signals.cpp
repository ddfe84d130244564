#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "app/control.hpp"
#include "core/faults.hpp"
#include "study/running_case.hpp"

namespace railstrata {
namespace {

Control* asked_by_signals = nullptr;
bool patient = false;
static_assert(std::atomic<bool>::is_always_lock_free, "only lock-free atomics may be touched in a signal handler");

void ask_to_stop(int) {
  if (asked_by_signals->stop.exchange(true) && !patient) _exit(static_cast<int>(ExitCode::interrupted));
}

/// Batch systems and limits of processor time repeat their signals.
void ask_to_end(int) { asked_by_signals->stop = true; }

void ask_to_save(int) { asked_by_signals->save = true; }

}  // namespace

void handle_signals(Control& asked) {
  asked_by_signals = &asked;
  patient = std::getenv(kIgnoreSecondSignal) != nullptr;
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
  if (std::signal(SIGHUP, ask_to_stop) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup: it outlives its terminal
  std::signal(SIGUSR1, ask_to_save);
  for (const int ending : {SIGUSR2, SIGXCPU}) std::signal(ending, ask_to_end);
}

}  // namespace railstrata
