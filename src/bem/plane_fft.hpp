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

  /// in: planes of nx x ny; out: planes of rows_out x ny (rows_out <= nx + 1). Calls multiply(first, count, a, b) on `count` consecutive spectrum entries starting at
  /// index `first`: a (and b) hold the transformed inputs and are to be replaced by the transformed outputs; b is null when there is one input and one output.
  template <class Multiply>
  void apply(std::vector<const double*> in, std::vector<double*> out, int rows_out, Multiply&& multiply) const {
    const std::size_t planes = in.size() > out.size() ? in.size() : out.size();
    Work work = begin(in);
    for_blocks([&](int block) {
      std::complex<double>* a = columns_in(work, block, 0, in.size() > 0);
      std::complex<double>* b = planes > 1 ? columns_in(work, block, 1, in.size() > 1) : nullptr;
      multiply(static_cast<std::size_t>(block) * static_cast<std::size_t>(mx_) * kBlock, mx_ * kBlock, a, b);
      for (std::size_t c = 0; c < out.size(); ++c) columns_out(work, block, static_cast<int>(c), rows_out);
    });
    end(work, out, rows_out);
  }

 private:
  struct Plans;
  struct Work {
    std::vector<std::complex<double>> spectra[2];
    int rows_in = 0;
  };
  Work begin(const std::vector<const double*>& in) const;
  std::complex<double>* columns_in(const Work& work, int block, int plane, bool present) const;
  void columns_out(Work& work, int block, int plane, int rows_out) const;
  void end(const Work& work, const std::vector<double*>& out, int rows_out) const;
  template <class Body>
  void for_blocks(Body&& body) const {
    for_each_if(threads_pay(), blocks_, body);
  }
  bool threads_pay() const { return threads_pay_for(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_)); }

  int nx_, ny_, mx_, my_, width_, blocks_;
  std::unique_ptr<Plans> plans_;
};

}  // namespace railstrata
