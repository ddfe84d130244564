#include "app/waiting.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <utility>

#include "app/progress.hpp"
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

Waiting::Waiting(std::string what, bool shown) : what_(std::move(what)) {
  if (shown) thread_ = std::thread([this] { show(); });
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
