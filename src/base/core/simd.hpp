#pragma once
// The SIMD pack: a vector as wide as the machine's registers, with + - * / and mixed scalar operations from the
// compiler's vector extension. Laws are templates on the number type and take a scalar or a pack alike.
//
// Functions that depend on the width are in a namespace named after it, so that the same function of two instruction
// sets is two functions to the linker: the installed library holds rooms of both (cmake/rooms.cmake).
#include <cmath>
#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

#include "core/pointwise.hpp"

namespace railstrata {

#ifndef __CUDACC__  // a thread of a device computes with numbers; no layout that nvcc sees depends on packs
#if defined(__AVX512F__)
#define RAILSTRATA_PACKS packs_of_64_bytes
inline constexpr int kPackBytes = 64;
#elif defined(__AVX__)
#define RAILSTRATA_PACKS packs_of_32_bytes
inline constexpr int kPackBytes = 32;
#else
#define RAILSTRATA_PACKS packs_of_16_bytes
inline constexpr int kPackBytes = 16;
#endif
inline namespace RAILSTRATA_PACKS {

template <class Real>
struct PackType {
  typedef Real type __attribute__((vector_size(kPackBytes)));
};
template <class Real>
using PackOf = typename PackType<Real>::type;
template <class Real>
inline constexpr int kLanesOf = kPackBytes / static_cast<int>(sizeof(Real));
}  // namespace RAILSTRATA_PACKS
#endif

/// The number type of a scalar or a pack.
template <class T>
struct ScalarType {
  using type = std::remove_cvref_t<decltype(std::declval<T&>()[0])>;
};
template <>
struct ScalarType<double> {
  using type = double;
};
template <>
struct ScalarType<float> {
  using type = float;
};
template <class T>
using ScalarOf = typename ScalarType<T>::type;

#ifndef __CUDACC__
inline namespace RAILSTRATA_PACKS {
using Pack = PackOf<double>;
inline constexpr int kLanes = kLanesOf<double>;

template <class Real>
inline PackOf<Real> load(const Real* p) {
  PackOf<Real> v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void store(double* p, Pack v) { std::memcpy(p, &v, sizeof v); }
inline void store(float* p, PackOf<float> v) { std::memcpy(p, &v, sizeof v); }
}  // namespace RAILSTRATA_PACKS
#endif

/// Square root of a scalar, or of every lane of a pack. To choose between two values a law writes `a > b ? x : y`,
/// which packs do lane by lane.
template <class T>
RAILSTRATA_POINTWISE T square_root(const T& x) {
  if constexpr (std::is_floating_point_v<T>) {
    return std::sqrt(x);
  } else {
    T root;
    RAILSTRATA_UNROLL
    for (int l = 0; l < static_cast<int>(sizeof(T) / sizeof(ScalarOf<T>)); ++l) root[l] = std::sqrt(x[l]);
    return root;
  }
}

#ifndef __CUDACC__
inline namespace RAILSTRATA_PACKS {
/// The lower lanes of one pack and the upper ones of another.
template <class P>
inline P halves(P lower, P upper) {
  constexpr int lanes = static_cast<int>(sizeof(P) / sizeof(lower[0]));
  return [&]<int... I>(std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(lower, upper, (I < lanes / 2 ? I : lanes + I)...);
  }
  (std::make_integer_sequence<int, lanes>{});
}

/// n rounded up to whole packs of doubles.
constexpr int whole_packs(int n) { return (n + kLanes - 1) / kLanes * kLanes; }
}  // namespace RAILSTRATA_PACKS

/// The instruction set that the rooms which compute are compiled for, e.g. "AVX-512, 8 doubles a vector".
std::string instruction_set();
#endif

}  // namespace railstrata
