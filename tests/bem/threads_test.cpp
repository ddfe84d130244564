#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "half_space_pair.hpp"

namespace railstrata {
namespace {

TEST(Threads, OneTwoAndThreeGiveTheSameBits) {
  const PatchGrid g = centred_grid(58, 58, 0.125e-3, 0.125e-3);
  ASSERT_TRUE(threads_pay_for(g.size()));
  const InfluenceOperator op(pair_of(kSteel, {100e9, 0.2}), g.nx, g.ny, g.dx, g.dy);
  Plane p[3], ux[3], uy[3];
  double total[3];
  const int before = max_threads();
  for (int t = 0; t < 3; ++t) {
    set_threads(t + 1);
    p[t] = solve_normal(op, g, quadratic_gap(g, 1.2, 1.2), {.load = 8e4, .approach = {}}).pressure;
    ux[t].resize(g.size()), uy[t].resize(g.size());
    op.tangential(p[t].data(), p[t].data(), ux[t].data(), uy[t].data(), g.nx);
    Plane many(200000);
    for (std::size_t i = 0; i < many.size(); ++i) many[i] = std::sin(static_cast<double>(i));
    add_scaled(many, 0.3, many);
    total[t] = dot(many, many) + sum(many);
  }
  set_threads(before);
  for (int t : {1, 2}) {
    EXPECT_EQ(p[t], p[0]);
    EXPECT_EQ(ux[t], ux[0]);
    EXPECT_EQ(uy[t], uy[0]);
    EXPECT_EQ(total[t], total[0]);
  }
}

}  // namespace
}  // namespace railstrata
