#include <algorithm>
#include <cstdlib>
#include <new>
#include <vector>

#include <unsupported/Eigen/FFT>

#include "fft/fft.hpp"
#include "fft/lanes.hpp"

namespace railstrata {

namespace {

using Complex = std::complex<double>;

/// Each thread has its own: it keeps tables by length, which grow as they are asked for.
Eigen::FFT<double>& kiss() {
  thread_local Eigen::FFT<double> fft(
      Eigen::FFT<double>::impl_type(),
      static_cast<Eigen::FFT<double>::Flag>(Eigen::FFT<double>::HalfSpectrum | Eigen::FFT<double>::Unscaled));
  return fft;
}

}  // namespace

std::complex<double>* fft_alloc(std::size_t n) {
  constexpr std::size_t kAlignment = 64;
  const std::size_t bytes = (n * sizeof(std::complex<double>) + kAlignment - 1) / kAlignment * kAlignment;
  void* memory = std::aligned_alloc(kAlignment, bytes);
  if (!memory) throw std::bad_alloc();
  return static_cast<std::complex<double>*>(memory);
}
void fft_free(std::complex<double>* numbers) { std::free(numbers); }

struct Fft::Plans {
  int rows, columns, together;
};

Fft::Fft(int rows, int columns, int together) : plans_(std::make_unique<Plans>(Plans{rows, columns, together})) {}
Fft::~Fft() = default;

void Fft::row_forward(double* row, std::complex<double>* wave) const { kiss().fwd(wave, row, plans_->rows); }
void Fft::row_backward(std::complex<double>* wave, double* row) const { kiss().inv(row, wave, plans_->rows); }

namespace {

/// Kiss FFT with four columns at a time as its scalar.
Eigen::internal::kissfft_impl<Lanes>& kiss_of_lanes() {
  thread_local Eigen::internal::kissfft_impl<Lanes> fft;
  return fft;
}

/// `together` columns of n numbers one after the other, four side by side; transform(out, in) takes them through.
template <class Transform>
void transform_side_by_side(int n, int together, const Complex* in, Complex* out, Transform&& transform) {
  thread_local std::vector<std::complex<Lanes>> from, to;
  from.resize(static_cast<std::size_t>(n));
  to.resize(from.size());
  for (int first = 0; first < together; first += Lanes::kCount) {
    const int count = std::min(Lanes::kCount, together - first);
    const Complex* column[Lanes::kCount];
    for (int c = 0; c < Lanes::kCount; ++c) column[c] = in + (first + std::min(c, count - 1)) * n;
    for (int i = 0; i < n; ++i)
      from[static_cast<std::size_t>(i)] = {
          Lanes(column[0][i].real(), column[1][i].real(), column[2][i].real(), column[3][i].real()),
          Lanes(column[0][i].imag(), column[1][i].imag(), column[2][i].imag(), column[3][i].imag())};
    transform(to.data(), from.data());
    for (int c = 0; c < count; ++c)
      for (int i = 0; i < n; ++i) {
        const std::complex<Lanes>& z = to[static_cast<std::size_t>(i)];
        out[(first + c) * n + i] = {z.real()[c], z.imag()[c]};
      }
  }
}

}  // namespace

void Fft::columns_forward(std::complex<double>* in, std::complex<double>* out) const {
  transform_side_by_side(plans_->columns, plans_->together, in, out,
                         [n = plans_->columns](auto* to, const auto* from) { kiss_of_lanes().fwd(to, from, n); });
}
void Fft::columns_backward(std::complex<double>* in, std::complex<double>* out) const {
  transform_side_by_side(plans_->columns, plans_->together, in, out,
                         [n = plans_->columns](auto* to, const auto* from) { kiss_of_lanes().inv(to, from, n); });
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

/// Every column of a plane of waves, by `transform(out, in)`.
template <class Transform>
void transform_columns(std::complex<double>* waves, int nx, std::size_t width, Transform&& transform) {
  if (nx == kNone) return;
  thread_local std::vector<std::complex<double>> in, out;
  in.resize(static_cast<std::size_t>(nx));
  out.resize(in.size());
  for (std::size_t column = 0; column < width; ++column) {
    for (std::size_t i = 0; i < in.size(); ++i) in[i] = waves[i * width + column];
    transform(out.data(), in.data());
    for (std::size_t i = 0; i < in.size(); ++i) waves[i * width + column] = out[i];
  }
}

}  // namespace

void RealPlaneFft::forward(const double* plane, std::complex<double>* waves) const {
  const auto [nx, ny] = *plans_;
  const std::size_t width = plans_->width();
  if (ny == kNone)
    std::copy(plane, plane + nx, waves);
  else
    for (int i = 0; i < nx; ++i) kiss().fwd(waves + i * width, plane + static_cast<std::ptrdiff_t>(i) * ny, ny);
  transform_columns(waves, nx, width, [n = nx](auto* out, const auto* in) { kiss().fwd(out, in, n); });
}
void RealPlaneFft::backward(std::complex<double>* waves, double* plane) const {
  const auto [nx, ny] = *plans_;
  const std::size_t width = plans_->width();
  transform_columns(waves, nx, width, [n = nx](auto* out, const auto* in) { kiss().inv(out, in, n); });
  if (ny == kNone)
    for (int i = 0; i < nx; ++i) plane[i] = waves[i].real();
  else
    for (int i = 0; i < nx; ++i) kiss().inv(plane + static_cast<std::ptrdiff_t>(i) * ny, waves + i * width, ny);
}

}  // namespace railstrata
