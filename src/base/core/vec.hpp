#pragma once
// Small vectors and symmetric tensors. All quantities are SI; the meaning of the components is stated where they are
// used.
#include <array>
#include <cmath>

namespace railstrata {

/// A point or vector in a section plane: y lateral (towards the field side), z up.
struct Vec2 {
  double y = 0, z = 0;
};
constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.y + b.y, a.z + b.z}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.y - b.y, a.z - b.z}; }
constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.y, s * a.z}; }
constexpr double dot(Vec2 a, Vec2 b) { return a.y * b.y + a.z * b.z; }
/// Signed area of the parallelogram (a, b): positive when b is anticlockwise of a in the (y, z) plane.
constexpr double cross(Vec2 a, Vec2 b) { return a.y * b.z - a.z * b.y; }
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }

/// A point or vector in space: x rolling direction, y lateral, z up.
struct Vec3 {
  double x = 0, y = 0, z = 0;
  constexpr Vec3& operator+=(Vec3 b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
  constexpr Vec3& operator-=(Vec3 b) {
    x -= b.x;
    y -= b.y;
    z -= b.z;
    return *this;
  }
};
constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double norm(Vec3 a) { return std::sqrt(dot(a, a)); }

/// A symmetric second-order tensor; the order of the components is VTK's.
struct Sym3 {
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, xz = 0;
};
constexpr Sym3 operator+(Sym3 a, Sym3 b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.yz + b.yz, a.xz + b.xz};
}
constexpr Sym3 operator-(Sym3 a, Sym3 b) {
  return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.yz - b.yz, a.xz - b.xz};
}
constexpr Sym3 operator*(double s, Sym3 a) { return {s * a.xx, s * a.yy, s * a.zz, s * a.xy, s * a.yz, s * a.xz}; }
constexpr Vec3 operator*(const Sym3& a, Vec3 n) {
  return {a.xx * n.x + a.xy * n.y + a.xz * n.z, a.xy * n.x + a.yy * n.y + a.yz * n.z,
          a.xz * n.x + a.yz * n.y + a.zz * n.z};
}

}  // namespace railstrata
