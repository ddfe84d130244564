#pragma once
// Large pages of memory.
#include <cstddef>

namespace railstrata {

/// Bytes.
inline constexpr std::size_t kHugePage = std::size_t{2} << 20;

/// Tells the system that large pages would serve: a sweep over the lines of a body meets a new page with nearly every
/// one. Only a wish.
void prefer_huge_pages(void* begin, std::size_t bytes);

}  // namespace railstrata
