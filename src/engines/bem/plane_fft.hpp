#pragma once
// Convolution of zero-padded planes by FFT (fft/fft.hpp), threads over rows and groups of columns, the same bits for
// any number of threads.
//
// A plane of nx x ny values is padded to mx x my. Only its nx rows are transformed along y, the padding never is; the
// transforms along x, the product with the kernel and the transforms back are done group by group of columns, in cache.
#include <algorithm>
#include <complex>
#include <vector>

#include "bem/plane_algebra.hpp"
#include "fft/fft.hpp"

namespace railstrata {

class PlaneFft {
 public:
  /// Pads so that offsets from -nx to nx are free of wrap-around along x, and -(ny-1) to ny-1 along y.
  PlaneFft(int nx, int ny) : PlaneFft(nx, ny, nx, ny) {}
  /// The same for offsets up to reach_x and reach_y - 1, for planes whose inner cells alone carry something; at least
  /// half of nx and ny.
  PlaneFft(int nx, int ny, int reach_x, int reach_y);

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int mx() const { return mx_; }
  int my() const { return my_; }
  /// Values of one kernel's spectrum: index ky mx + kx, ky = 0 … my/2.
  std::size_t spectrum_size() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(mx_); }

  /// Symmetry of a kernel given for offsets >= 0: +1 even, -1 odd in x and in y. Even total parity gives a real
  /// spectrum, odd an imaginary one; the returned numbers are the real or the imaginary part. table[i * (my/2 + 1) +
  /// j], i = 0 … mx/2, j = 0 … my/2. Divided by mx my, so that `multiply` needs no scaling.
  Plane spectrum(const Plane& table, int parity_x, int parity_y) const;
  /// Such a table of a kernel.
  struct KernelTable {
    Plane values;
    int parity_x, parity_y;
    double unit = 1;   ///< a power of two
    bool take_unit();  ///< false: all are zero
  };
  /// The spectra of several: up to four of unlike parities share a transform, and differ from those of `spectrum` by
  /// round-off.
  std::vector<Plane> spectra(std::vector<KernelTable> tables) const;

  /// Entries of several planes' spectra: z[c] points to those of plane c.
  struct Spectra {
    std::complex<double>* first;
    std::size_t apart;
    std::complex<double>* operator[](std::size_t c) const { return first + c * apart; }
  };

  /// in: planes of nx x ny; out: planes of rows_out x ny (rows_out <= nx + 1). Calls multiply(first, count, z) on
  /// `count` = mx consecutive spectrum entries starting at index `first`: z[c] holds input c transformed and is to be
  /// replaced by output c transformed (Spectra). There are max(in, out) planes; those without an input hold anything.
  template <class Multiply>
  void apply(const std::vector<const double*>& in, const std::vector<double*>& out, int rows_out,
             Multiply&& multiply) const {
    const std::size_t planes = in.size() > out.size() ? in.size() : out.size();
    Complex* work = rows_in(in, planes);
    for_each_if(threads_pay(), groups_, [&](int group) {
      const Spectra columns{group_buffer(planes), group_size()};
      for (std::size_t c = 0; c < in.size(); ++c)
        fft_.columns_forward(work + c * plane_size() + first_of(group), pitch(), nx_, columns[c]);
      Spectra z = columns;
      for (int ky = group * kGroup; ky < (group + 1) * kGroup && ky < width_; ++ky, z.first += mx_)
        multiply(static_cast<std::size_t>(ky) * static_cast<std::size_t>(mx_), mx_, z);
      for (std::size_t c = 0; c < out.size(); ++c)
        fft_.columns_backward(columns[c], rows_out, work + c * plane_size() + first_of(group), pitch());
    });
    rows_out_of(work, out, rows_out);
  }

 private:
  using Complex = std::complex<double>;
  static constexpr int kGroup = 4;  // columns copied side by side: a cache line
  /// A plane transformed along y: nx + 1 rows of groups_ * kGroup wave numbers. Planes lie one after the other in a
  /// buffer that the calling thread keeps.
  std::size_t plane_size() const { return static_cast<std::size_t>(nx_ + 1) * pitch(); }
  static std::size_t first_of(int group) { return static_cast<std::size_t>(group) * kGroup; }
  static constexpr int kRows = 8;  // that one call transforms: kiss takes so many side by side
  /// kernel(plane, first row, rows) for pieces of so many planes of `rows` rows.
  template <class Kernel>
  void for_rows(std::size_t planes, int rows, Kernel&& kernel) const {
    const int pieces = (rows + kRows - 1) / kRows;
    for_each_if(threads_pay(), static_cast<std::ptrdiff_t>(planes) * pieces, [&](int k) {
      const int first = k % pieces * kRows;
      kernel(static_cast<std::size_t>(k / pieces), static_cast<std::size_t>(first), std::min(kRows, rows - first));
    });
  }
  std::size_t pitch() const { return static_cast<std::size_t>(groups_) * kGroup; }
  std::size_t group_size() const { return static_cast<std::size_t>(mx_) * kGroup; }
  struct Pack;
  std::vector<Complex> rows_of(const std::vector<KernelTable>& tables, const Pack& pack) const;
  void take_from(const Complex* z, int group, const KernelTable& table, bool packed, Plane& out) const;
  Complex* rows_in(const std::vector<const double*>& in, std::size_t planes) const;
  Complex* group_buffer(std::size_t planes) const;
  void rows_out_of(Complex* work, const std::vector<double*>& out, int rows_out) const;
  bool threads_pay() const { return threads_pay_for(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_)); }

  int nx_, ny_, mx_, my_, width_, groups_;
  Fft fft_;
};

/// The table of a kernel of planes of one column, from its values along x: nothing beside it. columns: my/2 + 1.
template <class Value>
std::vector<Value> in_first_column(const std::vector<Value>& along, int columns) {
  std::vector<Value> table(along.size() * static_cast<std::size_t>(columns));
  for (std::size_t i = 0; i < along.size(); ++i) table[i * static_cast<std::size_t>(columns)] = along[i];
  return table;
}

}  // namespace railstrata
