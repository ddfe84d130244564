#pragma once
// Integrals over wave numbers of functions that are known at some of them.
#include <Eigen/Core>
#include <vector>

namespace railstrata {

/// Wave numbers and weights of ∫ dk over 0 … highest for waves over lengths up to `reach`. Below `lowest` the integrand
/// is taken as linear in ln k.
struct WaveQuadrature {
  WaveQuadrature(double lowest, double highest, double reach);
  std::vector<double> k, weight;  ///< 1/m

 private:
  void add_panel(double from, double to, bool in_logarithm);
};

/// values: at the wave numbers k. At the wanted ones; linear in ln k below the first.
std::vector<Eigen::MatrixXd> at_waves(const std::vector<Eigen::MatrixXd>& values, const std::vector<double>& k,
                                      const std::vector<double>& wanted);

/// waves: what stations (index direction * their number + station; the first
/// direction is x) give each other at the wave numbers k, in the
/// amplitudes of SectionCompliance. Less the values at the largest k, but for the coupling of x with the other
/// directions, which is odd in k: what forces [N] at x = 0 move at x = spacing * 0, 1, … count - 1, m/N; the transposed
/// at -x. 1/pi Re ∫ D(k) e^{ikx} dk.
std::vector<Eigen::MatrixXd> by_offset(std::vector<Eigen::MatrixXd> waves, const std::vector<double>& k, double spacing,
                                       int count);

}  // namespace railstrata
