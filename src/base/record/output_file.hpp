#pragma once
// Files that are either whole or not there.
#include <filesystem>
#include <string_view>

namespace railstrata {

/// A file open for writing. Every failure (disk full, no permission, quota) throws EnvironmentError naming the file,
/// the system's reason and the remedy.
class OutputFile {
 public:
  /// Creates the file or empties it.
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;

  /// Hands the bytes to the system; a reader sees them at once. On failure none of them are in the file.
  void write(std::string_view bytes);
  /// Waits until the disk has them, then closes.
  void finish();
  const std::filesystem::path& path() const { return path_; }

 private:
  [[noreturn]] void fail() const;
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// ".part-<host>-<process id>": ends the name of a file or folder that this process is still working on.
std::string part_ending();
/// Whether the name has such an ending, of any process.
bool is_part(const std::string& name);
/// Whether it has one of a process of this machine that has ended.
bool is_abandoned_part(const std::string& name);

/// The folders above one that is to be made: made too, or there already (a result's own folder that was moved away is
/// not made anew, for half a result).
enum class Above { made, there };
/// Throws EnvironmentError as OutputFile does.
void make_folder(const std::filesystem::path& folder, Above above = Above::made);

/// Writes to a temporary name beside `path`, waits for the disk and renames: a reader, or a crash, finds the old file
/// or the new one, never a part. On failure the old file is untouched and the temporary one removed. Throws
/// EnvironmentError naming `path`. `previous`, if given: the old file is kept under this name.
void write_whole_file(const std::filesystem::path& path, std::string_view bytes,
                      const std::filesystem::path& previous = {});

}  // namespace railstrata
