#pragma once
// Signals of a run. The first SIGINT (Ctrl-C), SIGTERM or SIGHUP (the terminal is gone; not under nohup) asks it to end
// in good order, the second ends the program at once; SIGUSR1 asks for a checkpoint.
#include <atomic>

namespace railstrata {

/// Installs the handlers on the first call. Set when a signal came; a run looks at it between steps.
std::atomic<bool>& stop_flag();

/// True once after every SIGUSR1 since the first call of stop_flag().
bool take_save_wish();

/// For the programs that this one starts from now on no second signal is the end: a terminal's Ctrl-C and a batch
/// system's SIGTERM reach them beside their parent's own, and who asks for an end twice within a step would lose their
/// checkpoint. Their parent ends them when its patience does.
void leave_the_end_to_the_parent();

}  // namespace railstrata
