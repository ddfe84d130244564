#include "runs/run_control.hpp"

#include <algorithm>

namespace railstrata {

double RunControl::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - times_.begun).count();
}

bool RunControl::must_stop(double now) {
  if (asked_.stop) return true;
  limit_reached_ = limit_reached_ ||
                   (times_.limit > 0 && now + 2 * longest_save_ + longest_pause_ + 0.01 * times_.limit >= times_.limit);
  return limit_reached_;
}

Demand RunControl::demand() {
  const double now = elapsed();
  if (last_call_ >= 0) longest_pause_ = std::max(longest_pause_, now - last_call_);
  last_call_ = now;
  if (must_stop(now)) return Demand::save_and_stop;
  if (asked_.save.load(std::memory_order_relaxed) && asked_.save.exchange(false)) return Demand::save;
  return times_.checkpoint_every > 0 && now - last_save_ >= times_.checkpoint_every ? Demand::save : Demand::go_on;
}

void RunControl::saved(double seconds) {
  last_save_ = elapsed();
  longest_save_ = std::max(longest_save_, seconds);
  last_call_ = -1;
}

}  // namespace railstrata
