// The C library's heap functions, counted and handed on.
#include "allocation_counter.hpp"

#include <gtest/gtest.h>
#include <link.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <vector>

#include "core/array.hpp"
#include "core/parallel.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define RAILSTRATA_OTHER_HEAP
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define RAILSTRATA_OTHER_HEAP
#endif
#endif

#ifdef RAILSTRATA_OTHER_HEAP

namespace railstrata::fem_checks {
bool allocations_are_counted() { return false; }
Allocations allocations() { return {}; }
}  // namespace railstrata::fem_checks

#else

namespace {

std::atomic<long> own{0}, openmp{0};
std::atomic<std::uintptr_t> openmp_begin{0}, openmp_end{0};  // where the OpenMP library is loaded

int look_for_openmp(dl_phdr_info* info, std::size_t, void*) {
  if (!std::strstr(info->dlpi_name, "libgomp") && !std::strstr(info->dlpi_name, "libomp")) return 0;
  for (int k = 0; k < info->dlpi_phnum; ++k)
    if (const auto& part = info->dlpi_phdr[k]; part.p_type == PT_LOAD && (part.p_flags & PF_X)) {
      openmp_begin = info->dlpi_addr + part.p_vaddr;
      openmp_end = openmp_begin + part.p_memsz;
    }
  return 1;
}

void count(const void* caller) {
  const auto at = reinterpret_cast<std::uintptr_t>(caller);
  (at >= openmp_begin && at < openmp_end ? openmp : own).fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t n) {
  count(__builtin_return_address(0));
  return __libc_malloc(n);
}
void* calloc(std::size_t n, std::size_t size) {
  count(__builtin_return_address(0));
  return __libc_calloc(n, size);
}
void* realloc(void* p, std::size_t n) {
  count(__builtin_return_address(0));
  return __libc_realloc(p, n);
}
void* memalign(std::size_t alignment, std::size_t n) {
  count(__builtin_return_address(0));
  return __libc_memalign(alignment, n);
}
void* aligned_alloc(std::size_t alignment, std::size_t n) {
  count(__builtin_return_address(0));
  return __libc_memalign(alignment, n);
}
int posix_memalign(void** p, std::size_t alignment, std::size_t n) {
  count(__builtin_return_address(0));
  *p = __libc_memalign(alignment, n);
  return *p ? 0 : ENOMEM;
}
}

namespace railstrata::fem_checks {

bool allocations_are_counted() { return true; }

Allocations allocations() {
  if (openmp_end == 0) dl_iterate_phdr(look_for_openmp, nullptr);
  return {own, openmp};
}

}  // namespace railstrata::fem_checks

#endif

namespace railstrata {
namespace {

template <class Allocate>
long asked_by(Allocate&& allocate) {
  const long before = fem_checks::allocations().own;
  allocate();
  return fem_checks::allocations().own - before;
}

}  // namespace

// A counter that saw nothing would find every loop clean.
TEST(AllocationCounter, SeesNewAndAlignedAndLargeFieldsAndOtherThreads) {
  if (!fem_checks::allocations_are_counted()) GTEST_SKIP() << "a sanitizer looks after the heap";
  EXPECT_EQ(asked_by([] {}), 0);
  EXPECT_EQ(asked_by([] { ::operator delete(::operator new(8)); }), 1);
  EXPECT_EQ(asked_by([] { ::operator delete (::operator new (64, std::align_val_t{64}), std::align_val_t{64}); }), 1);
  std::vector<double> plain;
  Field aligned, large;
  EXPECT_EQ(asked_by([&] { plain.assign(100, 1.0); }), 1);
  EXPECT_EQ(asked_by([&] { aligned.assign(100, 1.0); }), 1);
  EXPECT_EQ(asked_by([&] { large.assign(std::size_t{1} << 20, 1.0); }), 1);
  EXPECT_EQ(asked_by([&] { large.assign(std::size_t{1} << 19, 2.0); }), 0);
  std::vector<std::vector<double>> each(8);
  for_each(8, [](std::ptrdiff_t) {});  // the threads are there
  EXPECT_EQ(
      asked_by([&] { for_each(8, [&](std::ptrdiff_t k) { each[static_cast<std::size_t>(k)].assign(10, 1.0); }); }), 8);
}

}  // namespace railstrata
