#include "text/open_file.hpp"

#include <fcntl.h>
#include <io.h>

namespace railstrata {

OpenFile::OpenFile(const std::filesystem::path& file) : descriptor_(::_wopen(file.c_str(), _O_RDONLY | _O_BINARY)) {}

OpenFile::~OpenFile() {
  if (is_open()) ::_close(descriptor_);
}

std::ptrdiff_t OpenFile::read(char* into, std::size_t most) const {
  return ::_read(descriptor_, into, static_cast<unsigned>(most));
}

bool OpenFile::wait(int) const { return true; }  // no named pipes among the files

}  // namespace railstrata
