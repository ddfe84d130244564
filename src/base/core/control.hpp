#pragma once
// Requests to a long computation and its reports, in one object: set by a signal handler or a thread of another
// language, read by the loop between two steps.
#include <fmt/format.h>

#include <atomic>
#include <functional>
#include <string>
#include <utility>

namespace railstrata {

struct Control {
  /// Set from any thread or by a signal's handler. stop: end in good order and keep what is done; save: save the state
  /// and go on; the code that saves resets it.
  std::atomic<bool> stop{false}, save{false};

  /// Called one at a time, from any thread; any may be empty. A phase ("rolling"; empty: none is under way), how far it
  /// is from 0 to 1, and of passes the number of the one under way.
  std::function<void(const std::string& phase, double fraction, int number)> on_progress;
  std::function<void(const std::string&)> on_detail, on_info, on_warning;

  void progress(const std::string& phase, double fraction = 0, int number = 0) const {
    if (on_progress) on_progress(phase, fraction, number);
  }
  template <class... Values>
  void detail(fmt::format_string<Values...> text, Values&&... values) const {
    if (on_detail) on_detail(fmt::format(text, std::forward<Values>(values)...));
  }
  template <class... Values>
  void info(fmt::format_string<Values...> text, Values&&... values) const {
    if (on_info) on_info(fmt::format(text, std::forward<Values>(values)...));
  }
  template <class... Values>
  void warn(fmt::format_string<Values...> text, Values&&... values) const {
    if (on_warning) on_warning(fmt::format(text, std::forward<Values>(values)...));
  }
};

/// Without a control nothing is asked.
inline bool asked_to_stop(const Control* control) { return control && control->stop; }
inline Control& control_or_none(Control* control) {
  static Control none;
  return control ? *control : none;
}

}  // namespace railstrata
