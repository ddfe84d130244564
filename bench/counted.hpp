#pragma once
// A number that counts what is done with it: the laws are templates on the number type, so their arithmetic need not be
// counted by hand.
#include "core/simd.hpp"

namespace railstrata {

struct ArithmeticCount {
  long operations = 0;    ///< + - *
  long instructions = 0;  ///< the same where a product and the sum that takes it are one
};

class Counted {
 public:
  Counted() = default;
  Counted(double) {}
  static ArithmeticCount count;

  friend Counted operator*(const Counted&, const Counted&) {
    ++count.operations;
    ++count.instructions;
    Counted product;
    product.product_ = true;
    return product;
  }
  friend Counted operator+(const Counted& a, const Counted& b) {
    ++count.operations;
    if (!a.product_ && !b.product_) ++count.instructions;
    return {};
  }
  friend Counted operator-(const Counted& a, const Counted& b) { return a + b; }
  Counted operator-() const { return *this; }  // the compiler takes it into the sum that follows
  Counted& operator+=(const Counted& o) { return *this = *this + o; }
  Counted& operator-=(const Counted& o) { return *this = *this + o; }
  Counted& operator*=(const Counted& o) { return *this = *this * o; }

 private:
  bool product_ = false;
};
inline ArithmeticCount Counted::count;

template <>
struct ScalarType<Counted> {
  using type = double;
};

}  // namespace railstrata
