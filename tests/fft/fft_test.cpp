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

constexpr int kTogether = 4;

/// Rows that end before their length, as many as there may be left of a group.
void expect_rows(int n, int count, int given) {
  SCOPED_TRACE(testing::Message() << count << " rows of " << given << " in " << n);
  const Fft fft(n, n, kTogether);
  const int pitch = n / 2 + 3;
  Numbers waves(count * pitch);
  std::vector<double> rows, back(static_cast<std::size_t>(count * given));
  for (int j = 0; j < count * given; ++j) rows.push_back(value(j));
  fft.rows_forward(rows.data(), count, given, waves.data, static_cast<std::size_t>(pitch));
  for (int i = 0; i < count; ++i)
    for (int k = 0; k <= n / 2; ++k) {
      Complex sum = 0;
      for (int j = 0; j < given; ++j) sum += value(i * given + j) * turn(j * k, n, -1);
      ASSERT_NEAR(std::abs(waves.data[i * pitch + k] - sum), 0, kRoundOff * n) << i << ' ' << k;
    }
  for (int i = 0; i < count; ++i) waves.data[i * pitch] += Complex(0, 0.1 * i);  // of no row of real numbers
  fft.rows_backward(waves.data, static_cast<std::size_t>(pitch), count, given, back.data());
  for (int j = 0; j < count * given; ++j)
    ASSERT_NEAR(back[static_cast<std::size_t>(j)], n * value(j), kRoundOff * n * n) << j;
}

TEST(Fft, RowsAreTheirFourierSums) {
  expect_rows(8, 1, 8);
  expect_rows(30, 9, 30);
  expect_rows(30, 3, 13);
  expect_rows(good_fft_length(97), 13, 48);
}

TEST(Fft, ColumnsAreTheirFourierSums) {
  const int n = good_fft_length(45), given = 21, pitch = kTogether + 3;
  const Fft fft(n, n, kTogether);
  Numbers rows(n * pitch), columns(n * kTogether);
  const auto at = [](int c, int j) { return Complex{value(j + 100 * c), value(7 * j - c)}; };
  for (int j = 0; j < n; ++j)
    for (int c = 0; c < kTogether; ++c) rows.data[j * pitch + c] = at(c, j);
  fft.columns_forward(rows.data, static_cast<std::size_t>(pitch), given, columns.data);
  for (int c = 0; c < kTogether; ++c)
    for (int k = 0; k < n; ++k) {
      Complex sum = 0;
      for (int j = 0; j < given; ++j) sum += at(c, j) * turn(j * k, n, -1);
      ASSERT_NEAR(std::abs(columns.data[c * n + k] - sum), 0, kRoundOff * n) << c << ' ' << k;
    }
  fft.columns_backward(columns.data, given + 1, rows.data, static_cast<std::size_t>(pitch));
  for (int j = 0; j <= given; ++j)
    for (int c = 0; c < kTogether; ++c) {
      const Complex expected = j < given ? static_cast<double>(n) * at(c, j) : 0.0;
      ASSERT_NEAR(std::abs(rows.data[j * pitch + c] - expected), 0, kRoundOff * n * n);
    }
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
