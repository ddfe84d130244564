#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bem/plane_fft.hpp"

namespace railstrata {
namespace {

/// A kernel of a parity and a size; size 0: nothing.
PlaneFft::KernelTable kernel(const PlaneFft& fft, int parity_x, int parity_y, double size) {
  const int nx = fft.mx() / 2 + 1, ny = fft.my() / 2 + 1;
  PlaneFft::KernelTable out{{}, parity_x, parity_y};
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      out.values.push_back(size * (parity_x > 0 ? 1 : i) * (parity_y > 0 ? 1 : j) * std::exp(-0.3 * i - 0.2 * j));
  return out;
}

}  // namespace

// Strains of 1e-12 stand next to stresses of 1, and next to kernels of a line contact that are nothing.
TEST(KernelSpectra, ThoseOfTablesThatShareATransformAreTheirOwn) {
  const PlaneFft fft(20, 12);
  std::vector<PlaneFft::KernelTable> tables;
  for (const double size : {1.0, 1e-12, 0.0})
    for (const int x : {1, -1})
      for (const int y : {1, -1}) tables.push_back(kernel(fft, x, y, size));
  const std::vector<Plane> together = fft.spectra(tables);
  ASSERT_EQ(together.size(), tables.size());
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const Plane alone = fft.spectrum(tables[t].values, tables[t].parity_x, tables[t].parity_y);
    double largest = 0;
    for (const double v : alone) largest = std::max(largest, std::abs(v));
    for (std::size_t k = 0; k < alone.size(); ++k) ASSERT_NEAR(together[t][k], alone[k], 1e-15 * largest) << t;
  }
}

}  // namespace railstrata
