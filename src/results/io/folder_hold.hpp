#pragma once
// Lock of a folder: one writer at a time.
#include <cstdint>
#include <filesystem>

namespace railstrata {

/// Holds a folder for as long as it lives, against every other program that would write there: two runs never mix their
/// files. Ends with the process, however that ends; leaves no file. Shared: several that know of each other (the shards
/// of a study) may hold it together. On file systems that cannot lock it holds nothing.
class FolderHold {
 public:
  /// Throws CaseError if the folder is held already.
  explicit FolderHold(const std::filesystem::path& folder, bool shared = false);
  ~FolderHold();
  FolderHold(FolderHold&& other) noexcept;
  FolderHold& operator=(FolderHold&&) = delete;

 private:
  std::intptr_t lock_ = -1;
};

}  // namespace railstrata
