#include "record/disk.hpp"

#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>

namespace railstrata::disk {

int create(const std::filesystem::path& file) {
  return ::_wopen(file.c_str(), _O_WRONLY | _O_CREAT | _O_TRUNC | _O_BINARY | _O_NOINHERIT, _S_IREAD | _S_IWRITE);
}

std::ptrdiff_t write(int descriptor, std::string_view bytes) {
  constexpr std::size_t kMost = std::size_t{1} << 30;
  return ::_write(descriptor, bytes.data(), static_cast<unsigned>(std::min(bytes.size(), kMost)));
}

void cut_back(int descriptor, std::ptrdiff_t bytes) {
  if (const long long end = ::_lseeki64(descriptor, 0, SEEK_CUR); end >= bytes)
    static_cast<void>(::_chsize_s(descriptor, end - bytes) == 0);
}

bool sync(int descriptor) { return ::_commit(descriptor) == 0 || errno == EBADF; }  // EBADF: devices

bool close(int descriptor) { return ::_close(descriptor) == 0; }

void sync_folder_of(const std::filesystem::path&) {}  // NTFS keeps a log of its names

}  // namespace railstrata::disk
