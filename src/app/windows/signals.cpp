#include "app/signals.hpp"

#include <windows.h>

#include <cstdlib>

#include "core/faults.hpp"
#include "study/child_process.hpp"

namespace railstrata {
namespace {

std::atomic<bool> stop_asked{false}, save_asked{false};
bool patient = false;

/// Ctrl-C and Ctrl-Break, the window that is closed, the user who leaves; in a thread of its own.
BOOL WINAPI ask_to_stop(DWORD event) {
  if (stop_asked.exchange(true) && !patient) std::_Exit(static_cast<int>(ExitCode::interrupted));
  if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) ::Sleep(INFINITE);  // the end of this call ends the program
  return TRUE;
}

}  // namespace

std::atomic<bool>& save_flag() { return save_asked; }

std::atomic<bool>& stop_flag() {
  static const bool installed = [] {
    patient = std::getenv(kIgnoreSecondSignal) != nullptr;
    return ::SetConsoleCtrlHandler(ask_to_stop, TRUE) != 0;
  }();
  static_cast<void>(installed);
  return stop_asked;
}

}  // namespace railstrata
