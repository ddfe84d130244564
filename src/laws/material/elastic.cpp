#include "material/elastic.hpp"

#include <algorithm>

namespace railstrata {
namespace {

Vec3 unit(Vec3 a) { return (1 / norm(a)) * a; }

// Null direction of a tensor minus its eigenvalue: normal to its rows, from the two that are farthest from parallel.
Vec3 null_direction(const Sym3& a) {
  const Vec3 rows[3] = {{a.xx, a.xy, a.xz}, {a.xy, a.yy, a.yz}, {a.xz, a.yz, a.zz}};
  Vec3 longest{};
  for (int i = 0; i < 3; ++i) {
    const Vec3 normal = cross(rows[i], rows[(i + 1) % 3]);
    if (dot(normal, normal) > dot(longest, longest)) longest = normal;
  }
  return unit(longest);
}

Vec3 any_normal(Vec3 v) { return std::abs(v.x) > std::abs(v.y) ? unit({-v.z, 0, v.x}) : unit({0, v.z, -v.y}); }

}  // namespace

// The trigonometric formula is exact to rounding for the root that lies apart from the two others; those are lost to
// its square root where they come close. They are the roots of the tensor in the plane normal to the first one's
// direction.
Vec3 principal_stresses(const Sym3& s) {
  const double mean = (s.xx + s.yy + s.zz) / 3;
  Sym3 d{s.xx - mean, s.yy - mean, s.zz - mean, s.xy, s.yz, s.xz};
  const double size =
      std::max({std::abs(d.xx), std::abs(d.yy), std::abs(d.zz), std::abs(d.xy), std::abs(d.yz), std::abs(d.xz)});
  if (size <= 0) return {mean, mean, mean};
  d = (1 / size) * d;
  const double j2 = 0.5 * (d.xx * d.xx + d.yy * d.yy + d.zz * d.zz) + d.xy * d.xy + d.yz * d.yz + d.xz * d.xz;
  const double j3 =
      d.xx * (d.yy * d.zz - d.yz * d.yz) - d.xy * (d.xy * d.zz - d.yz * d.xz) + d.xz * (d.xy * d.yz - d.yy * d.xz);
  const double r = std::sqrt(j2 / 3);
  const double angle = std::acos(std::min(std::abs(j3) / (2 * r * r * r), 1.0)) / 3;
  const double apart = std::copysign(2 * r * std::cos(angle), j3);
  const Vec3 first = null_direction({d.xx - apart, d.yy - apart, d.zz - apart, d.xy, d.yz, d.xz});
  const Vec3 u = any_normal(first), w = cross(first, u);
  const double a = dot(u, d * u), b = dot(w, d * w), c = dot(u, d * w);
  const double middle = 0.5 * (a + b), radius = std::hypot(0.5 * (a - b), c);
  const auto stress = [&](double root) { return mean + size * root; };
  if (j3 < 0) return {stress(middle + radius), stress(middle - radius), stress(apart)};
  return {stress(apart), stress(middle + radius), stress(middle - radius)};
}

}  // namespace railstrata
