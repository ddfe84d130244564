#pragma once
// A file that is read.
#include <cstddef>
#include <filesystem>

namespace railstrata {

/// A file that is open for reading, closed at the end. It does not block: a named pipe without a writer would for ever.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& file);
  ~OpenFile();
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  /// If not, the reason is in errno.
  bool is_open() const { return descriptor_ >= 0; }
  /// Bytes read; 0 at the end, and of a pipe that has no writer; -1: none yet (EAGAIN), or an error.
  std::ptrdiff_t read(char* into, std::size_t most) const;
  /// Whether within this time there is something to read, or the end.
  bool wait(int milliseconds) const;

 private:
  int descriptor_;
};

}  // namespace railstrata
