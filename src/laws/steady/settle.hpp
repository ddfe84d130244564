#pragma once
// The state that very many wheels leave: what they change is known for one state at a time (a pass of every kind of
// wheel from that state on), and of the order of 1e5 to 1e7 wheels follow each other while the profile stays the same.
//
//   dH/dN = D(H),  D the mean change by one wheel of the mixture
//
// What passes settle decays at all speeds, by a half in a wheel or in thousands of them, so an explicit step of N
// wheels is unstable unless N is about one, and even a stabilized one costs the root of N changes. The step here is
// implicit,
//
//   H1 = H0 + N D(H1),
//
// which is stable for any N; its error is of first order in N, and a decay that is faster than N has ended. Points that
// only just yield make D kinked as in an obstacle problem, where Newton's method cycles between two sets of yielding
// points and Anderson's acceleration stalls (both measured). Nesterov's accelerated descent with a restart where it
// turns against the residual does not. [ODonoghueCandes2015] It restarts too where the residual has grown: D is not the
// gradient of a function where a backstress recalls with a power of its size, and momentum then drives a rotation.
#include <functional>
#include <span>
#include <vector>

#include "core/control.hpp"

namespace railstrata {

/// D at a state.
struct StateChange {
  std::vector<double> mean;  ///< by one wheel; as long as the state
  std::vector<double> pace;  ///< per number of the state the share of an excess of it that one wheel takes away, at
                             ///< most; 0: it only grows
  double flow = 0;           ///< by one wheel, what an error of `mean` is measured with: a norm as settle() has it
};
using ChangeOf = std::function<StateChange(const std::vector<double>& state)>;

struct SettleLimits {
  double tolerance = 0.03;  ///< norm of H0 + N D - H1 over N times the flow
  int changes = 200;        ///< at most so many calls of ChangeOf
  const Control* control = nullptr;
};

struct SettledState {
  std::vector<double> state;
  StateChange change;             ///< at that state
  std::vector<double> pace = {};  ///< largest that was met
  int changes = 0;                ///< calls of ChangeOf
  double unsettled = 0;           ///< of SettleLimits::tolerance
};

/// One implicit step of so many wheels from `from` on, D(from) given. scale: what each number of the state is
/// multiplied with in norms (0: it does not count). Throws Interrupted.
SettledState settle(const std::vector<double>& from, const StateChange& first, double wheels,
                    std::span<const double> scale, const ChangeOf& change, const SettleLimits& limits = {});

}  // namespace railstrata
