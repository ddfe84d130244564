#include <fftw3.h>

#include <mutex>

#include "bem/fft.hpp"

namespace railstrata {

namespace {

std::mutex& planner() {  // FFTW's planner is not thread-safe
  static std::mutex m;
  return m;
}

fftw_complex* raw(std::complex<double>* z) { return reinterpret_cast<fftw_complex*>(z); }

}  // namespace

/// Lengths that FFTW's estimated plans transform well: about 1.2 ns a point where their neighbours, with more threes,
/// take 2 to 3.
int good_fft_length(int n) {
  for (int length : {8,   10,  12,  14,  16,  20,  24,  28,  32,  40,  48,  56,  64,  72,  80,  96,  100, 112, 120,
                     128, 140, 160, 200, 224, 240, 256, 280, 320, 400, 448, 512, 640, 768, 800, 896, 960, 1024})
    if (length >= n) return length;
  for (int m = n + (n & 1);; m += 2) {
    int r = m;
    while (r % 2 == 0) r /= 2;
    if (r == 1 || r == 3 || r == 5 || r == 7 || r == 15 || r == 25) return m;
  }
}

std::complex<double>* fft_alloc(std::size_t n) {
  return reinterpret_cast<std::complex<double>*>(fftw_alloc_complex(n));
}
void fft_free(std::complex<double>* numbers) { fftw_free(numbers); }

struct Fft::Plans {
  fftw_plan row_forward, row_backward, columns_forward, columns_backward;
  ~Plans() {
    const std::lock_guard lock(planner());
    for (fftw_plan p : {row_forward, row_backward, columns_forward, columns_backward}) fftw_destroy_plan(p);
  }
};

Fft::Fft(int rows, int columns, int together) : plans_(std::make_unique<Plans>()) {
  const std::size_t size =
      std::max(static_cast<std::size_t>(columns) * static_cast<std::size_t>(together), static_cast<std::size_t>(rows));
  std::complex<double>*z = fft_alloc(size), *y = fft_alloc(size);
  double* r = reinterpret_cast<double*>(y);
  const std::lock_guard lock(planner());
  constexpr unsigned flags = FFTW_ESTIMATE;  // measured plans would differ from run to run in the last bits
  plans_->row_forward = fftw_plan_dft_r2c_1d(rows, r, raw(z), flags);
  plans_->row_backward = fftw_plan_dft_c2r_1d(rows, raw(z), r, flags);
  const int n[] = {columns};  // columns one after the other and from one place to another: two to three times as fast
                              // as side by side in place
  plans_->columns_forward =
      fftw_plan_many_dft(1, n, together, raw(y), nullptr, 1, columns, raw(z), nullptr, 1, columns, FFTW_FORWARD, flags);
  plans_->columns_backward = fftw_plan_many_dft(1, n, together, raw(z), nullptr, 1, columns, raw(y), nullptr, 1,
                                                columns, FFTW_BACKWARD, flags);
  fft_free(z);
  fft_free(y);
}
Fft::~Fft() = default;

void Fft::row_forward(double* row, std::complex<double>* wave) const {
  fftw_execute_dft_r2c(plans_->row_forward, row, raw(wave));
}
void Fft::row_backward(std::complex<double>* wave, double* row) const {
  fftw_execute_dft_c2r(plans_->row_backward, raw(wave), row);
}
void Fft::columns_forward(std::complex<double>* in, std::complex<double>* out) const {
  fftw_execute_dft(plans_->columns_forward, raw(in), raw(out));
}
void Fft::columns_backward(std::complex<double>* in, std::complex<double>* out) const {
  fftw_execute_dft(plans_->columns_backward, raw(in), raw(out));
}

}  // namespace railstrata
