#include <windows.h>

#include <cstdlib>

#include "app/control.hpp"
#include "core/faults.hpp"

namespace railstrata {
namespace {

Control* asked_by_signals = nullptr;

/// Ctrl-C and Ctrl-Break, the window that is closed, the user who leaves; in a thread of its own.
BOOL WINAPI ask_to_stop(DWORD event) {
  if (asked_by_signals->stop.exchange(true)) std::_Exit(static_cast<int>(ExitCode::interrupted));
  if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) ::Sleep(INFINITE);  // the end of this call ends the program
  return TRUE;
}

}  // namespace

void handle_signals(Control& asked) {
  asked_by_signals = &asked;
  ::SetConsoleCtrlHandler(ask_to_stop, TRUE);
}

}  // namespace railstrata
