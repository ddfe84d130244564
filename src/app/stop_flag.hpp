#pragma once
// Signals of a run. The first SIGINT (Ctrl-C) or SIGTERM asks it to end in good order, the second ends the program at once; SIGUSR1 asks for a checkpoint.
#include <atomic>

namespace railstrata {

/// Installs the handlers on the first call. Set when a signal came; a run looks at it between steps.
std::atomic<bool>& stop_flag();

/// Installs the handler on the first call. True once after every SIGUSR1.
bool take_save_wish();

}  // namespace railstrata
