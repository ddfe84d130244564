#include "core/simd.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

template <class T>
void expect_roots_of_scalars() {
  using Real = ScalarOf<T>;
  constexpr int kCount = static_cast<int>(sizeof(T) / sizeof(Real));
  T x{};
  for (int l = 0; l < kCount; ++l) x[l] = Real(0.7) * static_cast<Real>(l);
  const T root = square_root(x);
  for (int l = 0; l < kCount; ++l) EXPECT_EQ(root[l], std::sqrt(x[l])) << l;
}

TEST(SquareRoot, OfAPackIsThatOfEveryLane) {
  EXPECT_EQ(square_root(2.25), 1.5);
  EXPECT_EQ(square_root(2.25F), 1.5F);
  expect_roots_of_scalars<Pack>();
  expect_roots_of_scalars<PackOf<float>>();
}

}  // namespace
}  // namespace railstrata
