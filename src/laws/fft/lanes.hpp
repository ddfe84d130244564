#pragma once
// Four numbers that go through the same computation side by side, as the scalar of a template: two registers of 128
// bits, which x86, Arm and WebAssembly all have.
#include <complex>
#include <cstring>

namespace railstrata {

class Lanes {
  using Two = double __attribute__((vector_size(16)));
  using All = double __attribute__((vector_size(32)));

 public:
  static constexpr int kCount = 4;
  Lanes() = default;
  Lanes(double all) : all_{all, all, all, all} {}  // NOLINT(google-explicit-constructor): a number for all
  Lanes(double a, double b, double c, double d) : all_{a, b, c, d} {}
  double operator[](int lane) const { return all_[lane]; }

  friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.all_ + b.all_); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.all_ - b.all_); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.all_ * b.all_); }
  friend Lanes operator-(const Lanes& a) { return Lanes(-a.all_); }
  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  Lanes& operator-=(const Lanes& b) { return *this = *this - b; }
  Lanes& operator*=(const Lanes& b) { return *this = *this * b; }

  using Complex = std::complex<double>;
  /// Four complex numbers, each in its lane, and back.
  static std::complex<Lanes> side_by_side(const Complex& a, const Complex& b, const Complex& c, const Complex& d) {
    const Two p = pair(a), q = pair(b), r = pair(c), s = pair(d);
    const All pq = __builtin_shufflevector(p, q, 0, 2, 1, 3), rs = __builtin_shufflevector(r, s, 0, 2, 1, 3);
    return {Lanes(__builtin_shufflevector(pq, rs, 0, 1, 4, 5)), Lanes(__builtin_shufflevector(pq, rs, 2, 3, 6, 7))};
  }
  static void apart(const std::complex<Lanes>& z, Complex& a, Complex& b, Complex& c, Complex& d) {
    const All re = z.real().all_, im = z.imag().all_;
    put(__builtin_shufflevector(re, im, 0, 4), a);
    put(__builtin_shufflevector(re, im, 1, 5), b);
    put(__builtin_shufflevector(re, im, 2, 6), c);
    put(__builtin_shufflevector(re, im, 3, 7), d);
  }

  // Required by the library's product of complex numbers, which corrects infinities; none occur here.
  friend bool isnan(const Lanes&) { return false; }
  friend bool isinf(const Lanes&) { return false; }
  friend Lanes copysign(const Lanes& size, const Lanes&) { return size; }

 private:
  explicit Lanes(const All& all) : all_(all) {}
  static Two pair(const Complex& z) {
    Two out;
    std::memcpy(&out, &z, sizeof out);
    return out;
  }
  static void put(Two pair, Complex& z) { std::memcpy(static_cast<void*>(&z), &pair, sizeof pair); }
  All all_;
};

}  // namespace railstrata
