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

/// Smallest even 2^a 3^b 5^c >= n.
int good_size(int n) {
  for (int m = n + (n & 1);; m += 2) {
    int r = m;
    for (int p : {2, 3, 5})
      while (r % p == 0) r /= p;
    if (r == 1) return m;
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

PlaneFft::PlaneFft(int nx, int ny)
    : nx_(nx), ny_(ny), mx_(good_size(2 * nx + 1)), my_(good_size(2 * ny)), width_(my_ / 2 + 1), blocks_((width_ + kBlock - 1) / kBlock), plans_(std::make_unique<Plans>()) {
  const std::lock_guard lock(planner());
  std::complex<double>* z = scratch<0>(static_cast<std::size_t>(std::max(mx_ * kBlock, width_)));
  double* r = reinterpret_cast<double*>(scratch<2>(static_cast<std::size_t>(width_)));
  constexpr unsigned flags = FFTW_ESTIMATE;  // measured plans would differ from run to run in the last bits
  plans_->row_forward = fftw_plan_dft_r2c_1d(my_, r, raw(z), flags);
  plans_->row_backward = fftw_plan_dft_c2r_1d(my_, raw(z), r, flags);
  const int n[] = {mx_};
  plans_->columns_forward = fftw_plan_many_dft(1, n, kBlock, raw(z), nullptr, kBlock, 1, raw(z), nullptr, kBlock, 1, FFTW_FORWARD, flags);
  plans_->columns_backward = fftw_plan_many_dft(1, n, kBlock, raw(z), nullptr, kBlock, 1, raw(z), nullptr, kBlock, 1, FFTW_BACKWARD, flags);
}

PlaneFft::~PlaneFft() = default;

std::vector<double> PlaneFft::spectrum(const std::vector<double>& table, int parity_x, int parity_y) const {
  const int hx = mx_ / 2, hy = my_ / 2;
  const std::size_t pitch = static_cast<std::size_t>(hy) + 1;
  std::vector<std::complex<double>> rows(static_cast<std::size_t>(hx + 1) * static_cast<std::size_t>(blocks_ * kBlock));
  for_each_if(threads_pay(), hx + 1, [&](std::ptrdiff_t i) {
    double* r = reinterpret_cast<double*>(scratch<2>(static_cast<std::size_t>(width_)));
    const double* t = table.data() + static_cast<std::size_t>(i) * pitch;
    for (int j = 0; j <= hy; ++j) r[j] = t[j];
    for (int j = 1; j < hy; ++j) r[my_ - j] = parity_y * t[j];
    if (parity_y < 0) r[0] = r[hy] = 0;
    std::complex<double>* z = scratch<0>(static_cast<std::size_t>(width_));
    fftw_execute_dft_r2c(plans_->row_forward, r, raw(z));
    std::copy(z, z + width_, rows.data() + static_cast<std::size_t>(i) * static_cast<std::size_t>(blocks_ * kBlock));
  });
  std::vector<double> out(spectrum_size());
  const double scale = 1.0 / (static_cast<double>(mx_) * my_);
  for_blocks([&](int block) {
    std::complex<double>* z = scratch<0>(static_cast<std::size_t>(mx_) * kBlock);
    for (int i = 0; i <= hx; ++i)
      for (int c = 0; c < kBlock; ++c) {
        const std::complex<double> v = rows[static_cast<std::size_t>(i) * static_cast<std::size_t>(blocks_ * kBlock) + static_cast<std::size_t>(block * kBlock + c)];
        const bool self_mirror = i == 0 || i == hx;
        z[i * kBlock + c] = self_mirror && parity_x < 0 ? 0.0 : v;
        if (!self_mirror) z[(mx_ - i) * kBlock + c] = static_cast<double>(parity_x) * v;
      }
    fftw_execute_dft(plans_->columns_forward, raw(z), raw(z));
    double* o = out.data() + static_cast<std::size_t>(block) * static_cast<std::size_t>(mx_) * kBlock;
    for (int k = 0; k < mx_ * kBlock; ++k) o[k] = scale * (parity_x * parity_y > 0 ? z[k].real() : z[k].imag());
  });
  return out;
}

std::vector<PlaneFft::Spectrum> PlaneFft::rows_in(const std::vector<const double*>& in, std::size_t outputs) const {
  const std::size_t pitch = static_cast<std::size_t>(blocks_ * kBlock);
  std::vector<Spectrum> work(std::max(in.size(), outputs), Spectrum(static_cast<std::size_t>(nx_ + 1) * pitch));
  for_each_if(threads_pay(), static_cast<std::ptrdiff_t>(in.size()) * nx_, [&](std::ptrdiff_t k) {
    const std::size_t c = static_cast<std::size_t>(k / nx_), i = static_cast<std::size_t>(k % nx_);
    double* r = reinterpret_cast<double*>(scratch<2>(static_cast<std::size_t>(width_)));
    const double* row = in[c] + i * static_cast<std::size_t>(ny_);
    std::copy(row, row + ny_, r);
    std::fill(r + ny_, r + my_, 0.0);
    std::complex<double>* z = scratch<0>(static_cast<std::size_t>(width_));
    fftw_execute_dft_r2c(plans_->row_forward, r, raw(z));
    std::copy(z, z + width_, work[c].data() + i * pitch);
  });
  return work;
}

std::complex<double>* PlaneFft::block_buffer(std::size_t planes) const { return scratch<1>(planes * static_cast<std::size_t>(mx_) * kBlock); }

void PlaneFft::columns_in(const Spectrum& rows, int block, std::complex<double>* z) const {
  const std::complex<double>* s = rows.data() + static_cast<std::size_t>(block) * kBlock;
  const std::size_t pitch = static_cast<std::size_t>(blocks_ * kBlock);
  for (int i = 0; i < nx_; ++i) std::copy(s + static_cast<std::size_t>(i) * pitch, s + static_cast<std::size_t>(i) * pitch + kBlock, z + i * kBlock);
  std::fill(z + nx_ * kBlock, z + mx_ * kBlock, 0.0);
  fftw_execute_dft(plans_->columns_forward, raw(z), raw(z));
}

void PlaneFft::columns_out(Spectrum& rows, int block, std::complex<double>* z, int rows_out) const {
  fftw_execute_dft(plans_->columns_backward, raw(z), raw(z));
  std::complex<double>* s = rows.data() + static_cast<std::size_t>(block) * kBlock;
  const std::size_t pitch = static_cast<std::size_t>(blocks_ * kBlock);
  for (int i = 0; i < rows_out; ++i) std::copy(z + i * kBlock, z + (i + 1) * kBlock, s + static_cast<std::size_t>(i) * pitch);
}

void PlaneFft::rows_out_of(const std::vector<Spectrum>& work, const std::vector<double*>& out, int rows_out) const {
  const std::size_t pitch = static_cast<std::size_t>(blocks_ * kBlock);
  for_each_if(threads_pay(), static_cast<std::ptrdiff_t>(out.size()) * rows_out, [&](std::ptrdiff_t k) {
    const std::size_t c = static_cast<std::size_t>(k / rows_out), i = static_cast<std::size_t>(k % rows_out);
    std::complex<double>* z = scratch<0>(static_cast<std::size_t>(width_));
    const std::complex<double>* s = work[c].data() + i * pitch;
    std::copy(s, s + width_, z);
    double* r = reinterpret_cast<double*>(scratch<2>(static_cast<std::size_t>(width_)));
    fftw_execute_dft_c2r(plans_->row_backward, raw(z), r);
    std::copy(r, r + ny_, out[c] + i * static_cast<std::size_t>(ny_));
  });
}

}  // namespace railstrata
