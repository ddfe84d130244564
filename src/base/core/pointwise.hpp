#pragma once
// Declaration macro of functions for host and device.

/// In front of every pointwise function (laws and elements): inline, and for host and device where nvcc reads it.
/// RAILSTRATA_UNROLL stands in front of a short loop of a law: packs stay in registers only if the compiler takes the
/// loop apart, and it shies away from long bodies.
#ifdef __CUDACC__
#define RAILSTRATA_POINTWISE inline __host__ __device__
#define RAILSTRATA_UNROLL _Pragma("unroll")
#else
#define RAILSTRATA_POINTWISE inline
#define RAILSTRATA_UNROLL _Pragma("GCC unroll 16")
#endif
