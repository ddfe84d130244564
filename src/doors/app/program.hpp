#pragma once
// The command line: words to commands, faults to exit codes (docs/conventions.md).

namespace railstrata {

int run_program(int argc, const char* const* argv);

/// Standard streams and signals, as this program expects them; on Windows the console too.
void settle_in();

}  // namespace railstrata
