#include "bem/plane_fft.hpp"

#include "fft/fft_scratch.hpp"

namespace railstrata {
namespace {

struct WorkTag;
struct GroupTag;

}  // namespace

PlaneFft::PlaneFft(int nx, int ny, int reach_x, int reach_y)
    : nx_(nx),
      ny_(ny),
      mx_(good_fft_length(2 * reach_x + 1)),
      my_(good_fft_length(2 * reach_y)),
      width_(my_ / 2 + 1),
      groups_((width_ + kGroup - 1) / kGroup),
      fft_(my_, mx_, kGroup) {}

std::vector<double> PlaneFft::spectrum(const std::vector<double>& table, int parity_x, int parity_y) const {
  const int hx = mx_ / 2, hy = my_ / 2;
  std::vector<Complex> rows(static_cast<std::size_t>(mx_) * pitch());
  for_rows(1, hx + 1, [&](std::size_t, std::size_t first, int count) {
    std::vector<double> whole(static_cast<std::size_t>(count) * static_cast<std::size_t>(my_));
    for (int i = 0; i < count; ++i) {
      const double* t = table.data() + (static_cast<std::ptrdiff_t>(first) + i) * (hy + 1);
      double* r = whole.data() + static_cast<std::ptrdiff_t>(i) * my_;
      for (int j = 0; j <= hy; ++j) r[j] = t[j];
      for (int j = 1; j < hy; ++j) r[my_ - j] = parity_y * t[j];
      if (parity_y < 0) r[0] = r[hy] = 0;
    }
    fft_.rows_forward(whole.data(), count, my_, rows.data() + first * pitch(), pitch());
  });
  for (int i = 0; i <= hx; ++i) {  // the other half, by its parity
    Complex* row = rows.data() + static_cast<std::size_t>(i) * pitch();
    if (i > 0 && i < hx)
      std::transform(row, row + pitch(), rows.data() + static_cast<std::size_t>(mx_ - i) * pitch(),
                     [&](Complex v) { return static_cast<double>(parity_x) * v; });
    else if (parity_x < 0)
      std::fill(row, row + pitch(), 0.0);
  }
  std::vector<double> out(spectrum_size());
  const double scale = 1.0 / (static_cast<double>(mx_) * my_);
  for_each_if(threads_pay(), groups_, [&](int group) {
    Complex* z = fft_scratch<GroupTag>(group_size());
    fft_.columns_forward(rows.data() + first_of(group), pitch(), mx_, z);
    const int columns = std::min(kGroup, width_ - group * kGroup);
    double* o = out.data() + static_cast<std::size_t>(group) * group_size();
    for (int k = 0; k < columns * mx_; ++k) o[k] = scale * (parity_x * parity_y > 0 ? z[k].real() : z[k].imag());
  });
  return out;
}

PlaneFft::Complex* PlaneFft::rows_in(const std::vector<const double*>& in, std::size_t planes) const {
  Complex* work = fft_scratch<WorkTag>(planes * plane_size());
  for_rows(in.size(), nx_, [&](std::size_t plane, std::size_t first, int count) {
    Complex* z = work + plane * plane_size() + first * pitch();
    fft_.rows_forward(in[plane] + first * static_cast<std::size_t>(ny_), count, ny_, z, pitch());
    for (int i = 0; i < count; ++i, z += pitch()) std::fill(z + width_, z + pitch(), 0.0);
  });
  return work;
}

PlaneFft::Complex* PlaneFft::group_buffer(std::size_t planes) const {
  return fft_scratch<GroupTag>(planes * group_size());
}

void PlaneFft::rows_out_of(Complex* work, const std::vector<double*>& out, int rows_out) const {
  for_rows(out.size(), rows_out, [&](std::size_t plane, std::size_t first, int count) {
    fft_.rows_backward(work + plane * plane_size() + first * pitch(), pitch(), count, ny_,
                       out[plane] + first * static_cast<std::size_t>(ny_));
  });
}

}  // namespace railstrata
