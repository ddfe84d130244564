#pragma once
// Ctrl-C: the first SIGINT or SIGTERM asks the run to end in good order, the second ends the program at once.
#include <atomic>

namespace railstrata {

/// Installs the handlers on the first call. Set when a signal came; a run looks at it between steps.
const std::atomic<bool>& stop_flag();

}  // namespace railstrata
