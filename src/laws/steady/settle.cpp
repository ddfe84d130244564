#include "steady/settle.hpp"

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"

namespace railstrata {
namespace {

constexpr double kGrown = 1.5;  // of the squared residual over the least since a restart

double square(double v) { return v * v; }

}  // namespace

SettledState settle(const std::vector<double>& from, const StateChange& first, double wheels,
                    std::span<const double> scale, const ChangeOf& change, const SettleLimits& limits) {
  const std::size_t n = from.size();
  SettledState out{.state = from, .change = first};
  std::vector<double> before = from, next(n), pace = first.pace;
  double momentum = 1, least = 0;
  for (;;) {
    double excess = 0, turn = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double left = from[i] - out.state[i] + wheels * out.change.mean[i];
      next[i] = out.state[i] + left / (1 + wheels * pace[i]);
      excess += square(scale[i] * left);
      turn += square(scale[i]) * left * (next[i] - before[i]);
    }
    out.unsettled = excess > 0 ? std::sqrt(excess) / (wheels * out.change.flow) : 0;
    if ((out.changes > 0 && out.unsettled <= limits.tolerance) || out.changes >= limits.changes) {
      out.pace = std::move(pace);
      return out;
    }
    if (asked_to_stop(limits.control)) throw Interrupted("stopped while the rail settles");
    if (out.changes == 0 || excess < least) least = excess;
    if (turn < 0 || excess > kGrown * least) {
      momentum = 1;
      least = excess;
    }
    const double then = 0.5 * (1 + std::sqrt(1 + 4 * momentum * momentum)), on = (momentum - 1) / then;
    momentum = then;
    for (std::size_t i = 0; i < n; ++i) {
      const double extrapolated = pace[i] > 0 ? on * (next[i] - before[i]) : 0;
      out.state[i] = next[i] + extrapolated;
      before[i] = next[i];
    }
    out.change = change(out.state);
    for (std::size_t i = 0; i < n; ++i) pace[i] = std::max(pace[i], out.change.pace[i]);
    ++out.changes;
  }
}

}  // namespace railstrata
