#include "runs/run_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/units.hpp"
#include "core/faults.hpp"
#include "runs/stop_flag.hpp"

namespace railstrata {

double wall_time(const std::string& option, const std::string& text) {
  if (text == "0" || text == "never") return 0;
  try {
    const double seconds = parse_quantity(text, dimension::kTime);
    if (seconds >= 0 && std::isfinite(seconds)) return seconds;
    throw CaseError(fmt::format("{} \"{}\" is out of range", option, text),
                    "write a time, e.g. \"10 min\", or 0 for never");
  } catch (const UnitError& e) {
    throw CaseError(fmt::format("{} \"{}\": {}", option, text, e.what()), e.remedy);
  }
}

RunControl::RunControl(const RunTimes& times) : times_(times) { stop_flag(); }

bool RunControl::out_of_time(double now) const {
  return times_.limit > 0 && now + 2 * longest_save_ + longest_pause_ + 0.01 * times_.limit >= times_.limit;
}

Demand RunControl::demand() {
  const double now = elapsed();
  if (last_call_ >= 0) longest_pause_ = std::max(longest_pause_, now - last_call_);
  last_call_ = now;
  if (stop_flag()) return Demand::save_and_stop;
  if (out_of_time(now)) {
    limit_reached_ = true;
    return Demand::save_and_stop;
  }
  if (take_save_wish()) return Demand::save;
  return times_.checkpoint_every > 0 && now - last_save_ >= times_.checkpoint_every ? Demand::save : Demand::go_on;
}

void RunControl::saved(double seconds) {
  last_save_ = elapsed();
  longest_save_ = std::max(longest_save_, seconds);
  last_call_ = -1;
}

void RunControl::watch_limit() {
  if (!out_of_time(elapsed())) return;
  limit_reached_ = true;
  stop_flag() = true;
}

}  // namespace railstrata
