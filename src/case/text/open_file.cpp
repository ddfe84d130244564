#include "text/open_file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace railstrata {

OpenFile::OpenFile(const std::filesystem::path& file) : descriptor_(::open(file.c_str(), O_RDONLY | O_NONBLOCK)) {}

OpenFile::~OpenFile() {
  if (is_open()) ::close(descriptor_);
}

std::ptrdiff_t OpenFile::read(char* into, std::size_t most) const { return ::read(descriptor_, into, most); }

bool OpenFile::wait(int milliseconds) const {
  pollfd one{descriptor_, POLLIN, 0};
  return ::poll(&one, 1, milliseconds) > 0;
}

}  // namespace railstrata
