#pragma once
#include <filesystem>

namespace railstrata {

/// Root of the checkout that the tests were built from.
std::filesystem::path source_dir();

/// A new, empty folder in the machine's temporary folder (TMPDIR), removed with all that is in it at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace railstrata
