#include "io/folder_hold.hpp"

#include <fmt/format.h>
#include <windows.h>

#include <cwctype>
#include <functional>
#include <utility>

#include "core/faults.hpp"

namespace railstrata {
namespace {

/// An object of the kernel, which ends with the last process that has it, stands for the folder: a folder itself cannot
/// be locked.
std::string name_of(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::wstring path = std::filesystem::weakly_canonical(folder, ignored).native();
  for (wchar_t& letter : path) letter = static_cast<wchar_t>(std::towlower(letter));
  return fmt::format("railstrata-{:016x}", std::hash<std::wstring>()(path));
}

bool is_there(const std::string& name) {
  const HANDLE found = ::OpenEventA(SYNCHRONIZE, FALSE, name.c_str());
  if (found != nullptr) ::CloseHandle(found);
  return found != nullptr;
}

}  // namespace

FolderHold::FolderHold(const std::filesystem::path& folder, bool shared) {
  const std::string alone = name_of(folder), together = alone + "-shared";
  const HANDLE own = ::CreateEventA(nullptr, TRUE, FALSE, (shared ? together : alone).c_str());
  if (own == nullptr) return;
  const bool again = ::GetLastError() == ERROR_ALREADY_EXISTS;
  if (shared ? !is_there(alone) : !again && !is_there(together)) {
    lock_ = reinterpret_cast<std::intptr_t>(own);
    return;
  }
  ::CloseHandle(own);
  throw CaseError(fmt::format("another railstrata is writing into {}", folder.string()),
                  "wait until it has ended, or choose another folder with --out");
}

FolderHold::~FolderHold() {
  if (lock_ != -1) ::CloseHandle(reinterpret_cast<HANDLE>(lock_));
}

FolderHold::FolderHold(FolderHold&& other) noexcept : lock_(std::exchange(other.lock_, -1)) {}

}  // namespace railstrata
