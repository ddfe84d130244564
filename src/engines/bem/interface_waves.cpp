#include "bem/interface_waves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bem/layer_correction.hpp"
#include "crack/jump_waves.hpp"

namespace railstrata {
namespace {

constexpr int kInterfaceNodes = 160;

}  // namespace

InterfaceWaves::InterfaceWaves(const LayeredHalfSpace& body, std::size_t layer, const PatchGrid& grid)
    : grid_(grid),
      unit_x_(2 * std::numbers::pi / (grid.nx * grid.dx)),
      unit_y_(grid.line ? 0 : 2 * std::numbers::pi / (grid.ny * grid.dy)),
      fft_(std::make_shared<const RealPlaneFft>(grid.line ? 1 : grid.nx, grid.line ? grid.nx : grid.ny)) {
  const double low = grid.line ? unit_x_ : std::min(unit_x_, unit_y_),
               high = std::numbers::pi * (grid.line ? 1 / grid.dx : std::hypot(1 / grid.dx, 1 / grid.dy));
  const double step = std::log(high / low) / (kInterfaceNodes - 3), first = std::log(low) - step;
  std::vector<double> nodes;
  for (int i = 0; i < kInterfaceNodes; ++i) nodes.push_back(std::exp(first + i * step));
  const std::vector<Wave> node = at_nodes(body, layer, nodes);
  constexpr std::array<double Wave::*, 6> parts{&Wave::along,       &Wave::across,   &Wave::normal,
                                                &Wave::by_pressure, &Wave::by_along, &Wave::by_across};
  const int nx = grid.nx / 2, ny = grid.line ? 0 : grid.ny / 2;
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j) {
      Wave& out = wave_.emplace_back();
      Direction& way = way_.emplace_back();
      const double kx = unit_x_ * i, ky = unit_y_ * j, k = std::hypot(kx, ky);
      if (k == 0) continue;
      const double x = kx / k, y = ky / k;
      const bool known = 2 * i != grid.nx && (grid.line || 2 * j != grid.ny);
      way = {known ? x : 0, known ? y : 0, x * x, y * y, known ? x * y : 0};
      const double s = (std::log(k) - first) / step;
      const int from = std::clamp(static_cast<int>(s) - 1, 0, kInterfaceNodes - 4);
      const double t = s - from;
      const double w[4] = {-(t - 1) * (t - 2) * (t - 3) / 6, t * (t - 2) * (t - 3) / 2, -t * (t - 1) * (t - 3) / 2,
                           t * (t - 1) * (t - 2) / 6};
      for (const auto part : parts)
        for (int l = 0; l < 4; ++l) out.*part += w[l] * node[static_cast<std::size_t>(from + l)].*part;
      for (const auto part : {&Wave::along, &Wave::across, &Wave::normal}) out.*part *= k;
    }
}

/// The stiffnesses over k.
std::vector<InterfaceWaves::Wave> InterfaceWaves::at_nodes(const LayeredHalfSpace& body, std::size_t layer,
                                                           const std::vector<double>& k) const {
  double depth = 0;
  for (std::size_t l = 0; l <= layer; ++l) depth += body.layers[l].thickness;
  std::vector<Wave> out(k.size());
  for_each_if(true, static_cast<std::ptrdiff_t>(k.size()), [&](int i) {
    const double here = k[static_cast<std::size_t>(i)];
    const SlipResponse slip = slip_response(body, layer, here);
    const LayerWaves waves(body, here);
    const WaveResponse load = wave_response(waves, layer, depth);
    out[static_cast<std::size_t>(i)] = {slip.along / here, slip.across / here, slip.normal / here,
                                        load.T_p,          load.T_q,           load.Q};
  });
  return out;
}

double InterfaceWaves::stiffest() const {
  double most = 0;
  for (const Wave& w : wave_) most = std::max({most, -w.along, -w.across});
  return most;
}

double InterfaceWaves::stiffness_over(double length) const {
  const int waves = static_cast<int>(std::ceil(2 * std::numbers::pi / (length * unit_x_)));
  const std::size_t columns = grid_.line ? 1 : static_cast<std::size_t>(grid_.ny / 2 + 1);
  const Wave& w = wave_[static_cast<std::size_t>(std::clamp(waves, 1, grid_.nx / 2)) * columns];
  return std::max(-w.along, -w.across);
}

