#include "cntc/message_file.hpp"

#include <utility>

namespace railstrata::cntc {

MessageFile::~MessageFile() { close(); }

void MessageFile::set(std::string path, To to) {
  close();
  const std::lock_guard lock(mutex_);
  path_ = std::move(path);
  to_ = to;
  tried_ = false;
}

void MessageFile::close() {
  const std::lock_guard lock(mutex_);
  if (file_) std::fclose(file_);
  file_ = nullptr;
}

void MessageFile::write(std::string_view line) {
  const std::lock_guard lock(mutex_);
  if (to_ == To::nowhere) return;
  const auto length = static_cast<int>(line.size());
  if (to_ == To::file_and_screen) std::printf("%.*s\n", length, line.data());
  if (!tried_) {
    file_ = std::fopen(path_.c_str(), "w");
    if (file_) std::fputs("RailStrata behind CONTACT's library interface, module 3\n\n", file_);
    tried_ = true;
  }
  if (!file_) return;
  std::fprintf(file_, "%.*s\n", length, line.data());
  std::fflush(file_);
}

}  // namespace railstrata::cntc
