#pragma once
// The SIMD pack: a vector of doubles as wide as the machine's registers, with + - * / and mixed scalar operations from the compiler's vector extension.
// Laws are templates on the number type and take double or Pack alike.
#include <cstddef>
#include <cstring>

namespace railstrata {

#if defined(__AVX512F__)
inline constexpr int kLanes = 8;
#elif defined(__AVX__)
inline constexpr int kLanes = 4;
#else
inline constexpr int kLanes = 2;
#endif

typedef double Pack __attribute__((vector_size(kLanes * sizeof(double))));

inline Pack load(const double* p) {
  Pack v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void store(double* p, Pack v) { std::memcpy(p, &v, sizeof v); }

/// {before[last], now[0], now[1], …}: moves a line of values on by one lane.
inline Pack shift_in(Pack before, Pack now) {
#if defined(__clang__) && defined(__AVX512F__)
  return __builtin_shufflevector(before, now, 7, 8, 9, 10, 11, 12, 13, 14);
#elif defined(__clang__) && defined(__AVX__)
  return __builtin_shufflevector(before, now, 3, 4, 5, 6);
#elif defined(__clang__)
  return __builtin_shufflevector(before, now, 1, 2);
#else
  typedef long long Index __attribute__((vector_size(kLanes * sizeof(long long))));
  Index index;
  for (int i = 0; i < kLanes; ++i) index[i] = kLanes - 1 + i;
  return __builtin_shuffle(before, now, index);
#endif
}

/// n rounded up to whole packs.
constexpr int whole_packs(int n) { return (n + kLanes - 1) / kLanes * kLanes; }

}  // namespace railstrata
