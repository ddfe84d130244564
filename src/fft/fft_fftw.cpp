#include <fftw3.h>

#include <algorithm>
#include <mutex>
#include <vector>

#include "fft/fft.hpp"

namespace railstrata {

namespace {

std::mutex& planner() {  // FFTW's planner is not thread-safe
  static std::mutex m;
  return m;
}

fftw_complex* raw(std::complex<double>* z) { return reinterpret_cast<fftw_complex*>(z); }

}  // namespace

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

struct RealPlaneFft::Plans {
  fftw_plan forward = nullptr, backward = nullptr;
  ~Plans() {
    const std::lock_guard lock(planner());
    for (fftw_plan p : {forward, backward}) fftw_destroy_plan(p);
  }
};

RealPlaneFft::RealPlaneFft(int nx, int ny) : plans_(std::make_unique<Plans>()) {
  const std::size_t rows = static_cast<std::size_t>(nx);
  std::vector<double> plane(rows * static_cast<std::size_t>(ny));
  std::vector<std::complex<double>> waves(rows * static_cast<std::size_t>(ny / 2 + 1));
  const std::lock_guard lock(planner());
  constexpr unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;  // planes start anywhere
  plans_->forward = fftw_plan_dft_r2c_2d(nx, ny, plane.data(), raw(waves.data()), flags | FFTW_PRESERVE_INPUT);
  plans_->backward = fftw_plan_dft_c2r_2d(nx, ny, raw(waves.data()), plane.data(), flags);
}
RealPlaneFft::~RealPlaneFft() = default;

void RealPlaneFft::forward(const double* plane, std::complex<double>* waves) const {
  fftw_execute_dft_r2c(plans_->forward, const_cast<double*>(plane), raw(waves));
}
void RealPlaneFft::backward(std::complex<double>* waves, double* plane) const {
  fftw_execute_dft_c2r(plans_->backward, raw(waves), plane);
}

}  // namespace railstrata
