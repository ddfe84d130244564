#include <cstdlib>
#include <new>

#include <unsupported/Eigen/FFT>

#include "bem/fft.hpp"

namespace railstrata {

namespace {

/// Each thread has its own: it keeps tables by length, which grow as they are asked for.
Eigen::FFT<double>& kiss() {
  thread_local Eigen::FFT<double> fft(
      Eigen::FFT<double>::impl_type(),
      static_cast<Eigen::FFT<double>::Flag>(Eigen::FFT<double>::HalfSpectrum | Eigen::FFT<double>::Unscaled));
  return fft;
}

}  // namespace

/// Of 2, 3 and 5 alone, for which kiss FFT has butterflies of their own; even, and its half as well: real transforms
/// go by halves.
int good_fft_length(int n) {
  for (int m = n + (4 - n % 4) % 4;; m += 4) {
    int r = m;
    for (int factor : {2, 3, 5})
      while (r % factor == 0) r /= factor;
    if (r == 1) return m;
  }
}

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
void Fft::columns_forward(std::complex<double>* in, std::complex<double>* out) const {
  for (int c = 0; c < plans_->together; ++c)
    kiss().fwd(out + c * plans_->columns, in + c * plans_->columns, plans_->columns);
}
void Fft::columns_backward(std::complex<double>* in, std::complex<double>* out) const {
  for (int c = 0; c < plans_->together; ++c)
    kiss().inv(out + c * plans_->columns, in + c * plans_->columns, plans_->columns);
}

}  // namespace railstrata
