#include "track/beam_receptance.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>

namespace railstrata {
namespace {

using Complex = std::complex<double>;
constexpr Complex kI{0, 1};

/// Deflection of the endless rail under a force of one.
class Green {
 public:
  Green(const RailBeam& rail, double omega) {
    const Complex loss{1, rail.loss_factor}, s = rail.shear * loss, b = rail.bending * loss;
    const double w2 = omega * omega;
    const Complex middle = (s * rail.rotary + b * rail.mass) * w2, last = rail.mass * w2 * (s - rail.rotary * w2);
    const Complex root = std::sqrt(middle * middle + 4.0 * s * b * last);
    for (std::size_t n = 0; n < k_.size(); ++n) {
      const Complex square = (middle + (n == 0 ? root : -root)) / (2.0 * s * b);
      k_[n] = std::sqrt(square);
      if (k_[n].imag() < 0) k_[n] = -k_[n];
      const Complex slope = 4.0 * s * b * square * k_[n] - 2.0 * middle * k_[n];
      weight_[n] = kI * (b * square + s - rail.rotary * w2) / slope;
    }
  }
  Complex operator()(double x) const {
    const double d = std::abs(x);
    return weight_[0] * std::exp(kI * k_[0] * d) + weight_[1] * std::exp(kI * k_[1] * d);
  }

 private:
  std::array<Complex, 2> k_, weight_;
};

struct PadPoint {
  double x;
  int sleeper;
};

std::vector<PadPoint> pad_points(const SleeperTrack& track, double x, int supports) {
  const double first = std::floor(x / track.spacing - track.phase - 0.5 * (supports - 2));
  const double gauss = track.pad_length / std::sqrt(12.0);
  std::vector<PadPoint> out;
  for (int k = 0; k < supports; ++k) {
    const double at = (track.phase + first + k) * track.spacing;
    if (gauss == 0)
      out.push_back({at, k});
    else
      out.insert(out.end(), {{at - gauss, k}, {at + gauss, k}});
  }
  return out;
}

}  // namespace

std::complex<double> beam_receptance(const RailBeam& rail, const SleeperTrack& track, double x, double frequency,
                                     int supports) {
  const double omega = 2 * std::numbers::pi * frequency;
  const Green green(rail, omega);
  const std::vector<PadPoint> pads = pad_points(track, x, supports);
  const auto n = static_cast<Eigen::Index>(pads.size());
  const double share = static_cast<double>(supports) / static_cast<double>(n);
  const Complex pad = 1.0 / (share * Complex(track.pad_stiffness, omega * track.pad_damping));
  const Complex sleeper =
      1.0 / Complex(track.ballast_stiffness - track.sleeper_mass * omega * omega, omega * track.ballast_damping);
  Eigen::MatrixXcd a(n, n);
  Eigen::VectorXcd to_force(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const PadPoint& p = pads[static_cast<std::size_t>(i)];
    to_force(i) = green(p.x - x);
    for (Eigen::Index j = 0; j <= i; ++j) {
      const PadPoint& q = pads[static_cast<std::size_t>(j)];
      a(i, j) = green(p.x - q.x) + (p.sleeper == q.sleeper ? sleeper : 0.0) + (i == j ? pad : 0.0);
      a(j, i) = a(i, j);
    }
  }
  const Eigen::VectorXcd force = a.partialPivLu().solve(-to_force);
  return green(0) + (to_force.transpose() * force)(0);
}

double pinned_pinned_frequency(const RailBeam& rail, double spacing) {
  const double k2 = std::numbers::pi * std::numbers::pi / (spacing * spacing);
  // rho A rho I w^4 - (rho A S + (S rho I + B rho A) k^2) w^2 + S B k^4 = 0
  const double a = rail.mass * rail.rotary, c = rail.shear * rail.bending * k2 * k2;
  const double b = rail.mass * rail.shear + (rail.shear * rail.rotary + rail.bending * rail.mass) * k2;
  return std::sqrt(2 * c / (b + std::sqrt(b * b - 4 * a * c))) / (2 * std::numbers::pi);
}

}  // namespace railstrata
