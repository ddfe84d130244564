// Several right sides in one Krylov space.
#include <gtest/gtest.h>

#include <cmath>

#include "bem/gmres.hpp"

namespace railstrata {
namespace {

constexpr std::size_t kSize = 40;

/// Not symmetric: 2 + i/10 on the diagonal, -1 before it, 0.5 behind it.
void apply(const Plane& in, Plane& out) {
  for (std::size_t i = 0; i < kSize; ++i)
    out[i] =
        (2 + 0.1 * static_cast<double>(i)) * in[i] - (i > 0 ? in[i - 1] : 0) + 0.5 * (i + 1 < kSize ? in[i + 1] : 0);
}
void as_it_is(const Plane& in, Plane& out) { out = in; }

double residual(const Plane& b, const Plane& x) {
  Plane image(kSize);
  apply(x, image);
  add_scaled(image, -1, b);
  return std::sqrt(dot(image, image) / dot(b, b));
}

TEST(RecycledKrylov, SolvesEachRightSideAndSearchesOnceWhatTheyShare) {
  Plane one(kSize), other(kSize), sum(kSize), x;
  for (std::size_t i = 0; i < kSize; ++i) {
    one[i] = std::sin(0.3 * static_cast<double>(i));
    other[i] = std::cos(0.7 * static_cast<double>(i));
    sum[i] = one[i] - 3 * other[i];
  }
  RecycledKrylov space;
  space.solve(apply, as_it_is, one, x, 1e-8 * std::sqrt(dot(one, one)));
  EXPECT_LT(residual(one, x), 1.01e-8);
  const std::size_t first = space.directions();
  EXPECT_GT(first, 5u);
  space.solve(apply, as_it_is, other, x, 1e-8 * std::sqrt(dot(other, other)));
  EXPECT_LT(residual(other, x), 1.01e-8);
  const std::size_t second = space.directions();
  EXPECT_LT(second, 2 * first);
  space.solve(apply, as_it_is, sum, x, 1e-7 * std::sqrt(dot(sum, sum)));
  EXPECT_LT(residual(sum, x), 1.01e-7);
  EXPECT_EQ(space.directions(), second);
}

TEST(RecycledKrylov, HasZeroForNothing) {
  RecycledKrylov space;
  Plane x;
  space.solve(apply, as_it_is, Plane(kSize, 0.0), x, 1e-8);
  EXPECT_EQ(x, Plane(kSize, 0.0));
  EXPECT_EQ(space.directions(), 0u);
}

}  // namespace
}  // namespace railstrata
