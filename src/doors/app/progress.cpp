#include "app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace railstrata {

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

}  // namespace railstrata
