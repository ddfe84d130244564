#pragma once
// Numbers of the law of material/plastic.hpp from uniaxial tests. [Chaboche1989]
//
//   amplitudes of stabilised cycles   σ_a = σ_y0 + Σ C_i/γ_i tanh(γ_i ε_pa)
//   a stabilised loop, rising branch  σ = σ_y0 + Σ C_i/γ_i (1 − (1 + tanh(γ_i ε_pa)) e^{−γ_i (ε_p + ε_pa)})
//   monotonic tension                 σ = σ_s − Q e^{−b ε_p} + Σ C_i/γ_i (1 − e^{−γ_i ε_p}),   σ_s = σ_y0 + Q
// With given γ_i the first two are linear in σ_y0 and C_i/γ_i >= 0: least squares of the relative stress. The γ_i are
// sought on a geometric grid from 0.1 over the largest to 2 over the smallest plastic strain, four to a decade, then
// moved to where the error is least. Stabilised cycles give σ_s alone; a monotonic curve separates it from Q.
#include <vector>

#include "material/plastic.hpp"

namespace railstrata {

struct CurvePoint {
  double plastic_strain = 0;  ///< of amplitudes and monotonic tension > 0
  double stress = 0;          ///< Pa
};

struct HardeningFit {
  PlasticParameters<double> law{};  ///< mu = 0
  int backstresses = 0;
  double error = 0, largest_error = 0;  ///< of stress over the largest measured one: root mean square, largest
};

/// Backstresses: 1 to 4; 0: one more as long as it lowers the error by a quarter. Throws std::invalid_argument unless
/// there are more points, of different plastic strain, than numbers sought (2 backstresses + 1).
HardeningFit fit_amplitudes(const std::vector<CurvePoint>& points, int backstresses);
/// The same with given γ [-].
HardeningFit fit_amplitudes(const std::vector<CurvePoint>& points, const std::vector<double>& recalls);

/// A loop as branches of rising plastic strain, of which a falling one is taken with both signs changed; centred.
struct Loop {
  double amplitude = 0;            ///< ε_pa
  std::vector<CurvePoint> points;  ///< of both branches, those where it flows
};
/// From one closed loop as it was measured, point by point once around it; one in the sense that gives work back (∮ σ
/// dε_p < 0) is turned round. Tips where the stress is largest and smallest, centred on their middle. Points within 2 %
/// of the loop's plastic width of a reversal are elastic to the eye of a test and left out. Throws
/// std::invalid_argument with what is wrong: among it a branch of which most is missing.
Loop loop_of(const std::vector<CurvePoint>& measured);
HardeningFit fit_loop(const Loop& loop, int backstresses);

/// Q and b, and σ_y0 lowered by Q, of a fit to stabilised cycles; the error becomes that of the monotonic curve.
/// Q is 0 where no change of the yield stress makes the curve fit better.
/// The rates b among which it is sought: 0.1 over the longest to 3 over the smallest plastic strain.
struct RateBounds {
  double low = 0, high = 0;
};
RateBounds rate_bounds(const std::vector<CurvePoint>& monotonic);
HardeningFit with_isotropic_part(HardeningFit stabilised, const std::vector<CurvePoint>& monotonic);

/// σ_y0, Q and b of yield stresses of steel that was strained before, σ = σ_y0 + Q (1 − e^{−b ε_p}), no backstress: of
/// a given b linear in σ_y0 + Q and Q, plain least squares; b from the grid of rate_bounds. Strains >= 0, stresses
/// > 0; throws std::invalid_argument unless four points have three strains and the law keeps a yield stress.
HardeningFit fit_yield_stresses(const std::vector<CurvePoint>& points);

// Curves of a law, for pictures: uniaxial stress [Pa].
double amplitude_of(const PlasticParameters<double>& p, double plastic_amplitude);
double loop_stress(const PlasticParameters<double>& p, double plastic_amplitude, double plastic_strain);
double monotonic_stress(const PlasticParameters<double>& p, double plastic_strain);

}  // namespace railstrata
