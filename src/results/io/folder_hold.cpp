#include "io/folder_hold.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "core/faults.hpp"

namespace railstrata {

FolderHold::FolderHold(const std::filesystem::path& folder, bool shared) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  lock_ = descriptor;
  if (descriptor < 0 || ::flock(descriptor, (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0 || errno != EWOULDBLOCK)
    return;
  ::close(descriptor);
  throw CaseError(fmt::format("another railstrata is writing into {}", folder.string()),
                  "wait until it has ended, or choose another folder with --out");
}

FolderHold::~FolderHold() {
  if (lock_ >= 0) ::close(static_cast<int>(lock_));
}

FolderHold::FolderHold(FolderHold&& other) noexcept : lock_(std::exchange(other.lock_, -1)) {}

}  // namespace railstrata
