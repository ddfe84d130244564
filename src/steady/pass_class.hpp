#pragma once
// What a series of passes has come to, at a point or as a whole, from two numbers of every pass: the plastic strain
// accumulated in it, Δp, and its net plastic strain |E^p_n - E^p_(n-1)|.
//
//   elastic shakedown   Δp < 1e-6: nothing flows any more
//   plastic shakedown   Δp the same from pass to pass, net < 1 % of it: closed cycles, no growth
//   ratchetting         net the same from pass to pass and at least 1 % of Δp: growth at a constant rate
//   transient           neither yet: no claim
//
// "The same" is within 2 % over the last three steps from pass to pass; a claim takes at least four passes, elastic
// shakedown one. A rate that falls slowly meets 2 % too in the end: look at the trend.
#include <string>
#include <vector>

namespace railstrata {

enum class PassClass : int { elastic_shakedown, plastic_shakedown, ratchetting, transient };

/// Of one pass.
struct PassStrain {
  double accumulated = 0, net = 0;
};

struct PassVerdict {
  PassClass kind = PassClass::transient;
  double rate = 0;   ///< net strain per pass of the last one
  double trend = 0;  ///< s of net ~ n^-s over the later half of the passes; 0: constant, above 1: it will stop
};

/// Of all passes so far, the first one first.
PassVerdict classify(const std::vector<PassStrain>& passes);

/// "elastic shakedown", ...; of transient "transient: no claim yet".
std::string words(PassClass kind);

}  // namespace railstrata
