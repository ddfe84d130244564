#include "damage/flash_temperature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace railstrata {
namespace {

const ThermalMaterial kSteel{50, 7850, 460}, kCobalt{15, 8400, 420}, kCopper{390, 8900, 385};

double closed_form(double flux, double length, double speed, const ThermalMaterial& m) {
  return 0.5 * 2 * flux * std::sqrt(length) / std::sqrt(M_PI * m.conductivity * m.density * m.heat_capacity * speed);
}

// Uniform flux over 2a, like bodies: (2 q sqrt(2a))/sqrt(pi lambda rho c V) / 2 at the trailing edge, any cell.
TEST(FlashTemperature, OfUniformHeatIsTheClosedForm) {
  const double flux = 100e6, length = 12.8e-3, speed = 30;
  for (int n : {1, 7, 100}) {
    const std::vector<double> q(n, flux);
    const FlashTemperature t = flash_temperature({q, length / n, speed}, {kSteel, 0, {}}, {kSteel, 0, {}});
    EXPECT_NEAR(t.max / closed_form(flux, length, speed, kSteel), 1, 1e-12) << n;
    EXPECT_EQ(t.max, t.rise.back());
  }
}

// Flux q0 sqrt(s/l) of a piece l: the rise is (q0/e) sqrt(pi l/V) (s/l)/2 by the Beta function, per body half of it.
TEST(FlashTemperature, ConvergesForFluxThatRisesLikeASquareRoot) {
  const double flux = 100e6, length = 10e-3, speed = 30;
  const double exact = 0.5 * flux / kSteel.effusivity() * std::sqrt(M_PI * length / speed) / 2;
  double last = 1;
  for (int n : {20, 40, 80, 160}) {
    std::vector<double> q(n);
    for (int i = 0; i < n; ++i) q[i] = flux * std::sqrt((i + 0.5) / n);
    const double error =
        std::abs(flash_temperature({q, length / n, speed}, {kSteel, 0, {}}, {kSteel, 0, {}}).max / exact - 1);
    EXPECT_LT(error, 0.6 * last) << n;
    last = error;
  }
  EXPECT_LT(last, 1e-3);
}

TEST(FlashTemperature, UnlikeBodiesShareTheHeatAsTheirEffusivities) {
  const std::vector<double> q{1e7, 5e7, 9e7, 2e7, 0};
  const FlashTemperature t = flash_temperature({q, 1e-3, 30}, {kCopper, 0, {}}, {kSteel, 0, {}});
  const FlashTemperature alike = flash_temperature({q, 1e-3, 30}, {kSteel, 0, {}}, {kSteel, 0, {}});
  for (std::size_t i = 0; i < q.size(); ++i)
    EXPECT_NEAR(t.rise[i] / alike.rise[i], 2 * kSteel.effusivity() / (kCopper.effusivity() + kSteel.effusivity()),
                1e-12);
  const FlashTemperature turned = flash_temperature({q, 1e-3, 30}, {kSteel, 0, {}}, {kCopper, 0, {}});
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_NEAR(t.rise[i], turned.rise[i], 1e-9);
  EXPECT_LT(t.rise[4], t.rise[3]) << "it cools where there is no heat";
}

// A layer of the base's own material is none; a thick layer is a half-space of its own, a thin one is not there.
TEST(FlashTemperature, LayersHaveTheirLimits) {
  const std::vector<double> q(50, 1e8);
  const HeatedLine line{q, 0.25e-3, 30};
  const ThermalBody wheel{kSteel, 0, {}};
  const auto max = [&](const ThermalBody& rail) { return flash_temperature(line, rail, wheel).max; };
  const double steel = max({kSteel, 0, {}}), cobalt = max({kCobalt, 0, {}});
  EXPECT_NEAR(max({kSteel, 50e-6, kSteel}) / steel, 1, 1e-12);
  EXPECT_NEAR(max({kSteel, 5e-3, kCobalt}) / cobalt, 1, 1e-12);
  EXPECT_NEAR(max({kSteel, 1e-9, kCobalt}) / steel, 1, 1e-3);
}

/// Rise of the surface of a layered half-space under constant flux, by explicit finite differences in depth.
double by_differences(const ThermalBody& body, double flux, double time) {
  const double step = body.layer_thickness / 16;
  const int cells = 400;
  const double dt = 0.2 * step * step / std::max(body.layer.diffusivity(), body.base.diffusivity());
  const int steps = static_cast<int>(std::ceil(time / dt));
  std::vector<double> t(cells, 0.0), flow(cells + 1, 0.0);
  const auto of = [&](int i) -> const ThermalMaterial& { return i < 16 ? body.layer : body.base; };
  for (int s = 0; s < steps; ++s) {
    flow[0] = flux;
    for (int i = 1; i < cells; ++i) {
      const double resistance = 0.5 * step * (1 / of(i - 1).conductivity + 1 / of(i).conductivity);
      flow[i] = (t[i - 1] - t[i]) / resistance;
    }
    flow[cells] = 0;
    for (int i = 0; i < cells; ++i)
      t[i] += time / steps * (flow[i] - flow[i + 1]) / (step * of(i).density * of(i).heat_capacity);
  }
  return t[0] + flux * 0.5 * step / of(0).conductivity;
}

// Against differences in depth: the wheel takes no heat (nearly no effusivity).
TEST(FlashTemperature, OfALayeredBodyIsThatOfDifferencesInDepth) {
  const ThermalBody insulator{{1e-9, 1, 1}, 0, {}};
  const double time = 4e-4, speed = 30, flux = 1e8;
  const int n = 40;
  const std::vector<double> q(n, flux);
  for (const ThermalBody& rail : {ThermalBody{kSteel, 60e-6, kCobalt}, ThermalBody{kCobalt, 60e-6, kSteel}}) {
    const double rise = flash_temperature({q, time * speed / n, speed}, rail, insulator).max;
    EXPECT_NEAR(rise / by_differences(rail, flux, time), 1, 2e-3);
  }
}

TEST(FlashBounds, HoldTheLayeredBody) {
  std::vector<double> q(60);
  for (int i = 0; i < 60; ++i) q[i] = i < 20 ? 0 : 2e8 * std::sqrt(1 - std::pow((i - 29.5) / 30.5, 2));
  const HeatedLine line{q, 0.2e-3, 25};
  for (const ThermalMaterial& layer : {kCobalt, kCopper}) {
    for (double thickness : {5e-6, 20e-6, 60e-6, 200e-6}) {
      const ThermalBody rail{kSteel, thickness, layer}, wheel{kSteel, 0, {}};
      const FlashBounds b = flash_bounds(line, rail, wheel);
      const double rise = flash_temperature(line, rail, wheel).max;
      EXPECT_LE(b.lower, rise * (1 + 1e-12)) << thickness;
      EXPECT_GE(b.upper, rise * (1 - 1e-12)) << thickness;
      EXPECT_LT(b.lower, b.upper);
    }
  }
}

// Whichever layer is the most or the least effusive one; in what order they lie does not matter.
TEST(FlashBounds, TakeEveryLayer) {
  const ThermalMaterial steel{50, 7850, 460}, oxide{2, 5000, 700}, copper{380, 8900, 390};
  const std::vector<double> flux(40, 1e9);
  const HeatedLine line{flux, 0.25e-3, 25};
  const ThermalBody wheel{.base = steel, .layer = {}}, hot{.base = oxide, .layer = {}},
      cold{.base = copper, .layer = {}};
  for (const ThermalBody& rail :
       {ThermalBody{steel, 10e-6, copper, {oxide}}, ThermalBody{steel, 10e-6, steel, {oxide, copper}},
        ThermalBody{copper, 10e-6, steel, {steel, oxide}}}) {
    const FlashBounds bounds = flash_bounds(line, rail, wheel);
    EXPECT_NEAR(bounds.upper, flash_temperature(line, hot, wheel).max, 1e-9 * bounds.upper);
    EXPECT_NEAR(bounds.lower, flash_temperature(line, cold, wheel).max, 1e-9 * bounds.lower);
  }
}

TEST(FlashTemperature, FaultyDataAreRefused) {
  const std::vector<double> q(3, 1e7);
  EXPECT_THROW(flash_temperature({q, 1e-3, 0}, {kSteel, 0, {}}, {kSteel, 0, {}}), std::invalid_argument);
  EXPECT_THROW(flash_temperature({q, 1e-3, 10}, {{}, 0, {}}, {kSteel, 0, {}}), std::invalid_argument);
  EXPECT_THROW(flash_temperature({q, 1e-3, 10}, {kSteel, 1e-3, {}}, {kSteel, 0, {}}), std::invalid_argument);
  EXPECT_EQ(flash_temperature({{}, 1e-3, 10}, {kSteel, 0, {}}, {kSteel, 0, {}}).max, 0);
}

}  // namespace
}  // namespace railstrata
