#pragma once
// Arrays aligned for SIMD loads.
#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

#include <cstddef>
#include <new>
#include <vector>

namespace railstrata {

/// Bytes.
inline constexpr std::size_t kHugePage = std::size_t{2} << 20;

/// Asks the system for large pages: a sweep over the lines of a body reaches a new page with nearly every one. The
/// system may ignore it; Windows gives them to those with a privilege of their own.
inline void prefer_huge_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  madvise(begin, bytes, MADV_HUGEPAGE);
#endif
}

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) {
    T* p = static_cast<T*>(::operator new(n * sizeof(T), alignment(n)));
    if (n * sizeof(T) >= kHugePage) prefer_huge_pages(p, n * sizeof(T));
    return p;
  }
  void deallocate(T* p, std::size_t n) { ::operator delete(p, alignment(n)); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }

 private:
  static constexpr std::align_val_t alignment(std::size_t n) {
    return std::align_val_t{n * sizeof(T) >= kHugePage ? kHugePage : 64};
  }
};

/// One number per degree of freedom (or per station); mesh/layout.hpp defines the index.
using Field = std::vector<double, CacheLineAllocator<double>>;

/// Lines of memory that will be wanted soon. They are asked for in pieces, between other work: a burst of requests
/// would wait for the few that a core can have open.
class Prefetch {
 public:
  void clear() { count_ = 0; }
  /// A line more; forgotten when there are too many.
  void add(const double* line) {
    if (count_ < kMost) line_[count_++] = line;
  }
  /// Asks for the values first <= i < end of every line.
  void ask(int first, int end) const {
    for (int i = first; i < end; i += kCacheLine)
      for (int k = 0; k < count_; ++k) __builtin_prefetch(line_[k] + i);
  }

 private:
  static constexpr int kMost = 32, kCacheLine = 64 / sizeof(double);
  const double* line_[kMost];
  int count_ = 0;
};

}  // namespace railstrata
