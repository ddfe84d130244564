#include "io/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/faults.hpp"
#include "io/this_process.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPart = ".part-";

std::string remedy_of(int reason) {
  switch (reason) {
    case ENOSPC:
      return "make room on the disk";
    case EDQUOT:
      return "make room within your disk quota";
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

/// A rename is on the disk when its folder is.
void sync_folder(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);  // not every file system can; the file itself is safe by now
  ::close(descriptor);
}

/// Whoever reads an old file of this name keeps it, and where a link leads nothing is changed.
int open_anew(const fs::path& path) {
  struct stat there {};
  if (::lstat(path.c_str(), &there) == 0 && (S_ISREG(there.st_mode) || S_ISLNK(there.st_mode))) ::unlink(path.c_str());
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
}

}  // namespace

OutputFile::OutputFile(fs::path path) : path_(std::move(path)), descriptor_(open_anew(path_)) {
  if (descriptor_ < 0) fail();
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::fail() const { fail_on(path_, errno); }

void OutputFile::write(std::string_view bytes) {
  for (off_t written = 0; !bytes.empty();) {
    const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int reason = errno;
      if (const off_t end = ::lseek(descriptor_, 0, SEEK_CUR); written > 0 && end >= written)
        static_cast<void>(::ftruncate(descriptor_, end - written) == 0);  // no part of a row
      fail_on(path_, reason);
    }
    written += n;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void OutputFile::finish() {
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail();  // EINVAL: pipes and devices
  if (::close(std::exchange(descriptor_, -1)) != 0) fail();
}

std::string part_ending() { return kPart + host_name() + "-" + std::to_string(::getpid()); }

bool is_part(const std::string& name) { return name.find(kPart) != std::string::npos; }

bool is_abandoned_part(const std::string& name) {
  const auto at = name.find(kPart);
  if (at == std::string::npos) return false;
  const std::string tail = name.substr(at), host = fmt::format("-{}-", host_name());
  const auto before = tail.rfind(host);
  if (before == std::string::npos) return false;
  const std::string digits = tail.substr(before + host.size());
  if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos) return false;
  return ::kill(std::stoi(digits), 0) != 0 && errno == ESRCH;
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
    const bool kept = !previous.empty() && ::rename(path.c_str(), previous.c_str()) == 0;
    if (!previous.empty() && !kept && errno != ENOENT) fail_on(path, errno);
    if (::rename(temporary.c_str(), path.c_str()) != 0) {
      const int reason = errno;
      if (kept) ::rename(previous.c_str(), path.c_str());
      fail_on(path, reason);
    }
  } catch (const EnvironmentError& e) {
    ::unlink(temporary.c_str());
    std::string text = e.what();
    if (const std::size_t at = text.find(temporary.string()); at != std::string::npos)
      text.replace(at, temporary.string().size(), path.string());
    throw EnvironmentError(text, e.remedy);
  }
  sync_folder(path);
}

}  // namespace railstrata
