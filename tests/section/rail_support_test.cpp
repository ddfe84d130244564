// A rail's section on springs, as a beam on them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/profile_names.hpp"
#include "mesh/beam_section.hpp"
#include "mesh/bodies.hpp"
#include "section/section_compliance.hpp"

namespace railstrata {
namespace {

constexpr double kYoung = 206e9, kPoisson = 0.28, kShear = kYoung / (2 * (1 + kPoisson));
const Elastic kSteel = elastic(kYoung, kPoisson, 7800);

struct UprightRail {
  SweptBody mesh;
  BeamSection beam;
  double height = 0;
  double head = 0;  ///< m, of the running surface above the centroid
};

UprightRail upright_rail(const char* profile, RailSection section) {
  RailMeshSpec spec;
  spec.section = section;
  spec.x_end = 0.01;
  TrackGeometry level;
  level.cant = 0;
  UprightRail out{mesh_rail(builtin_profile(ProfileKind::rail, profile), level, spec,
                            {.element = 2e-3, .fine_width = 24e-3, .fine_depth = 8e-3}),
                  {}};
  out.beam = beam_section(out.mesh);
  double area = 0, moment = 0, top = -HUGE_VAL, bottom = HUGE_VAL;
  for (const Block& b : out.mesh.blocks) {
    for (const Vec2 p : b.section.nodes) {
      top = std::max(top, p.z);
      bottom = std::min(bottom, p.z);
    }
    for (std::size_t q = 0; q < b.section.quads.size(); ++q) {
      const double a = quad_area(b.section, b.section.quads[q]);
      area += a;
      moment += a * centre_of(b.section, static_cast<int>(q)).z;
    }
  }
  out.height = top - bottom;
  out.head = top - moment / area;
  return out;
}

/// At the middle station, by a force there.
std::vector<Eigen::Matrix3d> in_the_middle(const SweptBody& rail, const RailSupport& support,
                                           const std::vector<double>& k) {
  const QuadraticSection mesh = quadratic_section(rail);
  const SectionCompliance c = section_compliance(mesh, section_stiffness(mesh, {kSteel}, 0, support), 1, k);
  const auto middle = static_cast<Eigen::Index>(3 * (c.stations.size() / 2));
  std::vector<Eigen::Matrix3d> out;
  for (const Eigen::MatrixXd& at : c.at) out.emplace_back(at.block<3, 3>(middle, middle));
  return out;
}

// Timoshenko's beam on K: w = 1/(K + E I k^4/s), s = 1 + E I k²/(kappa G A); its sections turn by k w/s, so that the
// surface moves along by the distance of the centroid times that. On pads that slide freely a force through the height
// H stretches it by nu H/(E A) besides (Poisson). Of shorter waves beams lack terms of (k H)². The section yields by
// 0.7 % more: web and foot between rail and springs.
TEST(RailSupport, BendsAsABeamOnSprings) {
  for (const auto& [profile, section] : {std::pair{"CN60", RailSection::CN60}, {"UIC60", RailSection::UIC60}}) {
    UprightRail rail = upright_rail(profile, section);
    rail.mesh.on_pads = std::exchange(rail.mesh.prescribed, {});
    const RailSupport support{.pad = 200e6, .pad_across = 1e3, .ballast = 200e6};
    const double bending = kYoung * rail.beam.inertia, shear = rail.beam.shear_share * rail.beam.area * kShear;
    const std::vector<double> waves{0.1, 0.5, 1, 1.5};
    const std::vector<Eigen::Matrix3d> c = in_the_middle(rail.mesh, support, waves);
    for (std::size_t i = 0; i < waves.size(); ++i) {
      const double k = waves[i], soft = 1 + bending * k * k / shear,
                   sinks = 1 / (support.vertical() + bending * std::pow(k, 4) / soft),
                   along = -rail.head * k * sinks / soft + kPoisson * rail.height / (kYoung * rail.beam.area * k);
      EXPECT_NEAR(c[i](2, 2) / sinks, 1, 1e-2) << profile << " " << k;
      EXPECT_NEAR(c[i](0, 2) / along, 1, 2e-2) << profile << " " << k;
    }
  }
}

TEST(RailSupport, OfStiffSpringsIsAHeldFoot) {
  UprightRail rail = upright_rail("CN60", RailSection::CN60);
  const std::vector<double> waves{0.1, 1, 10, 100};
  const std::vector<Eigen::Matrix3d> held = in_the_middle(rail.mesh, {}, waves);
  rail.mesh.on_pads = std::exchange(rail.mesh.prescribed, {});
  const std::vector<Eigen::Matrix3d> c = in_the_middle(rail.mesh, {1e15, 1e15, 1e15}, waves);
  for (std::size_t i = 0; i < waves.size(); ++i)
    EXPECT_LT((c[i] - held[i]).cwiseAbs().maxCoeff(), 1e-3 * held[i].maxCoeff()) << waves[i];
}

// Sleepers sink and do not lean: a foot that leans rests on its pads alone.
TEST(RailSupport, LeansOnItsPads) {
  UprightRail rail = upright_rail("UIC60", RailSection::UIC60);
  rail.mesh.on_pads = std::exchange(rail.mesh.prescribed, {});
  constexpr double kPad = 1e6, kRigid = 1e15, kLow = 1e-3;
  const RailSupport soft{kPad, kRigid, 2e6}, firm{kPad, kRigid, kRigid};
  const Eigen::Matrix3d of_soft = in_the_middle(rail.mesh, soft, {kLow})[0],
                        of_firm = in_the_middle(rail.mesh, firm, {kLow})[0];
  EXPECT_NEAR((of_soft(2, 2) - of_firm(2, 2)) * soft.ballast, 1, 1e-4);
  EXPECT_NEAR(of_soft(1, 1) / of_firm(1, 1), 1, 1e-6);
}

}  // namespace
}  // namespace railstrata
