#include "record/disk.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace railstrata::disk {

int create(const std::filesystem::path& file) {
  return ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
}

std::ptrdiff_t write(int descriptor, std::string_view bytes) { return ::write(descriptor, bytes.data(), bytes.size()); }

void cut_back(int descriptor, std::ptrdiff_t bytes) {
  if (const off_t end = ::lseek(descriptor, 0, SEEK_CUR); end >= bytes)
    static_cast<void>(::ftruncate(descriptor, end - bytes) == 0);
}

bool sync(int descriptor) {
  return ::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS;  // EINVAL: pipes and devices
}

bool close(int descriptor) { return ::close(descriptor) == 0; }

void sync_folder_of(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);  // not every file system can; the file itself is safe by now
  ::close(descriptor);
}

}  // namespace railstrata::disk
