#include "study/claim.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/faults.hpp"
#include "core/printable.hpp"
#include "core/text.hpp"
#include "record/output_file.hpp"
#include "record/this_process.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
constexpr double kRenewals = 10;  // in a lease

/// A file that is closed with it.
struct Opened {
  explicit Opened(int d) : descriptor(d) {}
  ~Opened() {
    if (descriptor >= 0) ::close(descriptor);
  }
  Opened(Opened&&) = delete;
  int descriptor;
};

/// Time of the last change. Read from an open file: for a closed one a network file system may give a value some
/// seconds old.
std::optional<double> time_of(int descriptor) {
  struct stat s {};
  if (descriptor < 0 || ::fstat(descriptor, &s) != 0) return std::nullopt;
  return static_cast<double>(s.st_mtim.tv_sec) + 1e-9 * static_cast<double>(s.st_mtim.tv_nsec);
}

std::string job_id() {
  const auto variable = [](const char* name) {
    const char* text = std::getenv(name);
    return std::string(text ? text : "");
  };
  const std::string array = variable("SLURM_ARRAY_JOB_ID");
  if (!array.empty()) return array + "_" + variable("SLURM_ARRAY_TASK_ID");
  for (const char* name : {"SLURM_JOB_ID", "PBS_JOBID", "LSB_JOBID", "JOB_ID", "HQ_JOB_ID", "PARALLEL_SEQ"})
    if (std::string id = variable(name); !id.empty()) return id;
  return "";
}

std::string new_text(double lease) {
  static int count = 0;
  const ProcessName p = this_process();
  return Json{{"host", p.host},
              {"system", p.system},
              {"process", p.id},
              {"started", p.started},
              {"job", job_id()},
              {"lease_s", lease},
              {"time", static_cast<long long>(std::time(nullptr))},  // for people: no clock of a machine decides
              {"count", ++count}}
             .dump() +
         "\n";
}

/// Writes all of it. On a disk that is nearly full the first call takes a part; the next one fails with the reason.
bool write_all(int descriptor, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t n = ::write(descriptor, text.data() + at, text.size() - at);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    at += static_cast<std::size_t>(n);
  }
  return true;
}

/// A link, a pipe or a folder of this name is nobody's claim, and would be waited for without end.
void refuse_what_is_no_file(const fs::path& file) {
  std::error_code ignored;
  const fs::file_status there = fs::symlink_status(file, ignored);
  if (fs::exists(there) && !fs::is_regular_file(there))
    throw EnvironmentError(fmt::format("{} is in the way: it is no file", file.string()), "remove it");
}

/// False if it is there already.
bool create(const fs::path& file, const std::string& text) {
  const Opened out(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (out.descriptor < 0 && errno == EEXIST) return false;
  if (out.descriptor >= 0 && write_all(out.descriptor, text) && ::fsync(out.descriptor) == 0) return true;
  const int reason = errno;
  if (out.descriptor >= 0) ::unlink(file.c_str());
  throw EnvironmentError(fmt::format("cannot write {}: {}", file.string(), std::strerror(reason)),
                         "make room on the disk, or give yourself the permission to write there");
}

/// Takes away the claim that says `text`; of several processes one succeeds. Another's that has come there meanwhile
/// is put back, unless a third has claimed the place in that moment: then its owner notices the loss.
bool remove(const fs::path& file, const std::string& text) {
  const fs::path aside = file.string() + part_ending();
  if (::rename(file.c_str(), aside.c_str()) != 0) return false;
  const bool right = file_text(aside) == text;
  if (!right) static_cast<void>(::link(aside.c_str(), file.c_str()) == 0);
  ::unlink(aside.c_str());
  return right;
}

struct Owner {
  ProcessName process;
  std::string job;
  double lease;
};

/// None of a claim that is being written, or whose owner died then.
std::optional<Owner> owner_of(const std::string& text) {
  try {
    const Json j = Json::parse(text);
    return Owner{{j.at("host"), j.at("system"), j.at("process"), j.at("started")}, j.at("job"), j.at("lease_s")};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

bool is_dead(const fs::path& file, const std::string& text, double lease) {
  if (const std::optional<Owner> owner = owner_of(text)) {
    if (is_known_dead(owner->process)) return true;
    lease = owner->lease;
  }
  const std::optional<double> renewed = written_at(file), now = file_server_time(file);
  return renewed && now && *now - *renewed > lease;
}

}  // namespace

std::optional<double> file_server_time(const fs::path& beside) {
  const fs::path own = beside.string() + ".now" + part_ending();
  std::optional<double> now;
  {
    const Opened file(::open(own.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
    // without a time of ours the server takes its own
    if (file.descriptor >= 0 && ::futimens(file.descriptor, nullptr) == 0) now = time_of(file.descriptor);
  }
  ::unlink(own.c_str());
  return now;
}

std::optional<double> written_at(const fs::path& file) {
  return time_of(Opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC)).descriptor);
}

std::string claimed_by(const fs::path& file) {
  const std::optional<Owner> owner = owner_of(file_text(file));
  if (!owner) return fs::exists(file) ? "an unknown process" : "";
  return printable(fmt::format("{}, process {}{}", owner->process.host, owner->process.id,
                               owner->job.empty() ? "" : ", job " + owner->job));
}

Claim::Claim(fs::path file, std::string text, double lease)
    : file_(std::move(file)), text_(std::move(text)), lease_(lease) {}

Claim::Claim(Claim&& other) noexcept
    : file_(std::move(other.file_)),
      text_(std::move(other.text_)),
      lease_(other.lease_),
      renewed_(other.renewed_),
      ours_(std::exchange(other.ours_, false)) {}

Claim::~Claim() {
  if (ours_) remove(file_, text_);
}

std::optional<Claim> Claim::take(const fs::path& file, double lease) {
  make_folder(file.parent_path());
  const std::string text = new_text(lease);
  if (create(file, text)) return Claim(file, text, lease);
  refuse_what_is_no_file(file);
  const std::string others = file_text(file);
  if (!is_dead(file, others, lease) || !remove(file, others) || !create(file, text)) return std::nullopt;
  return Claim(file, text, lease);
}

bool Claim::is_ours() const { return ours_ && file_text(file_) == text_; }

bool Claim::renew() {
  const auto now = std::chrono::steady_clock::now();
  if (!ours_ || std::chrono::duration<double>(now - renewed_).count() < lease_ / kRenewals) return ours_;
  ours_ = is_ours();
  if (ours_) static_cast<void>(::utimensat(AT_FDCWD, file_.c_str(), nullptr, 0) == 0);
  renewed_ = now;
  return ours_;
}

}  // namespace railstrata
