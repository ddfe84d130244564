#include "fft/fft.hpp"

namespace railstrata {

/// Lengths that FFTW's estimated plans transform well: about 1.2 ns a point where their neighbours, with more threes,
/// take 2 to 3. The other transforms take the same, so that the periods, and what periodic images leave in a stress
/// below layers, are those of the program.
int good_fft_length(int n) {
  for (int length : {8,   10,  12,  14,  16,  20,  24,  28,  32,  40,  48,  56,  64,  72,  80,  96,  100, 112, 120,
                     128, 140, 160, 200, 224, 240, 256, 280, 320, 400, 448, 512, 640, 768, 800, 896, 960, 1024})
    if (length >= n) return length;
  for (int m = n + (n & 1);; m += 2) {
    int r = m;
    while (r % 2 == 0) r /= 2;
    if (r == 1 || r == 3 || r == 5 || r == 7 || r == 15 || r == 25) return m;
  }
}

}  // namespace railstrata
