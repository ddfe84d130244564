#pragma once
// Convolution of zero-padded planes by FFT (FFTW), threads over rows and column blocks, the same bits for any number of threads.
//
// A plane of nx x ny values is padded to mx x my. Only its nx rows are transformed along y, the padding never is; the transforms along x, the product with the kernel
// and the transforms back are done block by block of columns, in cache.
#include <complex>
#include <memory>
#include <vector>

#include "bem/plane_algebra.hpp"

namespace railstrata {

class PlaneFft {
 public:
  static constexpr int kBlock = 8;  ///< columns of wave numbers per block

  /// Pads so that offsets from -nx to nx are free of wrap-around along x, and -(ny-1) to ny-1 along y.
  PlaneFft(int nx, int ny);
  ~PlaneFft();
  PlaneFft(const PlaneFft&) = delete;
  PlaneFft& operator=(const PlaneFft&) = delete;

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int mx() const { return mx_; }
  int my() const { return my_; }
  int blocks() const { return blocks_; }
  /// Values of one kernel's spectrum: index (block * mx + kx) * kBlock + column.
  std::size_t spectrum_size() const { return static_cast<std::size_t>(blocks_) * static_cast<std::size_t>(mx_) * kBlock; }

  /// Symmetry of a kernel given for offsets >= 0: +1 even, -1 odd in x and in y. Even total parity gives a real spectrum, odd an imaginary one; the returned numbers
  /// are the real or the imaginary part. table[i * (my/2 + 1) + j], i = 0 … mx/2, j = 0 … my/2. Divided by mx my, so that `multiply` needs no scaling.
  std::vector<double> spectrum(const std::vector<double>& table, int parity_x, int parity_y) const;

  /// in: planes of nx x ny; out: planes of rows_out x ny (rows_out <= nx + 1). Calls multiply(first, count, z) on `count` consecutive spectrum entries starting at
  /// index `first`: z[c] holds input c transformed and is to be replaced by output c transformed. There are max(in, out) planes; those without an input hold anything.
  template <class Multiply>
  void apply(const std::vector<const double*>& in, const std::vector<double*>& out, int rows_out, Multiply&& multiply) const {
    std::vector<Spectrum> work = rows_in(in, out.size());
    const int count = mx_ * kBlock;
    for_blocks([&](int block) {
      std::vector<std::complex<double>*> z(work.size());
      for (std::size_t c = 0; c < z.size(); ++c) z[c] = block_buffer(work.size()) + c * static_cast<std::size_t>(count);
      for (std::size_t c = 0; c < in.size(); ++c) columns_in(work[c], block, z[c]);
      multiply(static_cast<std::size_t>(block) * static_cast<std::size_t>(count), count, z.data());
      for (std::size_t c = 0; c < out.size(); ++c) columns_out(work[c], block, z[c], rows_out);
    });
    rows_out_of(work, out, rows_out);
  }

 private:
  struct Plans;
  using Spectrum = std::vector<std::complex<double>>;  // transformed along y: rows of blocks_ * kBlock wave numbers
  std::vector<Spectrum> rows_in(const std::vector<const double*>& in, std::size_t outputs) const;
  std::complex<double>* block_buffer(std::size_t planes) const;
  void columns_in(const Spectrum& rows, int block, std::complex<double>* z) const;
  void columns_out(Spectrum& rows, int block, std::complex<double>* z, int rows_out) const;
  void rows_out_of(const std::vector<Spectrum>& work, const std::vector<double*>& out, int rows_out) const;
  template <class Body>
  void for_blocks(Body&& body) const {
    for_each_if(threads_pay(), blocks_, body);
  }
  bool threads_pay() const { return threads_pay_for(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_)); }

  int nx_, ny_, mx_, my_, width_, blocks_;
  std::unique_ptr<Plans> plans_;
};

}  // namespace railstrata
