#pragma once
// Where a value lies among ascending ones.
#include <vector>

namespace railstrata {

/// The interval of ascending values that holds one, and how far in it; ends stand for what is beyond.
struct Interval {
  int low = 0, high = 0;
  double share = 0;
  template <class T>
  T of(const T& a, const T& b) const {
    return (1 - share) * a + share * b;
  }
};
Interval interval_of(const std::vector<double>& of, double value);

}  // namespace railstrata
