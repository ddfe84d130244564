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

}  // namespace railstrata
