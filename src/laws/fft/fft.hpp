#pragma once
// Fourier transforms of rows, of groups of columns and of planes: the one place that knows whose FFT it is. Two of
// them:
//
//   kiss   kiss FFT as Eigen has it, under MPL-2 and BSD: the default, and what is passed on
//   fftw   FFTW [FrigoJohnson2005], two to six times faster. Under the GNU GPL: whoever passes on a binary with it
//          passes that on under the GPL too
//
// The build chooses (-DRAILSTRATA_FFT). Transforms are not scaled; each has the same bits every time.
#include <complex>
#include <cstddef>
#include <memory>

namespace railstrata {

/// Smallest good length >= n, even. The same for all of them: lengths are periods, which show in results.
int good_fft_length(int n);

/// Numbers aligned as transforms like it, from malloc's kind of memory; null frees nothing.
std::complex<double>* fft_alloc(std::size_t n);
void fft_free(std::complex<double>* numbers);

/// Transforms of one pair of lengths. Any number of threads may use one at a time, each with arrays of its own. An
/// output must not overlap the input.
class Fft {
 public:
  /// rows: length of the real rows, even; columns: of the complex columns, which come `together` at a time.
  Fft(int rows, int columns, int together);
  ~Fft();
  Fft(const Fft&) = delete;
  Fft& operator=(const Fft&) = delete;

  /// `count` rows of `given` real numbers, one after the other and zero beyond -> rows/2 + 1 complex ones each, `pitch`
  /// apart; and the first `given` real numbers of each back (times rows). Waves may be changed on the way back.
  void rows_forward(const double* reals, int count, int given, std::complex<double>* waves, std::size_t pitch) const;
  void rows_backward(std::complex<double>* waves, std::size_t pitch, int count, int given, double* reals) const;
  /// `together` columns side by side in `count` rows `pitch` apart, zero beyond -> columns one after the other; and the
  /// first `count` rows back (times columns). Columns may be changed on the way back.
  void columns_forward(const std::complex<double>* rows, std::size_t pitch, int count,
                       std::complex<double>* columns) const;
  void columns_backward(std::complex<double>* columns, int count, std::complex<double>* rows, std::size_t pitch) const;

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
};

/// Transforms of a real plane, nx rows of ny numbers, any lengths; threads and memory as Fft's.
class RealPlaneFft {
 public:
  RealPlaneFft(int nx, int ny);
  ~RealPlaneFft();
  RealPlaneFft(const RealPlaneFft&) = delete;
  RealPlaneFft& operator=(const RealPlaneFft&) = delete;

  /// nx rows of ny numbers -> nx rows of ny/2 + 1 complex ones, and back (times nx ny). Neither needs an alignment.
  void forward(const double* plane, std::complex<double>* waves) const;
  /// Changes `waves`.
  void backward(std::complex<double>* waves, double* plane) const;

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
};

}  // namespace railstrata
