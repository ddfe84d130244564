#pragma once
// The program's own control (core/control.hpp): reports go to the log, progress to a bar, and signals ask.
#include "core/control.hpp"

namespace railstrata {

/// Signals do as always.
Control& control();

/// From here on the first SIGINT (Ctrl-C), SIGTERM or SIGHUP (the terminal is gone; not under nohup) asks to stop, the
/// second ends the program at once; SIGUSR1 asks for a checkpoint. In a case of a study (study/running_case.hpp) no
/// second signal is the end.
Control& control_by_signals();

/// Installs the handlers, once: they set the flags of `asked`.
void handle_signals(Control& asked);

}  // namespace railstrata
