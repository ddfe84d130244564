// Transforms against the sums that define them, whichever library they come from.
#include "fft/fft.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace railstrata {
namespace {

using Complex = std::complex<double>;
constexpr double kRoundOff = 1e-12;

double value(int k) { return std::sin(1.7 * k) + 0.3 * std::cos(0.61 * k * k); }

Complex turn(int product, int n, double sign) {
  return std::polar(1.0, sign * 2 * std::numbers::pi * (product % n) / n);
}

/// Numbers as transforms like them.
struct Numbers {
  explicit Numbers(int n) : data(fft_alloc(static_cast<std::size_t>(n))) {}
  ~Numbers() { fft_free(data); }
  Numbers(const Numbers&) = delete;
  Numbers& operator=(const Numbers&) = delete;
  Complex* data;
  double* real() const { return reinterpret_cast<double*>(data); }
};

TEST(Fft, GoodLengthsAreEvenAndNotMuchLonger) {
  for (int n = 1; n < 3000; ++n) {
    const int good = good_fft_length(n);
    ASSERT_GE(good, n);
    ASSERT_EQ(good % 2, 0) << n;
    if (n > 8) {
      ASSERT_LE(good, 1.34 * n) << n;
    }
  }
}

TEST(Fft, RowsAreTheirFourierSums) {
  for (const int n : {8, 30, good_fft_length(97)}) {
    const Fft fft(n, n, 1);
    Numbers row(n / 2 + 1), wave(n / 2 + 1);
    for (int j = 0; j < n; ++j) row.real()[j] = value(j);
    fft.row_forward(row.real(), wave.data);
    for (int k = 0; k <= n / 2; ++k) {
      Complex sum = 0;
      for (int j = 0; j < n; ++j) sum += value(j) * turn(j * k, n, -1);
      ASSERT_NEAR(std::abs(wave.data[k] - sum), 0, kRoundOff * n) << n << ' ' << k;
    }
    fft.row_backward(wave.data, row.real());
    for (int j = 0; j < n; ++j) ASSERT_NEAR(row.real()[j], n * value(j), kRoundOff * n * n) << n << ' ' << j;
  }
}

TEST(Fft, ColumnsAreTheirFourierSums) {
  constexpr int kTogether = 4;
  const int n = good_fft_length(45);
  const Fft fft(n, n, kTogether);
  Numbers in(n * kTogether), out(n * kTogether);
  const auto at = [](int c, int j) { return Complex{value(j + 100 * c), value(7 * j - c)}; };
  for (int c = 0; c < kTogether; ++c)
    for (int j = 0; j < n; ++j) in.data[c * n + j] = at(c, j);
  fft.columns_forward(in.data, out.data);
  for (int c = 0; c < kTogether; ++c)
    for (int k = 0; k < n; ++k) {
      Complex sum = 0;
      for (int j = 0; j < n; ++j) sum += at(c, j) * turn(j * k, n, -1);
      ASSERT_NEAR(std::abs(out.data[c * n + k] - sum), 0, kRoundOff * n) << c << ' ' << k;
    }
  fft.columns_backward(out.data, in.data);
  for (int c = 0; c < kTogether; ++c)
    for (int j = 0; j < n; ++j)
      ASSERT_NEAR(std::abs(in.data[c * n + j] - static_cast<double>(n) * at(c, j)), 0, kRoundOff * n * n);
}

void expect_plane(int nx, int ny) {
  SCOPED_TRACE(testing::Message() << nx << " x " << ny);
  const RealPlaneFft fft(nx, ny);
  const int width = ny / 2 + 1;
  std::vector<double> plane, back(static_cast<std::size_t>(nx * ny));
  for (int k = 0; k < nx * ny; ++k) plane.push_back(value(k));
  std::vector<Complex> waves(static_cast<std::size_t>(nx * width));
  fft.forward(plane.data(), waves.data());
  for (int a = 0; a < nx; ++a)
    for (int b = 0; b < width; ++b) {
      Complex sum = 0;
      for (int i = 0; i < nx; ++i)
        for (int j = 0; j < ny; ++j) sum += value(i * ny + j) * turn(a * i, nx, -1) * turn(b * j, ny, -1);
      ASSERT_NEAR(std::abs(waves[static_cast<std::size_t>(a * width + b)] - sum), 0, kRoundOff * nx * ny);
    }
  for (int k = 0; k < nx * ny; ++k) ASSERT_EQ(plane[static_cast<std::size_t>(k)], value(k)) << "the input is kept";
  fft.backward(waves.data(), back.data());
  for (int k = 0; k < nx * ny; ++k)
    ASSERT_NEAR(back[static_cast<std::size_t>(k)], nx * ny * value(k), kRoundOff * nx * ny * nx * ny);
}

TEST(RealPlaneFft, IsItsFourierSumAtAnyLengths) {
  expect_plane(12, 10);
  expect_plane(16, 1);
  expect_plane(9, 15);
  expect_plane(7, 6);
  expect_plane(1, 4);
}

}  // namespace
}  // namespace railstrata
