#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "core/faults.hpp"
#include "core/text.hpp"
#include "study/running_case.hpp"

namespace railstrata {
namespace {

/// Starts this same program with other arguments; its output and errors go to `log`. The kernel kills it when this
/// process ends, in whatever way. To be called from the main thread. Throws EnvironmentError.
pid_t start_self(const std::vector<std::string>& words, const std::filesystem::path& log) {
  std::vector<std::string> copy = words;
  std::vector<char*> argv;
  for (std::string& w : copy) argv.push_back(w.data());
  argv.push_back(nullptr);
  const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (out < 0) throw EnvironmentError(fmt::format("cannot write {}: {}", log.string(), std::strerror(errno)));
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) {  // only calls that are safe after fork
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) _exit(static_cast<int>(ExitCode::interrupted));  // it died before that was said
    ::dup2(out, STDOUT_FILENO);
    ::dup2(out, STDERR_FILENO);
    if (const int in = ::open("/dev/null", O_RDONLY); in >= 0) ::dup2(in, STDIN_FILENO);
    ::signal(SIGUSR1, SIG_IGN);  // until it has a handler of its own: the default would end it
    ::execv("/proc/self/exe", argv.data());
    _exit(static_cast<int>(ExitCode::environment));
  }
  ::close(out);
  if (child < 0) throw EnvironmentError(fmt::format("cannot start a process: {}", std::strerror(errno)));
  return child;
}

/// True once it has ended; `status` is then that of waitpid.
bool has_ended(pid_t child, int& status) {
  const pid_t got = ::waitpid(child, &status, WNOHANG);
  return got == child || (got < 0 && errno == ECHILD);
}

/// "killed by signal 9 (Killed)", "exit code 3".
std::string describe_end(int status) {
  if (WIFSIGNALED(status))
    return fmt::format("killed by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  return fmt::format("exit code {}", WEXITSTATUS(status));
}

/// Reason of a failure by the log: its first error, else its last line.
std::string reason_of(const std::string& log, int status) {
  std::istringstream lines(log);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    if (const auto at = line.find("error: "); at != std::string::npos) return line.substr(at + 7);
    if (!line.empty()) last = line;
  }
  return WIFEXITED(status) && !last.empty() ? fmt::format("{}: {}", describe_end(status), last) : describe_end(status);
}

bool has_result(int status) {
  return WIFEXITED(status) && (WEXITSTATUS(status) == static_cast<int>(ExitCode::ok) ||
                               WEXITSTATUS(status) == static_cast<int>(ExitCode::failed_checks));
}

class CaseProcess : public RunningCase {
 public:
  CaseProcess(const std::vector<std::string>& words, std::filesystem::path log)
      : log_(std::move(log)), process_(start_self(words, log_)) {}
  ~CaseProcess() override {
    if (gone_) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }

  std::optional<std::string> ended() override {
    int status = 0;
    if (!has_ended(process_, status)) return std::nullopt;
    gone_ = true;
    return has_result(status) ? "" : reason_of(file_text(log_), status);
  }
  void ask_to_stop() override { ::kill(process_, SIGTERM); }
  void ask_to_save() override { ::kill(process_, SIGUSR1); }

  /// By the last percentage in its log.
  double fraction() const override {
    const std::string text = file_text(log_);
    const auto at = text.rfind(" %");
    if (at == std::string::npos || at < 3) return 0;
    double percent = 0;
    std::istringstream(text.substr(at - 3, 3)) >> percent;
    return std::clamp(0.01 * percent, 0.0, 1.0);
  }

 private:
  const std::filesystem::path log_;
  const pid_t process_;
  bool gone_ = false;
};

}  // namespace

void ignore_second_signal_in_children() { ::setenv(kIgnoreSecondSignal, "1", 1); }

std::unique_ptr<RunningCase> start_process(const StudyCase& c, const CaseSettings& settings,
                                           const std::filesystem::path& folder, bool begun) {
  std::vector<std::string> words = case_command(c, settings, folder);
  if (begun)
    words = {"railstrata",
             "run",
             "--resume",
             folder.string(),
             "--no-report",
             "--threads",
             fmt::format("{}", settings.threads)};
  return std::make_unique<CaseProcess>(words, folder / "log.txt");
}

}  // namespace railstrata
