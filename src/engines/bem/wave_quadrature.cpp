#include "bem/wave_quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/lagrange.hpp"
#include "crack/gauss.hpp"

namespace railstrata {

WaveQuadrature::WaveQuadrature(double lowest, double highest, double reach) {
  constexpr double kRadians = 8;    // of a wave in a panel of eight points
  constexpr double kLittle = 0.25;  // of the even part: a panel of its own would cost more than it gives
  const double even = kRadians / reach > (1 - kLittle) * highest ? highest : kRadians / reach;
  k.push_back(lowest / std::numbers::e);  // the integral of what is linear in ln k is its value there
  weight.push_back(lowest);
  const int low = std::max(1, static_cast<int>(std::ceil(std::log(even / lowest) / 4)));
  for (int i = 0; i < low; ++i)
    add_panel(lowest * std::pow(even / lowest, 1.0 * i / low), lowest * std::pow(even / lowest, (i + 1.0) / low), true);
  const int panels = static_cast<int>(std::ceil((highest - even) / even));
  for (int i = 0; i < panels; ++i)
    add_panel(even + (highest - even) * i / panels, even + (highest - even) * (i + 1) / panels, false);
}

void WaveQuadrature::add_panel(double from, double to, bool in_logarithm) {
  for (const GaussPoint& g : kGauss8) {
    const double at = in_logarithm ? from * std::pow(to / from, g.node) : from + g.node * (to - from);
    k.push_back(at);
    weight.push_back(g.weight * (in_logarithm ? at * std::log(to / from) : to - from));
  }
}

std::vector<Eigen::MatrixXd> at_waves(const std::vector<Eigen::MatrixXd>& values, const std::vector<double>& k,
                                      const std::vector<double>& wanted) {
  std::vector<double> log;
  for (const double at : k) log.push_back(std::log(at));
  std::vector<Eigen::MatrixXd> out;
  for (const double at : wanted) {
    const LagrangeStencil s =
        lagrange_stencil(log.data(), static_cast<int>(log.size()), std::log(at), at < k.front() ? 2 : 4);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(values.front().rows(), values.front().cols());
    for (int i = 0; i < s.count; ++i) sum += s.weight[i] * values[static_cast<std::size_t>(s.first + i)];
    out.push_back(std::move(sum));
  }
  return out;
}

}  // namespace railstrata
