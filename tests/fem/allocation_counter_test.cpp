// The C library's heap functions, counted and handed on.
#include "allocation_counter.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <cstddef>

#include "core/array.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define RAILSTRATA_OTHER_HEAP
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define RAILSTRATA_OTHER_HEAP
#endif
#endif

namespace {
std::atomic<long> count{0};
}

#if defined(__GLIBC__) && !defined(RAILSTRATA_OTHER_HEAP)
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t n) {
  count.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(n);
}
void* calloc(std::size_t n, std::size_t size) {
  count.fetch_add(1, std::memory_order_relaxed);
  return __libc_calloc(n, size);
}
void* realloc(void* p, std::size_t n) {
  count.fetch_add(1, std::memory_order_relaxed);
  return __libc_realloc(p, n);
}
void* memalign(std::size_t alignment, std::size_t n) {
  count.fetch_add(1, std::memory_order_relaxed);
  return __libc_memalign(alignment, n);
}
void* aligned_alloc(std::size_t alignment, std::size_t n) { return memalign(alignment, n); }
int posix_memalign(void** p, std::size_t alignment, std::size_t n) {
  *p = memalign(alignment, n);
  return *p ? 0 : ENOMEM;
}
}
namespace railstrata::fem_checks {
bool allocations_are_counted() { return true; }
}  // namespace railstrata::fem_checks
#else
namespace railstrata::fem_checks {
bool allocations_are_counted() { return false; }
}  // namespace railstrata::fem_checks
#endif

namespace railstrata {
namespace fem_checks {
long allocations() { return count; }
}  // namespace fem_checks

// A counter that saw nothing would find every loop clean.
TEST(AllocationCounter, SeesNewAndAlignedAndLargeFieldsAndOtherThreads) {
  if (!fem_checks::allocations_are_counted()) GTEST_SKIP() << "a sanitizer looks after the heap";
  const auto asked = [](auto&& allocate) {
    const long before = fem_checks::allocations();
    allocate();
    return fem_checks::allocations() - before;
  };
  EXPECT_EQ(asked([] {}), 0);
  EXPECT_EQ(asked([] { delete new std::vector<int>(); }), 1);
  EXPECT_EQ(asked([] { std::vector<double> v(100, 1.0); }), 1);
  EXPECT_EQ(asked([] { Field small(100, 1.0); }), 1);
  EXPECT_EQ(asked([] { Field large(std::size_t{1} << 20, 1.0); }), 1);
  const long before = fem_checks::allocations();
#pragma omp parallel num_threads(2)
  { std::vector<double> mine(100, 1.0); }
  EXPECT_GE(fem_checks::allocations() - before, 2);
}

}  // namespace railstrata
