#pragma once
// Signals of the program. The first SIGINT (Ctrl-C), SIGTERM or SIGHUP (the terminal is gone; not under nohup) asks it
// to end in good order, the second ends it at once; SIGUSR1 asks for a checkpoint. Rooms below see two flags and no
// signal. In a case of a study (study/child_process.hpp) no second signal is the end.
#include <atomic>

namespace railstrata {

/// Installs the handlers on the first call. Set when a signal came; a run looks at it between steps.
std::atomic<bool>& stop_flag();

/// Set by every SIGUSR1 after the first call of stop_flag(); who makes the checkpoint sets it back.
std::atomic<bool>& save_flag();

}  // namespace railstrata
