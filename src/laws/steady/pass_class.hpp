#pragma once
// Class of a series of passes (shakedown, ratchetting, …), at a point or as a whole, from two numbers of every pass:
// the plastic strain accumulated in it, Δp, and its net plastic strain, both equivalent strains, so that net <= Δp.
//
//   elastic shakedown   Δp < 1e-6: nothing flows any more
//   plastic shakedown   Δp the same from pass to pass, net < 1 % of it: closed cycles, no growth
//   ratchetting         net the same from pass to pass and at least 1 % of Δp: growth at a constant rate; a trend
//                       that falls faster than n^-0.05 is none
//   transient           neither yet: no claim
//
// "The same" is within 2 % over the last three steps from pass to pass; a claim takes at least four passes, elastic
// shakedown one. A rate that falls as any power of the pass meets 2 % too in the end, so the trend is asked as well.
#include <string>
#include <vector>

namespace railstrata {

/// Plastic strain of a pass that counts as none.
inline constexpr double kNoFlow = 1e-6;
/// Net strain over Δp below which a cycle is closed.
inline constexpr double kClosed = 0.01;

/// The trend (PassVerdict) up to which a rate counts as constant.
inline constexpr double kConstantTrend = 0.05;

enum class PassClass : int { elastic_shakedown, plastic_shakedown, ratchetting, transient };

/// Net plastic strain of a pass: √(2/3 e:e), e = E^p after - E^p before: the first six numbers of histories.
double net_strain(const double* before, const double* after);

/// Plastic strain of one pass.
struct PassStrain {
  double accumulated = 0, net = 0;
};

struct PassVerdict {
  PassClass kind = PassClass::transient;
  double rate = 0;   ///< net strain per pass of the last one
  double trend = 0;  ///< s of net ~ n^-s over the later half of the passes; 0: constant, above 1: it will stop
};

/// Class of all passes so far, the first one first.
PassVerdict classify(const std::vector<PassStrain>& passes);

/// Class of a point of a rail whose governing point has the class `whole`. The residual stress ties the points to each
/// other: while that one still changes, a point that flows the same for a few passes is on its way up or down, and has
/// no class yet, except "no flow", which is reported at once.
PassClass class_of_point(const std::vector<PassStrain>& passes, PassClass whole);

/// When the net strain that passes add up to reaches what the material bears.
struct DuctilityReach {
  double passes = 0;                ///< since the first one, at the last rate; infinite: never
  double earliest = 0, latest = 0;  ///< of: the largest rate and the smallest one of the later half of the passes, the
                                    ///< last rate, and net ~ n^-s with the trend; infinite: by that, never
};

/// ductility, reached: equivalent plastic strains; `reached` is that of the point that grows fastest. Of shakedown
/// (elastic or plastic) nothing grows: never. The increments are taken to have one direction, as in ratchetting;
/// otherwise it takes longer. `passes`: net strain per pass, the first one first, all of them.
DuctilityReach passes_to_ductility(double ductility, double reached, const std::vector<PassStrain>& passes);

/// "elastic shakedown", ...; of transient "transient: no claim yet".
std::string class_text(PassClass kind);

}  // namespace railstrata
