#pragma once
// Pages of memory that can be closed.
#include <cstddef>

namespace railstrata::device {

/// Bytes.
std::size_t page_size();
/// New pages that nobody may touch; null if there is no memory.
void* closed_pages(std::size_t bytes);
void protect_pages(void* first, std::size_t bytes, bool open);
void release_pages(void* first, std::size_t bytes);

}  // namespace railstrata::device
