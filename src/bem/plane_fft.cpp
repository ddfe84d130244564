#include "bem/plane_fft.hpp"

#include <algorithm>

#include "fft/fft.hpp"

namespace railstrata {

namespace {

/// Per-thread scratch that only grows.
template <int kSlot>
std::complex<double>* scratch(std::size_t n) {
  struct Buffer {
    std::complex<double>* data = nullptr;
    std::size_t size = 0;
    ~Buffer() { fft_free(data); }
  };
  thread_local Buffer buffer;
  if (buffer.size < n) {
    fft_free(buffer.data);
    buffer.data = fft_alloc(n);
    buffer.size = n;
  }
  return buffer.data;
}

}  // namespace

PlaneFft::PlaneFft(int nx, int ny, int reach_x, int reach_y)
    : nx_(nx),
      ny_(ny),
      mx_(good_fft_length(2 * reach_x + 1)),
      my_(good_fft_length(2 * reach_y)),
      width_(my_ / 2 + 1),
      groups_((width_ + kGroup - 1) / kGroup),
      fft_(std::make_unique<Fft>(my_, mx_, kGroup)) {}

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
    fft_->row_forward(r, z);
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
    fft_->columns_forward(y, z);
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
    fft_->row_forward(r, z);
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
  fft_->columns_forward(y, z);
}

void PlaneFft::columns_out(Complex* rows, int group, Complex* z, int rows_out) const {
  Complex* s = rows + static_cast<std::size_t>(group) * kGroup;
  Complex* y = scratch<0>(group_size());
  fft_->columns_backward(z, y);
  for (int i = 0; i < rows_out; ++i, s += pitch())
    for (int c = 0; c < kGroup; ++c) s[c] = y[c * mx_ + i];
}

void PlaneFft::rows_out_of(Complex* work, const std::vector<double*>& out, int rows_out) const {
  for_each_if(threads_pay(), static_cast<std::ptrdiff_t>(out.size()) * rows_out, [&](std::ptrdiff_t k) {
    const std::size_t c = static_cast<std::size_t>(k / rows_out), i = static_cast<std::size_t>(k % rows_out);
    double* r = reinterpret_cast<double*>(scratch<2>(static_cast<std::size_t>(width_)));
    fft_->row_backward(work + c * plane_size() + i * pitch(), r);
    std::copy(r, r + ny_, out[c] + i * static_cast<std::size_t>(ny_));
  });
}

}  // namespace railstrata
