#include "section/section_compliance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/profile_names.hpp"
#include "mesh/bodies.hpp"

namespace railstrata {
namespace {

constexpr HalfSpaceMaterial kSteel{206e9, 0.28}, kClad{824e9, 0.28};
constexpr double kStation = 2e-3;                 // m
const std::vector<double> kWaves{200, 400, 800};  // 1/m: waves shorter than the block's depth

/// A block of 120 mm by 100 mm under a plane.
SectionCompliance block_under_plane(double element, const std::vector<LayerMesh>& layers,
                                    const std::vector<Elastic>& materials) {
  RailMeshSpec spec;
  spec.shape = RailShape::block;
  spec.block_width = 0.12;
  spec.block_height = 0.1;
  spec.x_end = 0.01;
  spec.layers = layers;
  TrackGeometry level;
  level.cant = 0;
  const QuadraticSection mesh =
      quadratic_section(mesh_rail(circular_profile(ProfileKind::rail, HUGE_VAL, 0.07), level, spec,
                                  {.element = element, .fine_width = 32e-3, .fine_depth = 8e-3}));
  return section_compliance(mesh, section_stiffness(mesh, materials, 0),
                            static_cast<int>(std::lround(kStation / element)), kWaves);
}

Elastic elastic_of(const HalfSpaceMaterial& m) { return elastic(m.young, m.poisson, 7800); }

/// Largest deviation from the half-space between stations up to 12 mm apart, over its largest value.
double deviation(const SectionCompliance& block, const LayeredHalfSpace& body) {
  const Eigen::Matrix3d down = Eigen::Vector3d(1, 1, -1).asDiagonal();
  const auto n = static_cast<int>(block.stations.size());
  const std::vector<Eigen::MatrixXd> exact = half_space_compliance(body, false, kStation, n, kWaves);
  double worst = 0;
  for (std::size_t i = 0; i < kWaves.size(); ++i)
    for (int a = 4; a < n - 4; ++a)
      for (int b = 4; b < n - 4; ++b) {
        const Eigen::Matrix3d found = down * block.at[i].block<3, 3>(3 * a, 3 * b) * down;
        worst = std::max(worst, (found - exact[i].block<3, 3>(3 * a, 3 * b)).cwiseAbs().maxCoeff() /
                                    exact[i].block<3, 3>(3 * a, 3 * a).maxCoeff());
      }
  return worst;
}

TEST(SectionCompliance, OfABlockConvergesToTheHomogeneousHalfSpace) {
  const double coarse = deviation(block_under_plane(1e-3, {}, {elastic_of(kSteel)}), {{}, kSteel}),
               fine = deviation(block_under_plane(0.5e-3, {}, {elastic_of(kSteel)}), {{}, kSteel});
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, coarse / 4) << "quadratic elements under hats: the third order";
}

TEST(SectionCompliance, OfALayeredBlockConvergesToTheLayeredHalfSpace) {
  const std::vector<LayerMesh> clad{{.name = "clad", .thickness = 3e-3, .width = 0.12}};
  const LayeredHalfSpace body{{{.thickness = 3e-3, .material = kClad}}, kSteel};
  const std::vector<Elastic> materials{elastic_of(kSteel), elastic_of(kClad)};
  const double coarse = deviation(block_under_plane(1e-3, clad, materials), body),
               fine = deviation(block_under_plane(0.5e-3, clad, materials), body);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, coarse / 4);
}

TEST(SectionStiffness, LetsAWheelTurnAndMoveAsARigidBody) {
  constexpr double kRadius = 0.43;
  WheelMeshSpec spec;
  spec.theta_end = 0.01;
  SweptBody wheel =
      mesh_wheel(builtin_profile(ProfileKind::wheel, "LMA"), kRadius, {}, spec, {.element = 2e-3, .fine_width = 32e-3});
  wheel.prescribed.clear();
  const QuadraticSection mesh = quadratic_section(wheel);
  const SectionStiffness stiffness = section_stiffness(mesh, {elastic_of(kSteel)}, kRadius);
  const auto forces = [&](double k, auto&& displacement) {
    Eigen::VectorXd u(3 * mesh.free_nodes);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
      if (const NodeShares& s = mesh.shares[n]; s.size() == 1 && s[0].second == 1)
        u.segment<3>(3 * s[0].first) = displacement(mesh.nodes[n]);
    const Eigen::SparseMatrix<double> K = stiffness.at(k);
    const Eigen::VectorXd f = K.selfadjointView<Eigen::Lower>() * u;
    return f.cwiseAbs().maxCoeff() / (K.diagonal().maxCoeff() * u.cwiseAbs().maxCoeff());
  };
  EXPECT_LT(forces(0, [](Vec2 p) { return Eigen::Vector3d(-p.z, 0, 0); }), 1e-10) << "about the axle";
  EXPECT_LT(forces(0, [](Vec2) { return Eigen::Vector3d(0, 1, 0); }), 1e-10) << "along the axle";
  EXPECT_LT(forces(1 / kRadius, [](Vec2) { return Eigen::Vector3d(-1, 0, 1); }), 1e-10) << "up: u_x = sin, u_z = cos";
}

// Hanging nodes on sides that they do not stand on would resist.
TEST(SectionStiffness, LetsARailLeanAsARigidBody) {
  RailMeshSpec spec;
  spec.x_end = 0.01;
  SweptBody rail = mesh_rail(builtin_profile(ProfileKind::rail, "CN60"), {}, spec,
                             {.element = 2e-3, .fine_width = 32e-3, .fine_depth = 8e-3, .coarse_ratio = 3});
  rail.prescribed.clear();
  const QuadraticSection mesh = quadratic_section(rail);
  Eigen::VectorXd u(3 * mesh.free_nodes);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (const NodeShares& s = mesh.shares[n]; s.size() == 1 && s[0].second == 1)
      u.segment<3>(3 * s[0].first) << 0, -mesh.nodes[n].z, mesh.nodes[n].y;
  const Eigen::SparseMatrix<double> K = section_stiffness(mesh, {elastic_of(kSteel)}, 0).at(0);
  const Eigen::VectorXd f = K.selfadjointView<Eigen::Lower>() * u;
  EXPECT_LT(f.cwiseAbs().maxCoeff(), 1e-10 * K.diagonal().maxCoeff() * u.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace railstrata