/// change(direction, wave, in, out): the values of all planes at one wave.
template <class Change>
std::vector<Plane> InterfaceWaves::changed(const PlanePair& given, std::size_t planes, Change&& change) const {
  const int nx = grid_.nx, columns = grid_.line ? 1 : grid_.ny / 2 + 1;
  // a line is one row of the transform
  const int rows = grid_.line ? nx / 2 + 1 : nx;
  const std::size_t n = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  std::array<std::vector<Complex>, 2> in{std::vector<Complex>(n), std::vector<Complex>(n)};
  fft_->forward(given.x.data(), in[0].data());
  fft_->forward(given.y.data(), in[1].data());
  std::vector<std::vector<Complex>> out(planes, std::vector<Complex>(n));
  const double scale = 1 / static_cast<double>(grid_.size());
  for (int i = 0; i < rows; ++i) {
    const int wave_x = 2 * i <= nx ? i : i - nx;
    for (int j = 0; j < columns; ++j) {
      const std::size_t at =
          static_cast<std::size_t>(i) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(j);
      const std::size_t quadrant =
          static_cast<std::size_t>(std::abs(wave_x)) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(j);
      Direction way = way_[quadrant];
      if (wave_x < 0) {
        way.x = -way.x;
        way.xy = -way.xy;
      }
      std::array<Complex, 3> value{};
      change(way, wave_[quadrant], scale * in[0][at], scale * in[1][at], value);
      for (std::size_t p = 0; p < planes; ++p) out[p][at] = value[p];
    }
  }
  std::vector<Plane> back(planes, Plane(grid_.size()));
  for (std::size_t p = 0; p < planes; ++p) fft_->backward(out[p].data(), back[p].data());
  return back;
}

PlanePair InterfaceWaves::shear(const PlanePair& slip) const {
  std::vector<Plane> out =
      changed(slip, 2, [](const Direction& d, const Wave& w, Complex x, Complex y, std::array<Complex, 3>& z) {
        z[0] = (w.along * d.xx + w.across * d.yy) * x + (w.along - w.across) * d.xy * y;
        z[1] = (w.along * d.yy + w.across * d.xx) * y + (w.along - w.across) * d.xy * x;
      });
  return {std::move(out[0]), std::move(out[1])};
}

PlanePair InterfaceWaves::slip_under(const PlanePair& shear, double hold) const {
  std::vector<Plane> out =
      changed(shear, 2, [&](const Direction& d, const Wave& w, Complex x, Complex y, std::array<Complex, 3>& z) {
        if (d.xx + d.yy == 0) {
          z[0] = x / hold;
          z[1] = y / hold;
          return;
        }
        const double along = 1 / (hold - w.along), across = 1 / (hold - w.across);
        z[0] = (along * d.xx + across * d.yy) * x + (along - across) * d.xy * y;
        z[1] = (along * d.yy + across * d.xx) * y + (along - across) * d.xy * x;
      });
  return {std::move(out[0]), std::move(out[1])};
}

// U = -i k^·slip (jump_waves.hpp)
Plane InterfaceWaves::pressure(const PlanePair& slip) const {
  return std::move(
      changed(slip, 1, [](const Direction& d, const Wave& w, Complex x, Complex y, std::array<Complex, 3>& z) {
        z[0] = Complex(0, w.normal) * (d.x * x + d.y * y);
      })[0]);
}

// shear = i k^ by_pressure P + k^ by_along (k^·q) + k^⊥ by_across (k^⊥·q); its conjugate transpose
std::array<Plane, 3> InterfaceWaves::surface(const PlanePair& slip) const {
  std::vector<Plane> out =
      changed(slip, 3, [](const Direction& d, const Wave& w, Complex x, Complex y, std::array<Complex, 3>& z) {
        z[0] = (w.by_along * d.xx + w.by_across * d.yy) * x + (w.by_along - w.by_across) * d.xy * y;
        z[1] = (w.by_along * d.yy + w.by_across * d.xx) * y + (w.by_along - w.by_across) * d.xy * x;
        z[2] = Complex(0, -w.by_pressure) * (d.x * x + d.y * y);
      });
  return {std::move(out[0]), std::move(out[1]), std::move(out[2])};
}

}  // namespace railstrata
