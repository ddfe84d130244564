#include "device/pages.hpp"

#include <sys/mman.h>
#include <unistd.h>

namespace railstrata::device {

std::size_t page_size() {
  static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return size;
}

void* closed_pages(std::size_t bytes) {
  void* const first = mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return first == MAP_FAILED ? nullptr : first;
}

void protect_pages(void* first, std::size_t bytes, bool open) {
  mprotect(first, bytes, open ? PROT_READ | PROT_WRITE : PROT_NONE);
}

void release_pages(void* first, std::size_t bytes) { munmap(first, bytes); }

}  // namespace railstrata::device
