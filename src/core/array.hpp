#pragma once
// Arrays aligned for SIMD loads.
#include <cstddef>
#include <new>
#include <vector>

namespace railstrata {

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t{64})); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, std::align_val_t{64}); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

/// One number per degree of freedom (or per station); how it is indexed is told by mesh/layout.hpp.
using Field = std::vector<double, CacheLineAllocator<double>>;

/// Asks for n values to be brought into cache.
inline void fetch(const double* p, std::ptrdiff_t n) {
  for (std::ptrdiff_t i = 0; i < n; i += 8) __builtin_prefetch(p + i);
}

}  // namespace railstrata
