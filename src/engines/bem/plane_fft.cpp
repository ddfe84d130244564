#include "bem/plane_fft.hpp"

#include <array>
#include <cmath>
#include <utility>

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

/// Tables of one transform, at most one of each pair of parities: index (odd in x) + 2 (odd in y); -1: none.
struct PlaneFft::Pack {
  std::array<int, 4> table{-1, -1, -1, -1};
  int tables() const {
    return static_cast<int>(std::count_if(table.begin(), table.end(), [](int t) { return t >= 0; }));
  }
};

/// Tables that share a transform have values of the same size, else the round-off of large ones drowns small ones.
bool PlaneFft::KernelTable::take_unit() {
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  if (!(largest > 0)) return false;
  unit = std::exp2(std::ilogb(largest));
  for (double& v : values) v /= unit;
  return true;
}

Plane PlaneFft::spectrum(const Plane& table, int parity_x, int parity_y) const {
  return std::move(spectra({{table, parity_x, parity_y}}).front());
}

std::vector<Plane> PlaneFft::spectra(std::vector<KernelTable> tables) const {
  std::vector<Pack> packs;
  for (std::size_t t = 0; t < tables.size(); ++t) {
    if (!tables[t].take_unit()) continue;  // round-off would be left of nothing
    const std::size_t place = (tables[t].parity_x < 0) + 2 * (tables[t].parity_y < 0);
    auto pack = std::find_if(packs.begin(), packs.end(), [&](const Pack& p) { return p.table[place] < 0; });
    if (pack == packs.end()) pack = packs.emplace(packs.end());
    pack->table[place] = static_cast<int>(t);
  }
  std::vector<Plane> out(tables.size(), Plane(spectrum_size()));
  for (const Pack& pack : packs) {
    const std::vector<Complex> rows = rows_of(tables, pack);
    for_each_if(threads_pay(), groups_, [&](int group) {
      Complex* z = fft_scratch<GroupTag>(group_size());
      fft_.columns_forward(rows.data() + first_of(group), pitch(), mx_, z);
      for (int t : pack.table)
        if (t >= 0)
          take_from(z, group, tables[static_cast<std::size_t>(t)], pack.tables() > 1, out[static_cast<std::size_t>(t)]);
    });
  }
  return out;
}

/// The sum of the tables of a pack, transformed along y. Waves of an even row are real, those of an odd one imaginary,
/// so that one real row carries one of each.
std::vector<PlaneFft::Complex> PlaneFft::rows_of(const std::vector<KernelTable>& tables, const Pack& pack) const {
  const int hx = mx_ / 2, hy = my_ / 2;
  std::vector<Complex> out(static_cast<std::size_t>(mx_) * pitch()), odd_in_x;
  const auto values = [&](int place) {
    const int t = pack.table[static_cast<std::size_t>(place)];
    return t < 0 ? nullptr : tables[static_cast<std::size_t>(t)].values.data();
  };
  const auto transform = [&](const double* even, const double* odd, std::vector<Complex>& rows) {
    for_rows(1, hx + 1, [&](std::size_t, std::size_t first, int count) {
      std::vector<double> whole(static_cast<std::size_t>(count) * static_cast<std::size_t>(my_), 0.0);
      for (int i = 0; i < count; ++i) {
        const std::ptrdiff_t row = (static_cast<std::ptrdiff_t>(first) + i) * (hy + 1);
        double* r = whole.data() + static_cast<std::ptrdiff_t>(i) * my_;
        for (int j = 0; even && j <= hy; ++j) r[j] = even[row + j];
        for (int j = 1; j < hy; ++j) {
          const double o = odd ? odd[row + j] : 0, e = r[j];
          r[j] = e + o;
          r[my_ - j] = e - o;
        }
      }
      fft_.rows_forward(whole.data(), count, my_, rows.data() + first * pitch(), pitch());
    });
  };
  if (values(0) || values(2)) transform(values(0), values(2), out);
  if (values(1) || values(3)) {
    odd_in_x.resize(static_cast<std::size_t>(hx + 1) * pitch());
    transform(values(1), values(3), odd_in_x);
  }
  for (int i = 1; i < hx; ++i) {  // the other half, by its parity; in the middle and at the end odd ones are zero
    Complex *row = out.data() + static_cast<std::size_t>(i) * pitch(),
            *mirror = out.data() + static_cast<std::size_t>(mx_ - i) * pitch();
    std::copy_n(row, pitch(), mirror);
    if (odd_in_x.empty()) continue;
    const Complex* odd = odd_in_x.data() + static_cast<std::size_t>(i) * pitch();
    for (std::size_t k = 0; k < pitch(); ++k) {
      row[k] += odd[k];
      mirror[k] -= odd[k];
    }
  }
  return out;
}

/// The spectrum of one table of a pack from a group of the pack's columns: of a table even in x what is the same at a
/// wave number and its negative, of an odd one what changes its sign; real where both parities agree, else imaginary.
void PlaneFft::take_from(const Complex* z, int group, const KernelTable& table, bool packed, Plane& out) const {
  const double scale = table.unit / (static_cast<double>(mx_) * my_);
  const int columns = std::min(kGroup, width_ - group * kGroup);
  const bool real = table.parity_x * table.parity_y > 0;
  double* o = out.data() + static_cast<std::size_t>(group) * group_size();
  for (int c = 0; c < columns; ++c, z += mx_, o += mx_)
    for (int k = 0; k < mx_; ++k) {
      const Complex& mirror = z[k == 0 ? 0 : mx_ - k];
      const Complex own = packed ? 0.5 * (z[k] + static_cast<double>(table.parity_x) * mirror) : z[k];
      o[k] = scale * (real ? own.real() : own.imag());
    }
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
