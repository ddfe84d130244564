#pragma once
// What the machine can do: fused multiply-adds in registers, and memory traffic in as many streams as a step has.
#include <cstddef>
#include <vector>

#include "core/array.hpp"
#include "core/simd.hpp"

namespace railstrata {

/// N dependent chains of fused multiply-adds, every link in a register (an array of packs would be kept in memory).
template <class P, int N>
struct Chains {
  P x = P{} + N;
  Chains<P, N - 1> others;
  void go_on(P m, P c) {
    x = x * m + c;
    asm volatile("" : "+v"(x));
    others.go_on(m, c);
  }
  P sum() const { return x + others.sum(); }
};
template <class P>
struct Chains<P, 0> {
  void go_on(P, P) {}
  P sum() const { return P{}; }
};

inline constexpr int kMultiplyAdds = 12;  ///< chains: enough for two units of four cycles

/// 2 kMultiplyAdds kLanesOf<Real> operations a round.
template <class Real>
void multiply_adds(long rounds) {
  using P = PackOf<Real>;
  Chains<P, kMultiplyAdds> chains;
  const P m = P{} + Real(0.999999), c = P{} + Real(1e-9);
  for (long k = 0; k < rounds; ++k) chains.go_on(m, c);
  P sum = chains.sum();
  asm volatile("" : "+v"(sum));
}
template <class Real>
inline constexpr double kOperationsOfARound = 2.0 * kMultiplyAdds* kLanesOf<Real>;

/// Nodal values as a step moves them, piece by piece: u and v read and written, 1/m read.
struct NodalStreams {
  static constexpr std::ptrdiff_t kPiece = 4096;
  static constexpr double kBytes = 104;  ///< a node
  std::vector<Field> u;
  Field m;
  explicit NodalStreams(std::ptrdiff_t nodes)
      : u(6, Field(static_cast<std::size_t>(nodes), 1.0)), m(static_cast<std::size_t>(nodes), 1e-9) {}
  std::ptrdiff_t pieces() const { return static_cast<std::ptrdiff_t>(m.size()) / kPiece; }
  void move(std::ptrdiff_t piece) {
    for (std::ptrdiff_t i = kPiece * piece; i < kPiece * (piece + 1); ++i)
      for (std::size_t k = 0; k < 3; ++k) u[k][i] += m[i] * (u[k + 3][i] += m[i]);
  }
};

}  // namespace railstrata
