#pragma once
// Passes that are jumped over: the state of the rail (plastic strain, backstresses, accumulated strain, as of
// PassState) after many more rounds, from the change that rounds make at some states in between. A round: the passes
// after which the plan of the wheels begins again, one where all are the same.
//
// H' = D(H), D the change in a round: the passes are Euler's steps of length 1 of it. What passes settle decays at all
// speeds, by a half in a round or in hundreds of them, so that extrapolating a rate over m rounds is unstable beyond
// some three times the rounds computed in between. A Runge-Kutta-Chebyshev step of second order with s stages is stable
// over 0.65 s² rounds. [SommeijerShampineVerwer1998]. Its error is that of the change against the trapezoidal rule with
// the rates at both ends; a jump above the tolerance is taken back, and the length goes with the root of tolerance over
// error. Between rounds and the solution in time there is half a round of delay, times the logarithm of their number.
#include <functional>
#include <optional>
#include <vector>

namespace railstrata {

/// Rounds computed before the first jump and after the last one, as many as a class takes.
inline constexpr int kRoundsBeforeJumps = 3, kRoundsAfterJumps = 4;
/// Rounds below which the stages cost as much as the rounds, and of the first try.
inline constexpr int kShortestJump = 6;

struct JumpMemory {
  int length = 0;    ///< rounds that the next jump tries; 0: no jumps; too few: it grows by each that is computed
  double error = 0;  ///< largest of the jumps so far
};

/// Change of the state in a round from a state on; empty: given up.
using RoundChange = std::function<std::optional<std::vector<double>>(const std::vector<double>& state)>;

/// Stages of a jump.
int stages_of(int rounds);

/// The state after so many rounds; first: the change in the first one from `start` on. Asks for stages_of(rounds) - 1
/// further ones. Empty: given up.
std::optional<std::vector<double>> state_after(const std::vector<double>& start, const std::vector<double>& first,
                                               int rounds, const RoundChange& change);

/// Error of the mean rate of a jump, `rates` those of the rounds at its beginning and end: of plastic strain over the
/// net strain, or 1 % of Δp where that is more, or of Δp over Δp: the larger one; each a root of the sum of squares
/// over all points.
double jump_error(const std::vector<double>& start, const std::vector<double>& end,
                  const std::vector<double>& rate_at_start, const std::vector<double>& rate_at_end, int rounds);

/// Rounds of the next try; below kShortestJump: compute instead.
int next_jump(int rounds, double error, double tolerance);

}  // namespace railstrata
