#pragma once
// Memory that a thread keeps for its transforms.
#include <complex>
#include <cstddef>

#include "fft/fft.hpp"

namespace railstrata {

/// At least n numbers of the calling thread, the same for every use with this tag; they only grow.
template <class Tag>
std::complex<double>* fft_scratch(std::size_t n) {
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

}  // namespace railstrata
