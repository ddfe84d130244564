#include "app/progress.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <utility>

#include "core/faults.hpp"

namespace railstrata {
namespace {

std::atomic<const char*> interrupt_answer{nullptr};
static_assert(std::atomic<const char*>::is_always_lock_free, "read in a signal handler");

void answer_interrupt(int) {
  const char* text = interrupt_answer;
  static_cast<void>(::write(STDERR_FILENO, text, static_cast<unsigned>(std::strlen(text))) < 0);
  _exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace

std::string progress_bar(const std::string& what, double fraction, double elapsed, double begin) {
  constexpr int kWidth = 30;
  const double f = std::clamp(fraction, 0.0, 1.0), in_this_time = f - begin;
  const int done = static_cast<int>(f * kWidth);
  const std::string left =
      in_this_time > 0.005 ? fmt::format("{} left", duration_text(elapsed * (1 - f) / in_this_time)) : "";
  return fmt::format("{}  [{:#<{}}{:-<{}}] {:3.0f} %  {}", what, "", done, "", kWidth - done, 100 * f, left);
}

Progress::Progress(std::string what, bool shown)
    : what_(std::move(what)), shown_(shown), terminal_(isatty(STDERR_FILENO) != 0) {
  if (!terminal_) next_ += std::chrono::seconds(30);
}

Progress::~Progress() { clear(); }

void Progress::clear() {
  if (drawn_ && terminal_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

void Progress::update(double fraction) {
  const auto now = Clock::now();
  if (begin_ < 0) begin_ = fraction;
  if (!shown_ || now < next_) return;
  next_ = now + (terminal_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(30000));
  const std::string line = progress_bar(what_, fraction, std::chrono::duration<double>(now - start_).count(), begin_);
  std::fputs(fmt::format("{}{}{}", terminal_ ? "\r\033[K" : "", line, terminal_ ? "" : "\n").c_str(),
             stderr);  // fmt::print would throw where nothing can be written
  std::fflush(stderr);
  drawn_ = true;
}

Waiting::Waiting(std::string what) : what_(std::move(what)) {
  if (spdlog::should_log(spdlog::level::info)) thread_ = std::thread([this] { show(); });
}

Waiting::~Waiting() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  ended_.notify_all();
  thread_.join();
}

void Waiting::show() {
  using std::chrono::milliseconds;
  constexpr milliseconds kFirst{2000}, kOnTerminal{500}, kElsewhere{30000};
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto begin = std::chrono::steady_clock::now();
  bool drawn = false;
  std::unique_lock lock(mutex_);
  for (milliseconds pause = kFirst; !ended_.wait_for(lock, pause, [this] { return done_; });) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const std::string line = fmt::format("{}: {} so far", what_, duration_text(seconds));
    std::fputs((terminal ? "\r\033[K" + line : line + "\n").c_str(), stderr);
    std::fflush(stderr);
    drawn = true;
    pause = terminal ? kOnTerminal : kElsewhere;
  }
  if (drawn && terminal) std::fputs("\r\033[K", stderr);
}

void answer_interrupt_with(const char* text) {
  interrupt_answer = text;
  if (std::signal(SIGINT, answer_interrupt) == SIG_IGN) std::signal(SIGINT, SIG_IGN);
}

}  // namespace railstrata
