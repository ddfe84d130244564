#pragma once
// `creep --usetab`: the table as a file.
#include "app/commands.hpp"

namespace railstrata {

/// Solves all ellipses on so many cells along either axis and writes `tabcon` into the output folder.
ExitCode write_usetab(int cells, const CommandOptions& options);

}  // namespace railstrata
