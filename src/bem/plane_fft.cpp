#include "bem/plane_fft.hpp"

#include <fftw3.h>

#include <algorithm>
#include <mutex>

namespace railstrata {

namespace {

std::mutex& planner() {  // FFTW's planner is not thread-safe
  static std::mutex m;
  return m;
}

/// Smallest length >= n among those that FFTW's estimated plans transform well: about 1.2 ns a point where their
/// neighbours, with more threes, take 2 to 3.
int good_size(int n) {
  for (int length : {8,   10,  12,  14,  16,  20,  24,  28,  32,  40,  48,  56,  64,  72,  80,  96,  100, 112, 120,
                     128, 140, 160, 200, 224, 240, 256, 280, 320, 400, 448, 512, 640, 768, 800, 896, 960, 1024})
    if (length >= n) return length;
  for (int m = n + (n & 1);; m += 2) {
    int r = m;
    while (r % 2 == 0) r /= 2;
    if (r == 1 || r == 3 || r == 5 || r == 7 || r == 15 || r == 25) return m;
  }
}

fftw_complex* raw(std::complex<double>* z) { return reinterpret_cast<fftw_complex*>(z); }

/// Per-thread scratch that only grows, aligned as FFTW likes it.
template <int kSlot>
std::complex<double>* scratch(std::size_t n) {
  struct Buffer {
    std::complex<double>* data = nullptr;
    std::size_t size = 0;
    ~Buffer() { fftw_free(data); }
  };
  thread_local Buffer buffer;
  if (buffer.size < n) {
    fftw_free(buffer.data);
    buffer.data = reinterpret_cast<std::complex<double>*>(fftw_alloc_complex(n));
    buffer.size = n;
  }
  return buffer.data;
}

}  // namespace

struct PlaneFft::Plans {
  fftw_plan row_forward, row_backward, columns_forward, columns_backward;
  ~Plans() {
    const std::lock_guard lock(planner());
    for (fftw_plan p : {row_forward, row_backward, columns_forward, columns_backward}) fftw_destroy_plan(p);
  }
};

PlaneFft::PlaneFft(int nx, int ny, int reach_x, int reach_y)
    : nx_(nx),
      ny_(ny),
      mx_(good_size(2 * reach_x + 1)),
      my_(good_size(2 * reach_y)),
      width_(my_ / 2 + 1),
      groups_((width_ + kGroup - 1) / kGroup),
      plans_(std::make_unique<Plans>()) {
  const std::lock_guard lock(planner());
  Complex *z = scratch<0>(std::max(group_size(), static_cast<std::size_t>(width_))), *y = scratch<1>(group_size());
  double* r = reinterpret_cast<double*>(scratch<2>(static_cast<std::size_t>(width_)));
  constexpr unsigned flags = FFTW_ESTIMATE;  // measured plans would differ from run to run in the last bits
  plans_->row_forward = fftw_plan_dft_r2c_1d(my_, r, raw(z), flags);
  plans_->row_backward = fftw_plan_dft_c2r_1d(my_, raw(z), r, flags);
  const int n[] = {mx_};  // columns one after the other and from one place to another: two to three times as fast as
                          // side by side in place
  plans_->columns_forward =
      fftw_plan_many_dft(1, n, kGroup, raw(y), nullptr, 1, mx_, raw(z), nullptr, 1, mx_, FFTW_FORWARD, flags);
  plans_->columns_backward =
      fftw_plan_many_dft(1, n, kGroup, raw(z), nullptr, 1, mx_, raw(y), nullptr, 1, mx_, FFTW_BACKWARD, flags);
}

PlaneFft::~PlaneFft() = default;

std::vector<double> PlaneFft::spectrum(const std::vector<double>& table, int parity_x, int parity_y) const {
  const int hx = mx_ / 2, hy = my_ / 2;
  std::vector<Complex> rows(static_cast<std::size_t>(hx + 1) * pitch());
  for_each_if(threads_pay(), hx + 1, [&](std::ptrdiff_t i) {
    double* r = reinterpret_cast<double*>(scratch<2>(static_cast<std::size_t>(width_)));
    const double* t = table.data() + i * (hy + 1);
    for (int j = 0; j <= hy; ++j) r[j] = t[j];
    for (int j = 1; j < hy; ++j) r[my_ - j] = parity_y * t[j];
    if (parity_y < 0) r[0] = r[hy] = 0;
    Complex* z = scratch<0>(static_cast<std::size_t>(width_));
    fftw_execute_dft_r2c(plans_->row_forward, r, raw(z));
    std::copy(z, z + width_, rows.data() + static_cast<std::size_t>(i) * pitch());
  });
  std::vector<double> out(spectrum_size());
  const double scale = 1.0 / (static_cast<double>(mx_) * my_);
  for_each_if(threads_pay(), groups_, [&](int group) {
    Complex *y = scratch<1>(group_size()), *z = scratch<0>(group_size());
    for (int i = 0; i <= hx; ++i) {
      const bool self_mirror = i == 0 || i == hx;
      for (int c = 0; c < kGroup; ++c) {
        const Complex v = rows[static_cast<std::size_t>(i) * pitch() + static_cast<std::size_t>(group * kGroup + c)];
        y[c * mx_ + i] = self_mirror && parity_x < 0 ? 0.0 : v;
        if (!self_mirror) y[c * mx_ + mx_ - i] = static_cast<double>(parity_x) * v;
      }
    }
    fftw_execute_dft(plans_->columns_forward, raw(y), raw(z));
    const int columns = std::min(kGroup, width_ - group * kGroup);
    double* o = out.data() + static_cast<std::size_t>(group) * group_size();
    for (int k = 0; k < columns * mx_; ++k) o[k] = scale * (parity_x * parity_y > 0 ? z[k].real() : z[k].imag());
  });
  return out;
}

PlaneFft::Complex* PlaneFft::rows_in(const std::vector<const double*>& in, std::size_t planes) const {
  Complex* work = scratch<3>(planes * plane_size());
  for_each_if(threads_pay(), static_cast<std::ptrdiff_t>(in.size()) * nx_, [&](std::ptrdiff_t k) {
    const std::size_t c = static_cast<std::size_t>(k / nx_), i = static_cast<std::size_t>(k % nx_);
    double* r = reinterpret_cast<double*>(scratch<2>(static_cast<std::size_t>(width_)));
    const double* row = in[c] + i * static_cast<std::size_t>(ny_);
    std::copy(row, row + ny_, r);
    std::fill(r + ny_, r + my_, 0.0);
    Complex* z = work + c * plane_size() + i * pitch();
    fftw_execute_dft_r2c(plans_->row_forward, r, raw(z));
    std::fill(z + width_, z + pitch(), 0.0);
  });
  return work;
}

PlaneFft::Complex* PlaneFft::group_buffer(std::size_t planes) const { return scratch<1>(planes * group_size()); }

void PlaneFft::columns_in(const Complex* rows, int group, Complex* z) const {
  const Complex* s = rows + static_cast<std::size_t>(group) * kGroup;
  Complex* y = scratch<0>(group_size());
  for (int i = 0; i < nx_; ++i, s += pitch())
    for (int c = 0; c < kGroup; ++c) y[c * mx_ + i] = s[c];
  for (int c = 0; c < kGroup; ++c) std::fill(y + c * mx_ + nx_, y + (c + 1) * mx_, 0.0);
  fftw_execute_dft(plans_->columns_forward, raw(y), raw(z));
}

void PlaneFft::columns_out(Complex* rows, int group, Complex* z, int rows_out) const {
  Complex* s = rows + static_cast<std::size_t>(group) * kGroup;
  Complex* y = scratch<0>(group_size());
  fftw_execute_dft(plans_->columns_backward, raw(z), raw(y));
  for (int i = 0; i < rows_out; ++i, s += pitch())
    for (int c = 0; c < kGroup; ++c) s[c] = y[c * mx_ + i];
}

void PlaneFft::rows_out_of(Complex* work, const std::vector<double*>& out, int rows_out) const {
  for_each_if(threads_pay(), static_cast<std::ptrdiff_t>(out.size()) * rows_out, [&](std::ptrdiff_t k) {
    const std::size_t c = static_cast<std::size_t>(k / rows_out), i = static_cast<std::size_t>(k % rows_out);
    double* r = reinterpret_cast<double*>(scratch<2>(static_cast<std::size_t>(width_)));
    fftw_execute_dft_c2r(plans_->row_backward, raw(work + c * plane_size() + i * pitch()), r);
    std::copy(r, r + ny_, out[c] + i * static_cast<std::size_t>(ny_));
  });
}

}  // namespace railstrata
