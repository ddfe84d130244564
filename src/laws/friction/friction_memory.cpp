#include "friction/friction_memory.hpp"

#include <numbers>

namespace railstrata {

namespace {

/// Largest value of a smooth function of the slip velocity between `low` and `high`, to a thousandth.
template <class Function>
double largest(double low, double high, Function&& function) {
  constexpr int kSamples = 600;
  double most = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const double v = low * std::pow(high / low, static_cast<double>(i) / kSamples);
    most = std::max(most, function(v));
  }
  return most;
}

}  // namespace

double steepest_fall(const FallingFriction& law, double dt) {
  if (!law.remembers()) return -friction_share(law, 0).by_slip_velocity;
  const double way = law.memory_distance / dt;
  return largest(1e-4 * std::min(way, law.half_velocity), 1e2 * law.half_velocity,
                 [&](double v) { return -remembered_share(law, 0, v, dt).share.by_slip_velocity; });
}

double stable_memory_distance(const FallingFriction& law, double bound, const SlidingWaves& waves) {
  const double carried = 0.5 * std::sqrt(waves.shear_modulus * waves.density);
  const double excess = largest(1e-4 * law.half_velocity, 1e4 * law.half_velocity, [&](double v) {
    return v * (-bound * friction_share(law, v).by_slip_velocity - carried);
  });
  return excess * waves.longest / (std::numbers::pi * waves.shear_modulus);
}

}  // namespace railstrata
