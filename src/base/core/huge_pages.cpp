#include "core/huge_pages.hpp"

#include <sys/mman.h>

namespace railstrata {

void prefer_huge_pages(void* begin, std::size_t bytes) { madvise(begin, bytes, MADV_HUGEPAGE); }

}  // namespace railstrata
