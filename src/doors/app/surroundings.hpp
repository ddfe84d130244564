#pragma once
// Set-up of standard streams and signals at the program's start.

namespace railstrata {

/// Standard streams and signals, as this program expects them; on Windows the console too.
void settle_in();

}  // namespace railstrata
