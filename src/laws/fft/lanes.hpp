#pragma once
// Four numbers that go through the same computation side by side, as the scalar of a template: two registers of 128
// bits, which x86, Arm and WebAssembly all have.
#include <complex>
#include <cstring>

namespace railstrata {

class Lanes {
  using Two = double __attribute__((vector_size(16)));

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

  using Complex = std::complex<double>;
  /// Four complex numbers, each in its lane, and back.
  static std::complex<Lanes> side_by_side(const Complex& a, const Complex& b, const Complex& c, const Complex& d) {
    const Two p = pair(a), q = pair(b), r = pair(c), s = pair(d);
    return {Lanes(__builtin_shufflevector(p, q, 0, 2), __builtin_shufflevector(r, s, 0, 2)),
            Lanes(__builtin_shufflevector(p, q, 1, 3), __builtin_shufflevector(r, s, 1, 3))};
  }
  static void apart(const std::complex<Lanes>& z, Complex& a, Complex& b, Complex& c, Complex& d) {
    const Lanes re = z.real(), im = z.imag();
    put(__builtin_shufflevector(re.low_, im.low_, 0, 2), a);
    put(__builtin_shufflevector(re.low_, im.low_, 1, 3), b);
    put(__builtin_shufflevector(re.high_, im.high_, 0, 2), c);
    put(__builtin_shufflevector(re.high_, im.high_, 1, 3), d);
  }

  // Required by the library's product of complex numbers, which corrects infinities; none occur here.
  friend bool isnan(Lanes) { return false; }
  friend bool isinf(Lanes) { return false; }
  friend Lanes copysign(Lanes size, Lanes) { return size; }

 private:
  Lanes(Two low, Two high) : low_(low), high_(high) {}
  static Two pair(const Complex& z) {
    Two out;
    std::memcpy(&out, &z, sizeof out);
    return out;
  }
  static void put(Two pair, Complex& z) { std::memcpy(static_cast<void*>(&z), &pair, sizeof pair); }
  Two low_, high_;
};

}  // namespace railstrata
