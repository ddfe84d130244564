#pragma once
// Convolution of the three surface loads with tables of influence that are even or odd in x and y.
#include <cassert>
#include <complex>
#include <vector>

#include "bem/plane_fft.hpp"

namespace railstrata {

/// Parity of an influence in x and in y: +1 even, -1 odd.
struct Parity {
  int x, y;
};

/// Quantities out[s] = sum over the loads (p, q_x, q_y) of table entry times load, by one FFT: value(entry, load, s) is
/// the influence at an offset from a cell. The table holds the quadrant x, y >= 0 alone; the parities complete it. A
/// spectrum is real where both parities agree, else imaginary with its imaginary part kept: hence the two products
/// below.
template <std::size_t N, class Table, class Value>
void convolve(const PlaneFft& fft, const std::vector<const double*>& loads, const Table& table,
              const Parity (&parity)[3][N], const std::vector<double*>& out, Value&& value) {
  using Complex = std::complex<double>;
  assert(loads.size() == 3 && out.size() == N);
  Plane hat[3][N];
  Plane values(table.size());
  for (std::size_t load = 0; load < 3; ++load)
    for (std::size_t s = 0; s < N; ++s) {
      for (std::size_t i = 0; i < table.size(); ++i) values[i] = value(table[i], load, s);
      hat[load][s] = fft.spectrum(values, parity[load][s].x, parity[load][s].y);
    }
  fft.apply(loads, out, fft.nx(), [&](std::size_t first, int count, const PlaneFft::Spectra& z) {
    for (int k = 0; k < count; ++k) {
      const Complex load[3] = {z[0][k], z[1][k], z[2][k]};
      for (std::size_t s = 0; s < N; ++s) {
        Complex sum = 0;
        for (std::size_t l = 0; l < 3; ++l) {
          const double h = hat[l][s][first + static_cast<std::size_t>(k)];
          sum += parity[l][s].x * parity[l][s].y > 0 ? h * load[l] : Complex(-h * load[l].imag(), h * load[l].real());
        }
        z[s][k] = sum;
      }
    }
  });
}

}  // namespace railstrata
