#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <sstream>

#include "core/faults.hpp"
#include "core/text.hpp"
#include "study/child_process.hpp"
#include "study/running_case.hpp"

namespace railstrata {
namespace {

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
