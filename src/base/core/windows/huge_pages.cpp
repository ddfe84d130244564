#include "core/huge_pages.hpp"

namespace railstrata {

void prefer_huge_pages(void*, std::size_t) {}  // Windows gives them to those with a privilege of their own

}  // namespace railstrata
