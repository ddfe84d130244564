#pragma once
// What a program must see to before it begins.

namespace railstrata {

/// Standard streams and signals, as this program expects them; on Windows the console too.
void settle_in();

}  // namespace railstrata
