#include "app/shipped_files.hpp"

#include <spdlog/spdlog.h>

#include <cstdlib>
#include <system_error>

#include "record/this_process.hpp"

// Path of the data folder, seen from that of the program; the build gives the one it installs to.
#ifndef RAILSTRATA_DATA_FROM_PROGRAM
#define RAILSTRATA_DATA_FROM_PROGRAM "../share/railstrata"
#endif

namespace railstrata {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& file) {
  std::error_code error;  // a name too long, a folder that may not be entered: not there
  return fs::exists(file, error);
}

}  // namespace

fs::path shipped_folder() {
  if (const char* wanted = std::getenv("RAILSTRATA_DATA"); wanted != nullptr && *wanted != '\0') return wanted;
  const fs::path program = program_file().parent_path();
  if (program.empty()) return {};
  for (const char* place : {RAILSTRATA_DATA_FROM_PROGRAM, "..", "../.."})
    if (is_there(program / place / "cases/quick/case.toml")) return (program / place).lexically_normal();
  return {};
}

fs::path shipped_unless_there(const fs::path& file) {
  if (file.empty() || file.is_absolute() || is_there(file)) return file;
  const fs::path folder = shipped_folder();
  if (folder.empty() || !is_there(folder / file)) return file;
  spdlog::info("{} is not here; taking the one that comes with the program", file.string());
  return folder / file;
}

fs::path shipped_unless_there(const fs::path& file, const char* in_folder) {
  const fs::path found = shipped_unless_there(file);
  std::error_code error;  // a name that is too long: who reads it reports it
  return fs::is_directory(found, error) && is_there(found / in_folder) ? found / in_folder : found;
}

}  // namespace railstrata
