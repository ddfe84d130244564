#include <algorithm>
#include <array>
#include <cassert>
#include <new>
#include <vector>

#include <unsupported/Eigen/FFT>

#include "fft/fft.hpp"
#include "fft/lanes.hpp"

namespace railstrata {

namespace {

using Complex = std::complex<double>;

constexpr std::align_val_t kAlignment{64};

}  // namespace

std::complex<double>* fft_alloc(std::size_t n) {
  return static_cast<std::complex<double>*>(::operator new(n * sizeof(std::complex<double>), kAlignment));
}
void fft_free(std::complex<double>* numbers) { ::operator delete(numbers, kAlignment); }

struct Fft::Plans {
  int rows, columns, together;
};

Fft::Fft(int rows, int columns, int together) : plans_(std::make_unique<Plans>(Plans{rows, columns, together})) {
  assert(together % Lanes::kCount == 0);
}
Fft::~Fft() = default;

namespace {

using Four = std::complex<Lanes>;

/// Kiss FFT with four columns at a time, or two times four rows, as its scalar.
Eigen::internal::kissfft_impl<Lanes>& kiss_of_lanes() {
  thread_local Eigen::internal::kissfft_impl<Lanes> fft;
  return fft;
}

/// Buffers of a thread: input and output of a transform.
struct SideBySide {
  std::vector<Four> from, to;
  std::vector<Complex> nobody;  // in place of rows that are not there
};
SideBySide& side_by_side(int n) {
  thread_local SideBySide buffers;
  const std::size_t size = static_cast<std::size_t>(n);
  if (buffers.from.size() < size) {
    buffers.from.resize(size);
    buffers.to.resize(size);
    buffers.nobody.resize(size);
  }
  return buffers;
}

/// The real numbers of two rows go as real and imaginary parts of one.
constexpr int kRows = 2 * Lanes::kCount;

/// -i z and i z.
Four less_quarter(const Four& z) { return {z.imag(), -z.real()}; }
Four more_quarter(const Four& z) { return {-z.imag(), z.real()}; }

Four of_rows(Complex* const* row, int k) { return Lanes::side_by_side(row[0][k], row[1][k], row[2][k], row[3][k]); }
void to_rows(const Four& z, Complex* const* row, int k) { Lanes::apart(z, row[0][k], row[1][k], row[2][k], row[3][k]); }

/// Rows of `given` real numbers, zero beyond to n -> n/2 + 1 waves of each.
void transform_rows(int n, const double* reals, int count, int given, Complex* waves, std::size_t pitch) {
  auto& [from, to, nobody] = side_by_side(n);
  std::fill(from.begin() + given, from.begin() + n, Four(Lanes(0), Lanes(0)));
  for (int first = 0; first < count; first += kRows) {
    const double* row[kRows];
    Complex* wave[kRows];
    for (int r = 0; r < kRows; ++r) {
      row[r] = reals + static_cast<std::ptrdiff_t>(std::min(first + r, count - 1)) * given;
      wave[r] = first + r < count ? waves + static_cast<std::size_t>(first + r) * pitch : nobody.data();
    }
    for (int j = 0; j < given; ++j)
      from[static_cast<std::size_t>(j)] = {Lanes(row[0][j], row[1][j], row[2][j], row[3][j]),
                                           Lanes(row[4][j], row[5][j], row[6][j], row[7][j])};
    kiss_of_lanes().fwd(to.data(), from.data(), n);
    for (int k = 0; k <= n / 2; ++k) {
      const Four z = Lanes(0.5) * to[static_cast<std::size_t>(k)],
                 mirror = Lanes(0.5) * std::conj(to[static_cast<std::size_t>(k == 0 ? 0 : n - k)]);
      to_rows(z + mirror, wave, k);
      to_rows(less_quarter(z - mirror), wave + Lanes::kCount, k);
    }
  }
}

/// Back, the first `given` numbers of each; waves that are those of no real row become real.
void transform_rows_back(int n, Complex* waves, std::size_t pitch, int count, int given, double* reals) {
  auto& [from, to, nobody] = side_by_side(n);
  for (int first = 0; first < count; first += kRows) {
    Complex* wave[kRows];
    for (int r = 0; r < kRows; ++r) wave[r] = waves + static_cast<std::size_t>(std::min(first + r, count - 1)) * pitch;
    for (Complex* w : wave) {
      w[0] = w[0].real();
      if (n % 2 == 0) w[n / 2] = w[n / 2].real();
    }
    for (int k = 0; k <= n / 2; ++k) {
      const Four a = of_rows(wave, k), b = of_rows(wave + Lanes::kCount, k);
      from[static_cast<std::size_t>(k)] = a + more_quarter(b);
      if (k > 0) from[static_cast<std::size_t>(n - k)] = std::conj(a) + more_quarter(std::conj(b));
    }
    kiss_of_lanes().inv(to.data(), from.data(), n);
    for (int r = 0; r < std::min(kRows, count - first); ++r) {
      double* row = reals + static_cast<std::ptrdiff_t>(first + r) * given;
      const int lane = r % Lanes::kCount;
      for (int j = 0; j < given; ++j) {
        const Four& z = to[static_cast<std::size_t>(j)];
        row[j] = (r < Lanes::kCount ? z.real() : z.imag())[lane];
      }
    }
  }
}

}  // namespace

void Fft::rows_forward(const double* reals, int count, int given, Complex* waves, std::size_t pitch) const {
  transform_rows(plans_->rows, reals, count, given, waves, pitch);
}

void Fft::rows_backward(Complex* waves, std::size_t pitch, int count, int given, double* reals) const {
  transform_rows_back(plans_->rows, waves, pitch, count, given, reals);
}

void Fft::columns_forward(const Complex* rows, std::size_t pitch, int count, Complex* columns) const {
  const int n = plans_->columns;
  auto& [from, to, nobody] = side_by_side(n);
  std::fill(from.begin() + count, from.begin() + n, Four(Lanes(0), Lanes(0)));
  for (int first = 0; first < plans_->together; first += Lanes::kCount) {
    const Complex* row = rows + first;
    for (int i = 0; i < count; ++i, row += pitch)
      from[static_cast<std::size_t>(i)] = Lanes::side_by_side(row[0], row[1], row[2], row[3]);
    kiss_of_lanes().fwd(to.data(), from.data(), n);
    Complex* column[Lanes::kCount];
    for (int c = 0; c < Lanes::kCount; ++c) column[c] = columns + (first + c) * n;
    for (int i = 0; i < n; ++i) to_rows(to[static_cast<std::size_t>(i)], column, i);
  }
}

void Fft::columns_backward(Complex* columns, int count, Complex* rows, std::size_t pitch) const {
  const int n = plans_->columns;
  auto& [from, to, nobody] = side_by_side(n);
  for (int first = 0; first < plans_->together; first += Lanes::kCount) {
    Complex* column[Lanes::kCount];
    for (int c = 0; c < Lanes::kCount; ++c) column[c] = columns + (first + c) * n;
    for (int i = 0; i < n; ++i) from[static_cast<std::size_t>(i)] = of_rows(column, i);
    kiss_of_lanes().inv(to.data(), from.data(), n);
    Complex* row = rows + first;
    for (int i = 0; i < count; ++i, row += pitch)
      Lanes::apart(to[static_cast<std::size_t>(i)], row[0], row[1], row[2], row[3]);
  }
}

struct RealPlaneFft::Plans {
  int nx, ny;
  std::size_t width() const { return static_cast<std::size_t>(ny / 2 + 1); }
};

RealPlaneFft::RealPlaneFft(int nx, int ny) : plans_(std::make_unique<Plans>(Plans{nx, ny})) {}
RealPlaneFft::~RealPlaneFft() = default;

namespace {

/// kiss FFT has no plan for a single number, which is its own transform.
constexpr int kNone = 1;

/// Every column of a plane of waves, four at a time, by `transform(out, in)`.
template <class Transform>
void transform_columns(Complex* waves, int nx, int width, Transform&& transform) {
  if (nx == kNone) return;
  auto& [from, to, nobody] = side_by_side(nx);
  for (int first = 0; first < width; first += Lanes::kCount) {
    std::array<int, Lanes::kCount> column;
    for (int c = 0; c < Lanes::kCount; ++c) column[static_cast<std::size_t>(c)] = std::min(first + c, width - 1);
    const auto [a, b, c, d] = column;
    Complex* row = waves;
    for (int i = 0; i < nx; ++i, row += width)
      from[static_cast<std::size_t>(i)] = Lanes::side_by_side(row[a], row[b], row[c], row[d]);
    transform(to.data(), from.data());
    row = waves;
    for (int i = 0; i < nx; ++i, row += width)
      Lanes::apart(to[static_cast<std::size_t>(i)], row[a], row[b], row[c], row[d]);
  }
}

}  // namespace

void RealPlaneFft::forward(const double* plane, std::complex<double>* waves) const {
  const auto [nx, ny] = *plans_;
  if (ny == kNone)
    std::copy(plane, plane + nx, waves);
  else
    transform_rows(ny, plane, nx, ny, waves, plans_->width());
  transform_columns(waves, nx, static_cast<int>(plans_->width()),
                    [n = nx](Four* out, const Four* in) { kiss_of_lanes().fwd(out, in, n); });
}
void RealPlaneFft::backward(std::complex<double>* waves, double* plane) const {
  const auto [nx, ny] = *plans_;
  transform_columns(waves, nx, static_cast<int>(plans_->width()),
                    [n = nx](Four* out, const Four* in) { kiss_of_lanes().inv(out, in, n); });
  if (ny == kNone)
    for (int i = 0; i < nx; ++i) plane[i] = waves[i].real();
  else
    transform_rows_back(ny, waves, plans_->width(), nx, ny, plane);
}

}  // namespace railstrata
