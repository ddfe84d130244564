#include "device/pages.hpp"

#include <windows.h>

namespace railstrata::device {

std::size_t page_size() {
  SYSTEM_INFO system{};
  ::GetSystemInfo(&system);
  return system.dwPageSize;
}

void* closed_pages(std::size_t bytes) {
  return ::VirtualAlloc(nullptr, bytes, MEM_RESERVE | MEM_COMMIT, PAGE_NOACCESS);
}

void protect_pages(void* first, std::size_t bytes, bool open) {
  DWORD before = 0;
  ::VirtualProtect(first, bytes, open ? PAGE_READWRITE : PAGE_NOACCESS, &before);
}

void release_pages(void* first, std::size_t) { ::VirtualFree(first, 0, MEM_RELEASE); }

}  // namespace railstrata::device
