#include "app/control.hpp"

#include <spdlog/spdlog.h>

#include <optional>

#include "app/progress.hpp"

namespace railstrata {
namespace {

/// A bar for the phase under way, off the terminal while a line is written.
class Screen {
 public:
  void progress(const std::string& phase, double fraction) {
    if (phase != phase_) bar_.reset();
    phase_ = phase;
    if (!bar_ && fraction > 0 && fraction < 1) bar_.emplace(phase, spdlog::should_log(spdlog::level::info));
    if (bar_) bar_->update(fraction);
  }
  void log(spdlog::level::level_enum level, const std::string& text) {
    if (bar_ && spdlog::should_log(level)) bar_->clear();
    spdlog::log(level, "{}", text);
  }

 private:
  std::string phase_;
  std::optional<Progress> bar_;
};

}  // namespace

Control& control() {
  static Screen screen;
  static Control shown;
  static const bool connected = [] {
    shown.on_progress = [](const std::string& phase, double fraction, int) { screen.progress(phase, fraction); };
    shown.on_detail = [](const std::string& text) { screen.log(spdlog::level::debug, text); };
    shown.on_info = [](const std::string& text) { screen.log(spdlog::level::info, text); };
    shown.on_warning = [](const std::string& text) { screen.log(spdlog::level::warn, text); };
    return true;
  }();
  static_cast<void>(connected);
  return shown;
}

Control& control_by_signals() {
  static const bool installed = (handle_signals(control()), true);
  static_cast<void>(installed);
  return control();
}

}  // namespace railstrata
