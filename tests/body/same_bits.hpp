#pragma once
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "core/parallel.hpp"

namespace railstrata::fem_checks {

/// What run() gives (a vector of doubles) has the same bits on one, two and four threads.
template <class Run>
void expect_same_bits_on_one_two_and_four_threads(Run run) {
  const int before = max_threads();
  set_threads(1);
  const auto one = run();
  for (int threads : {2, 4}) {
    set_threads(threads);
    const auto many = run();
    EXPECT_TRUE(many.size() == one.size() && std::memcmp(many.data(), one.data(), one.size() * sizeof(double)) == 0)
        << threads;
  }
  set_threads(before);
}

}  // namespace railstrata::fem_checks
