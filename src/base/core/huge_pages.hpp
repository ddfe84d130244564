#pragma once
// Large pages of memory.
#include <cstddef>

namespace railstrata {

/// Bytes.
inline constexpr std::size_t kHugePage = std::size_t{2} << 20;

/// Asks the system for large pages: a sweep over the lines of a body reaches a new page with nearly every one. The
/// system may ignore it.
void prefer_huge_pages(void* begin, std::size_t bytes);

}  // namespace railstrata
