// Convergence of the elements on a smooth manufactured solution.
#include <gtest/gtest.h>

#include "tests/body/sample_bodies.hpp"
#include "tests/mesh/brick_mesh.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

// A cube of 1 m with a smoothly warped section and graded stations, n elements to a side.
SweptBody warped_cube(int n) {
  SweptBody body = mesh_brick(n, n, n, 1.0 / n, 1.0 / n, 1.0 / n);
  constexpr double pi = std::numbers::pi;
  for (Vec2& p : body.blocks[0].section.nodes) p = p + 0.08 * std::sin(pi * p.y) * std::sin(pi * p.z) * Vec2{1.0, -0.7};
  for (double& t : body.blocks[0].stations.at) t += 0.06 * std::sin(2 * pi * t);
  return body;
}

// u = U (sin a.x, sin b.x, cos c.x) with plane waves in three directions; -div sigma in closed form.
struct Manufactured {
  static constexpr double kSize = 1e-4;
  Vec3 a{2.1, 1.3, -0.7}, b{-0.9, 2.4, 1.1}, c{1.5, -0.6, 2.0};
  Vec3 displacement(Vec3 x) const {
    return kSize * Vec3{std::sin(dot(a, x)), std::sin(dot(b, x)), std::cos(dot(c, x))};
  }
  // For u = e g(k.x): div sigma = (mu |k|^2 e + (lambda + mu)(k.e) k) g''; here g'' = -g.
  Vec3 body_force(Vec3 x) const {
    const Vec3 u = displacement(x), axis[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, wave[3] = {a, b, c};
    const double g[3] = {u.x, u.y, u.z};
    Vec3 f;
    for (int i = 0; i < 3; ++i)
      f += g[i] * (kSteel.mu * dot(wave[i], wave[i]) * axis[i] +
                   (kSteel.lambda + kSteel.mu) * dot(wave[i], axis[i]) * wave[i]);
    return f;
  }
};

// Mass-weighted rms error of the displacement relative to the solution's, all boundary displacements given.
double error(int n, ElementKind element) {
  const Body solid(warped_cube(n), {kSteel}, {element});
  const Manufactured truth;
  const BlockLayout& l = solid.layout.blocks[0];
  const Field exact = nodal_field(solid, [&](Vec3 x) { return truth.displacement(x); });
  const Field force = nodal_field(solid, [&](Vec3 x) { return (1 / kSteel.density) * truth.body_force(x); });
  std::vector<std::ptrdiff_t> inner;
  for (int r = 1; r < n; ++r)
    for (int c = 1; c < n; ++c)
      for (int i = 0; i < 3; ++i)
        for (int j = 1; j < n; ++j) inner.push_back(l.line(r * (n + 1) + c, i) + j);

  Field u = exact, r = solid.layout.field(), p = r, q = r;
  for (std::ptrdiff_t k : inner) u[k] = 0;
  Traversal elements(solid);
  elements.linear_force(u, q);
  double rr = 0;
  for (std::ptrdiff_t k : inner) {
    p[k] = r[k] = solid.element_mass[k] * force[k] - q[k];
    rr += r[k] * r[k];
  }
  const double wanted = 1e-20 * rr;
  for (int iteration = 0; iteration < 2000 && rr > wanted; ++iteration) {
    elements.linear_force(p, q);
    double pq = 0, next = 0;
    for (std::ptrdiff_t k : inner) pq += p[k] * q[k];
    for (std::ptrdiff_t k : inner) {
      u[k] += rr / pq * p[k];
      r[k] -= rr / pq * q[k];
      next += r[k] * r[k];
    }
    for (std::ptrdiff_t k : inner) p[k] = r[k] + next / rr * p[k];
    rr = next;
  }
  EXPECT_LE(rr, wanted);
  Field off = u, weighted = exact;
  for (std::size_t k = 0; k < u.size(); ++k) {
    off[k] -= exact[k];
    weighted[k] *= solid.element_mass[k];
  }
  const double size = nodal_dot(solid.layout, weighted, exact);
  for (std::size_t k = 0; k < u.size(); ++k) weighted[k] = solid.element_mass[k] * off[k];
  return std::sqrt(nodal_dot(solid.layout, weighted, off) / size);
}

}  // namespace

TEST(StaticConvergence, DisplacementsOfASmoothManufacturedSolutionConvergeWithOrderTwo) {
  for (ElementKind element : {ElementKind::full, ElementKind::one_point}) {
    const double coarse = error(4, element), middle = error(8, element), fine = error(16, element);
    RecordProperty(element == ElementKind::full ? "full" : "one_point", std::to_string(fine));
    EXPECT_NEAR(std::log2(coarse / middle), 2.0, 0.25);
    EXPECT_NEAR(std::log2(middle / fine), 2.0, 0.12);
    EXPECT_LT(fine, 2e-3);
  }
}

}  // namespace railstrata
