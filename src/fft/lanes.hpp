#pragma once
// Four numbers that go through the same computation side by side, as the scalar of a template: two registers of 128
// bits, which x86, Arm and WebAssembly all have.

namespace railstrata {

class Lanes {
 public:
  static constexpr int kCount = 4;
  Lanes() = default;
  Lanes(double all) : low_{all, all}, high_{all, all} {}  // NOLINT(google-explicit-constructor): a number for all
  Lanes(double a, double b, double c, double d) : low_{a, b}, high_{c, d} {}
  double operator[](int lane) const { return lane < 2 ? low_[lane] : high_[lane - 2]; }

  friend Lanes operator+(Lanes a, Lanes b) { return {a.low_ + b.low_, a.high_ + b.high_}; }
  friend Lanes operator-(Lanes a, Lanes b) { return {a.low_ - b.low_, a.high_ - b.high_}; }
  friend Lanes operator*(Lanes a, Lanes b) { return {a.low_ * b.low_, a.high_ * b.high_}; }
  friend Lanes operator-(Lanes a) { return {-a.low_, -a.high_}; }
  Lanes& operator+=(Lanes b) { return *this = *this + b; }
  Lanes& operator-=(Lanes b) { return *this = *this - b; }
  Lanes& operator*=(Lanes b) { return *this = *this * b; }

  // What a library's product of complex numbers asks of its scalar, to mend infinities: there are none to be mended.
  friend bool isnan(Lanes) { return false; }
  friend bool isinf(Lanes) { return false; }
  friend Lanes copysign(Lanes size, Lanes) { return size; }

 private:
  using Two = double __attribute__((vector_size(16)));
  Lanes(Two low, Two high) : low_(low), high_(high) {}
  Two low_, high_;
};

}  // namespace railstrata
