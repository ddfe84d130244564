#include "record/output_file.hpp"

#include <fmt/format.h>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/faults.hpp"
#include "record/disk.hpp"
#include "record/this_process.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPart = ".part-";

std::string remedy_of(int reason) {
  switch (reason) {
    case ENOSPC:
      return "make room on the disk";
#ifdef EDQUOT
    case EDQUOT:
      return "make room within your disk quota";
#endif
    case EFBIG:
      return "raise the limit on the size of files (ulimit -f)";
    case ENOENT:
      return "leave the folder where it is while results are written into it";
    case EROFS:
    case EACCES:
    case EPERM:
      return "choose a folder that can be written, with --out, or give yourself the permission";
    default:
      return "";
  }
}

[[noreturn]] void fail_on(const fs::path& path, int reason) {
  throw EnvironmentError("cannot write " + path.string() + ": " + std::generic_category().message(reason),
                         remedy_of(reason));
}

/// None if it is done.
int renamed(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  return error.default_error_condition().value();
}

/// A reader of the old file keeps it; the target of a link is not changed.
int open_anew(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status there = fs::symlink_status(path, ignored);
  if (fs::is_regular_file(there) || fs::is_symlink(there)) fs::remove(path, ignored);
  return disk::create(path);
}

}  // namespace

OutputFile::OutputFile(fs::path path) : path_(std::move(path)), descriptor_(open_anew(path_)) {
  if (descriptor_ < 0) fail();
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) disk::close(descriptor_);
}

void OutputFile::fail() const { fail_on(path_, errno); }

void OutputFile::write(std::string_view bytes) {
  for (std::ptrdiff_t written = 0; !bytes.empty();) {
    const std::ptrdiff_t n = disk::write(descriptor_, bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int reason = errno;
      if (written > 0) disk::cut_back(descriptor_, written);  // no part of a row
      fail_on(path_, reason);
    }
    written += n;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void OutputFile::finish() {
  if (!disk::sync(descriptor_)) fail();
  if (!disk::close(std::exchange(descriptor_, -1))) fail();
}

std::string part_ending() { return kPart + host_name() + "-" + std::to_string(process_id()); }

bool is_part(const std::string& name) { return name.find(kPart) != std::string::npos; }

bool is_abandoned_part(const std::string& name) {
  const auto at = name.find(kPart);
  if (at == std::string::npos) return false;
  const std::string tail = name.substr(at), host = fmt::format("-{}-", host_name());
  const auto before = tail.rfind(host);
  if (before == std::string::npos) return false;
  const std::string digits = tail.substr(before + host.size());
  if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos) return false;
  return !is_running(std::stol(digits));
}

void make_folder(const fs::path& folder, Above above) {
  std::error_code error;
  above == Above::made ? fs::create_directories(folder, error) : fs::create_directory(folder, error);
  if (error)
    throw EnvironmentError("cannot make the folder " + folder.string() + ": " + error.message(),
                           remedy_of(error.value()));
}

void write_whole_file(const fs::path& path, std::string_view bytes, const fs::path& previous) {
  const fs::path temporary = path.string() + part_ending();
  try {
    OutputFile file(temporary);
    file.write(bytes);
    file.finish();
    const int kept = previous.empty() ? ENOENT : renamed(path, previous);
    if (kept != 0 && kept != ENOENT) fail_on(path, kept);
    if (const int reason = renamed(temporary, path); reason != 0) {
      if (kept == 0) renamed(previous, path);
      fail_on(path, reason);
    }
  } catch (const EnvironmentError& e) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    std::string text = e.what();
    if (const std::size_t at = text.find(temporary.string()); at != std::string::npos)
      text.replace(at, temporary.string().size(), path.string());
    throw EnvironmentError(text, e.remedy);
  }
  disk::sync_folder_of(path);
}

}  // namespace railstrata
