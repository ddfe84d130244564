#include "mesh/bodies.hpp"
#include "geometry/profile_names.hpp"
#include "geometry/rail_outline.hpp"

#include <gtest/gtest.h>

#include <map>

#include "core/faults.hpp"
#include "mesh_checks.hpp"
#include "tests/geometry/rail_section.hpp"

namespace railstrata {
namespace {

using namespace mesh_checks;

const Profile& cn60() {
  static const Profile profile = builtin_profile(ProfileKind::rail, "CN60");
  return profile;
}
const Profile& lma() {
  static const Profile profile = builtin_profile(ProfileKind::wheel, "LMA");
  return profile;
}

SweptBody wheel(const std::vector<LayerMesh>& layers = {}, const MeshSizes& sizes = {}, double contact_s = 0) {
  return mesh_wheel(lma(), 0.430, {0, 0, 0.430}, wheel_spec(contact_s, layers), sizes);
}
SweptBody rail(const std::vector<LayerMesh>& layers = {}, const MeshSizes& sizes = {}, double contact_s = 0) {
  return mesh_rail(cn60(), kTrack, rail_spec(contact_s, layers), sizes);
}
SweptBody rail_block(const std::vector<LayerMesh>& layers = {}) {
  RailMeshSpec spec = rail_spec(0, layers);
  spec.shape = RailShape::block;
  return mesh_rail(cn60(), kTrack, spec, {});
}
SweptBody ring_wheel() {
  WheelMeshSpec spec = wheel_spec();
  spec.theta_end = 7;
  return mesh_wheel(lma(), 0.430, {0, 0, 0.430}, spec, {.element = 3e-3});
}
SweptBody disc() {
  WheelMeshSpec spec = wheel_spec();
  spec.shape = WheelShape::disc;
  return mesh_wheel(lma(), 0.430, {0, 0, 0.430}, spec, {});
}

std::vector<SweptBody> every_shape() {
  return {rail(),
          rail(one_layer(3e-3)),
          rail(one_layer(0.1e-3), {}, 8e-3),
          rail_block(one_layer(2e-3)),
          wheel(),
          wheel(one_layer(1e-3)),
          ring_wheel(),
          disc()};
}

TEST(ContactBand, SurfaceNodesLieOnTheProfile) {
  for (const SweptBody& body : every_shape()) {
    const Profile& profile = body.kind == SweepKind::extrude ? cn60() : lma();
    const Section& cap = body.blocks[body.contact.block].section;
    for (int c = 0; c <= body.contact.columns; ++c)
      EXPECT_LT(norm(to_profile(body, cap.nodes[c]) - profile.at(body.contact.s[c]).position), 1e-12) << body.name;
  }
}

TEST(ContactBand, ColumnsAreSpacedByTheElementSizeAndCentredOnTheContactPoint) {
  for (double h : {0.5e-3, 1e-3, 1.7e-3}) {
    const SweptBody body = rail({}, {h, 24e-3, 8e-3, 3, 12e-3}, 2.5e-3);
    const std::vector<double>& s = body.contact.s;
    for (std::size_t c = 1; c < s.size(); ++c) EXPECT_NEAR(s[c] - s[c - 1], h, 1e-12);
    EXPECT_NEAR(0.5 * (s.front() + s.back()), 2.5e-3, 1e-12);
    EXPECT_NEAR(s.back() - s.front(), 24e-3, h);
  }
}

TEST(ContactBand, NodeAndQuadrilateralIndicesAreThoseOfTheGrid) {
  for (const SweptBody& body : every_shape()) {
    const ContactBand& band = body.contact;
    const Section& cap = body.blocks[band.block].section;
    ASSERT_EQ(static_cast<int>(cap.nodes.size()), (band.columns + 1) * (band.rows + 1));
    ASSERT_EQ(static_cast<int>(cap.quads.size()), band.columns * band.rows);
    for (int r = 0; r < band.rows; ++r)
      for (int c = 0; c < band.columns; ++c) {
        std::array<int, 4> quad = cap.quads[r * band.columns + c];
        const int top = r * (band.columns + 1) + c, deep = top + band.columns + 1;
        std::array<int, 4> wanted{top, top + 1, deep, deep + 1};
        std::sort(quad.begin(), quad.end());
        EXPECT_EQ(quad, wanted);
      }
  }
}

TEST(ContactBand, LayerInterfacesLieAtTheExactDistanceFromTheProfile) {
  for (double t : {0.05e-3, 0.2e-3, 1e-3, 3e-3, 6e-3, 10e-3})
    for (const SweptBody& body : {rail(one_layer(t)), wheel(one_layer(t))}) {
      const Profile& profile = body.kind == SweepKind::extrude ? cn60() : lma();
      const ContactBand& band = body.contact;
      const Block& cap = body.blocks[band.block];
      const auto row =
          std::find_if(band.depth.begin(), band.depth.end(), [&](double d) { return std::abs(d - t) < 1e-12; }) -
          band.depth.begin();
      ASSERT_LE(row, band.rows) << body.name << " " << t;
      for (int c = 0; c <= band.columns; ++c) {
        const Vec2 p = to_profile(body, cap.section.nodes[row * (band.columns + 1) + c]);
        EXPECT_NEAR(distance_from_profile(profile, p, band.s[c]), t, 1e-9) << body.name << " column " << c;
      }
      for (int r = 0; r < band.rows; ++r) EXPECT_EQ(cap.section.quad_material[r * band.columns], r < row ? 1 : 0);
    }
}

TEST(ContactBand, RowsOfTheBaseCaseAreOneMillimetre) {
  const SweptBody body = rail();
  ASSERT_EQ(body.contact.rows, 8);
  for (int r = 0; r <= 8; ++r) EXPECT_NEAR(body.contact.depth[r], r * 1e-3, 1e-12);
}

TEST(ContactBand, NeighbouringRowsDifferByAtMostAFactorOfTwo) {
  for (double h : {0.25e-3, 0.5e-3, 1e-3, 2e-3, 4e-3})
    for (double t : {0.05e-3, 0.1e-3, 0.2e-3, 1e-3, 3e-3, 6e-3, 10e-3}) {
      const SweptBody body = rail(one_layer(t), {h, 24e-3, 8e-3, 3, 12e-3});
      const std::vector<double>& d = body.contact.depth;
      for (std::size_t r = 2; r < d.size(); ++r) {
        const double ratio = (d[r] - d[r - 1]) / (d[r - 1] - d[r - 2]);
        EXPECT_LT(std::max(ratio, 1 / ratio), 2 + 1e-9) << "h " << h << " t " << t << " row " << r;
      }
    }
}

TEST(ContactBand, OneElementThroughAThickLayerIsFollowedByRowsThatShrinkGradually) {
  for (double t : {3e-3, 6e-3}) {
    std::vector<LayerMesh> layers = one_layer(t);
    layers[0].elements = 1;
    const std::vector<double> d = rail(layers).contact.depth;
    EXPECT_NEAR(d[1], t, 1e-12);
    for (std::size_t r = 2; r < d.size(); ++r)
      EXPECT_LE((d[r - 1] - d[r - 2]) / (d[r] - d[r - 1]), 2 + 1e-9) << "row " << r;
  }
}

double layer_area(const SweptBody& body) {
  double sum = 0;
  for (const Block& b : body.blocks)
    for (std::size_t q = 0; q < b.section.quads.size(); ++q)
      sum += b.section.quad_material[q] == 1 ? quad_area(b.section, b.section.quads[q]) : 0.0;
  return sum;
}

double strip_area(const Profile& profile, double t, double width) {
  const double s0 = profile.s_at_y(-0.5 * width), s1 = profile.s_at_y(0.5 * width);
  double sum = 0;
  for (int i = 0; i < 2000; ++i)
    sum += (s1 - s0) / 2000 * t * (1 - 0.5 * t * profile.at(s0 + (i + 0.5) * (s1 - s0) / 2000).curvature);
  return sum;
}

TEST(Layers, FillTheStripOfTheirThicknessAndWidth) {
  for (double t : {0.2e-3, 1e-3, 3e-3})
    for (double width : {0.060, 0.050, 0.031}) {
      EXPECT_NEAR(layer_area(rail(one_layer(t, width))) / strip_area(cn60(), t, width), 1.0, 0.01)
          << "rail " << t << " " << width;
      const bool cut_upright = width == 0.060;  // the block's sides end the layer there, not its surface's normals
      EXPECT_TRUE(cut_upright ||
                  std::abs(layer_area(rail_block(one_layer(t, width))) / strip_area(cn60(), t, width) - 1) < 0.01)
          << "block " << t << " " << width;
      EXPECT_NEAR(layer_area(wheel(one_layer(t, width))) / strip_area(lma(), t, width), 1.0, 0.01)
          << "wheel " << t << " " << width;
    }
}

/// 3 mm on one half, down to nothing at y = 10 mm, on rows that follow it or on level ones.
std::vector<LayerMesh> tapered(bool follow, double there = 0) {
  std::vector<LayerMesh> out = one_layer(3e-3);
  out[0].across = {{-25e-3, 3e-3}, {-5e-3, 3e-3}, {10e-3, there}};
  out[0].rows_follow = follow;
  return out;
}

TEST(Layers, ThatVaryAcrossFillTheSpaceBelowTheirTable) {
  const double wanted = 20e-3 * 3e-3 + 0.5 * 15e-3 * 3e-3;
  for (const double h : {1e-3, 0.5e-3}) {
    const MeshSizes sizes{.element = h, .fine_width = 48e-3, .fine_depth = 5e-3};
    EXPECT_NEAR(layer_area(rail(tapered(true), sizes)) / wanted, 1, 0.015) << h;
    EXPECT_NEAR(layer_area(rail(tapered(false), sizes)) / wanted, 1, 0.03) << h;
    EXPECT_NEAR(layer_area(wheel(tapered(true), sizes)) / wanted, 1, 0.04) << h;
  }
}

TEST(Layers, AnEvenTableIsTheEvenLayer) {
  std::vector<LayerMesh> even = one_layer(3e-3);
  const SweptBody plain = rail(even);
  even[0].across = {{-30e-3, 3e-3}, {30e-3, 3e-3}};
  for (const bool follow : {true, false}) {
    even[0].rows_follow = follow;
    const SweptBody table = rail(even);
    for (std::size_t b = 0; b < plain.blocks.size(); ++b) {
      EXPECT_EQ(table.blocks[b].section.quad_material, plain.blocks[b].section.quad_material);
      for (std::size_t n = 0; n < plain.blocks[b].section.nodes.size(); ++n)
        EXPECT_LT(norm(table.blocks[b].section.nodes[n] - plain.blocks[b].section.nodes[n]), 1e-12);
    }
  }
}

TEST(Layers, StackInTheOrderGiven) {
  const SweptBody body = rail({{"hard", 0.5e-3, 0.06, 2}, {"soft", 1.5e-3, 0.06, 3}});
  EXPECT_EQ(body.materials, (std::vector<std::string>{"matrix", "hard", "soft"}));
  const Section& cap = body.blocks[body.contact.block].section;
  const int n = body.contact.columns;
  const std::vector<int> wanted{1, 1, 2, 2, 2, 0};
  for (int r = 0; r < 6; ++r) EXPECT_EQ(cap.quad_material[r * n + n / 2], wanted[r]);
}

TEST(Layers, RowsOfAGradedOneAreOneLayer) {
  const SweptBody body =
      rail({{"clad 1", 0.5e-3, 0.06, 1, true}, {"clad 2", 0.5e-3, 0.06, 1, false}, {"soft", 1e-3, 0.06, 2}});
  EXPECT_EQ(body.material_layer, (std::vector<int>{0, 1, 1, 2}));
  EXPECT_EQ(body.layer_of(3), 2);
  EXPECT_EQ(SweptBody{}.layer_of(3), 3) << "by default every material is a layer";
}

std::vector<Vec2> outline_polygon(const Profile& head) {
  const RailOutline o = rail_outline(head);
  std::vector<Vec2> right, polygon;
  for (const auto* part : {&o.underside, &o.web, &o.foot_top}) right.insert(right.end(), part->begin(), part->end());
  right.push_back({right.back().y, o.base_z});
  for (Vec2 p : right) polygon.push_back({-p.y, p.z});
  for (auto p = right.rbegin(); p != right.rend(); ++p) polygon.push_back(*p);
  for (int i = 2000; i >= 0; --i)
    polygon.push_back(head.at(head.s_min() + (head.s_max() - head.s_min()) * i / 2000).position);
  return polygon;
}

TEST(RailSection, HasTheOutlinesAreaWithinOnePercent) {
  for (const char* name : {"CN60", "UIC60", "UIC54"}) {
    const Profile head = builtin_profile(ProfileKind::rail, name);
    const SweptBody body = mesh_rail(head, kTrack, rail_spec(), {});
    double sum = 0;
    for (const Block& b : body.blocks) sum += area(b.section);
    EXPECT_NEAR(sum / section_properties(outline_polygon(head)).area, 1.0, 0.01) << name;
  }
}

TEST(RailSection, OfCn60WeighsSixtyKilogramsPerMetre) {
  double sum = 0;
  for (const Block& b : rail().blocks) sum += area(b.section);
  EXPECT_NEAR(sum * 7830, 60.64, 0.6);  // TB/T 2344: 77.45 cm2, 60.64 kg/m
}

double ring_moment(
    const std::vector<Vec2>& polygon) {  // integral of the distance to the axis z = 0 over the polygon, |z|
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    sum += cross(a, b) * (a.z + b.z) / 6;
  }
  return std::abs(sum);
}

TEST(WheelVolume, IsThatOfItsSectionRevolvedByPappus) {
  const WheelMeshSpec spec = wheel_spec();
  std::vector<Vec2> rim;
  for (int i = 0; i <= 4000; ++i)
    rim.push_back(lma().at(lma().s_min() + (lma().s_max() - lma().s_min()) * i / 4000).position);
  rim.push_back({rim.back().y, spec.section.rim_thickness});
  rim.push_back({rim.front().y, spec.section.rim_thickness});
  for (Vec2& p : rim) p.z -= 0.430;
  const auto ring = [](double inner, double outer, double width) {
    return 0.5 * width * (outer * outer - inner * inner);
  };
  const double moment = ring_moment(rim) +
                        ring(spec.section.hub_radius, 0.430 - spec.section.rim_thickness, spec.section.web_thickness) +
                        ring(spec.section.bore_radius, spec.section.hub_radius, spec.section.hub_width);
  EXPECT_NEAR(volume(wheel()) / (2 * std::numbers::pi * moment), 1.0, 0.005);
}

// A path of a turn and more: the band is fine all round, and no element lies over another.
TEST(WheelVolume, OfALongPathIsThatOfAShortOne) {
  const MeshSizes sizes{.element = 4e-3};
  const SweptBody few = wheel({}, sizes);
  for (double turns : {0.97, 1.0, 1.3, 7.4}) {
    WheelMeshSpec spec = wheel_spec();
    spec.theta_end = spec.theta_begin + 2 * std::numbers::pi * turns;
    const SweptBody body = mesh_wheel(lma(), 0.430, {0, 0, 0.430}, spec, sizes);
    EXPECT_NEAR(volume(body) / volume(few), 1, 1e-3) << turns;
    WorstQuality worst, worst_of_few;
    gather(worst, body, "long path");
    gather(worst_of_few, few, "short path");
    EXPECT_GT(worst.scaled_jacobian, 0.99 * worst_of_few.scaled_jacobian) << turns << ": " << worst.where;
    EXPECT_EQ(body.contact.fine_end - body.contact.fine_begin >= 2 * std::numbers::pi - 1e-12, turns > 0.98) << turns;
  }
}

TEST(Ties, TieEverySlaveOnceAndNeverInACircle) {
  for (const SweptBody& body : every_shape()) {
    std::map<std::pair<int, int>, int> count;
    for (const Tie& tie : body.ties) {
      ++count[{tie.slave_block, tie.slave_node}];
      EXPECT_LT(tie.slave_block, tie.master_block);
      EXPECT_GE(tie.weight1, 0);
      EXPECT_LE(tie.weight1, 1);
    }
    for (const auto& [node, n] : count)
      EXPECT_EQ(n, 1) << body.name << " block " << node.first << " node " << node.second;
  }
}

TEST(Ties, HoldTheWholeRimOfTheCapOnTheMastersChord) {
  for (const SweptBody& body : every_shape()) {
    const ContactBand& band = body.contact;
    const int stride = band.columns + 1;
    std::map<int, double> gap;
    for (const Tie& tie : body.ties) {
      if (tie.slave_block != band.block) continue;
      const auto& master = body.blocks[tie.master_block].section.nodes;
      const Vec2 place = (1 - tie.weight1) * master[tie.master_node0] + tie.weight1 * master[tie.master_node1];
      gap[tie.slave_node] = norm(place - body.blocks[band.block].section.nodes[tie.slave_node]);
    }
    EXPECT_EQ(static_cast<int>(gap.size()), stride + 2 * band.rows) << body.name;
    for (int c = 0; c <= band.columns; ++c) EXPECT_LT(gap.at(band.rows * stride + c), 1e-12) << body.name;
    for (int r = 0; r < band.rows; ++r)
      for (int c : {0, band.columns}) EXPECT_LT(gap.at(r * stride + c), 1e-12) << body.name;
  }
}

TEST(Ties, BridgeGapsOfAtMostAThirdOfAMillimetre) {
  for (const SweptBody& body : every_shape())
    for (const Tie& tie : body.ties) {
      const auto& master = body.blocks[tie.master_block].section.nodes;
      const Vec2 place = (1 - tie.weight1) * master[tie.master_node0] + tie.weight1 * master[tie.master_node1];
      EXPECT_LT(norm(place - body.blocks[tie.slave_block].section.nodes[tie.slave_node]), 0.34e-3)
          << body.name << " block " << tie.slave_block;
    }
}

TEST(Stations, OfCoarserBlocksAreSubsetsAndRingsClose) {
  for (const SweptBody& body : every_shape()) {
    const std::vector<double>& fine = body.blocks[0].stations.at;
    for (const Block& b : body.blocks) {
      EXPECT_EQ(b.stations.closed, body.kind == SweepKind::revolve);
      EXPECT_TRUE(std::is_sorted(b.stations.at.begin(), b.stations.at.end()));
      if (b.name != "web") {
        EXPECT_TRUE(std::includes(fine.begin(), fine.end(), b.stations.at.begin(), b.stations.at.end())) << b.name;
      }
      EXPECT_TRUE(!b.stations.closed || b.stations.at.back() - b.stations.at.front() < 2 * std::numbers::pi) << b.name;
    }
  }
}

TEST(Held, AreTheFootsBaseAndTheBore) {
  const SweptBody r = rail(), w = wheel(), b = rail_block(), d = disc();
  const double base = rail_outline(cn60()).base_z;
  for (SectionNode n : r.prescribed)
    EXPECT_NEAR(model_to_rail(kTrack, r.blocks[n.block].section.nodes[n.node]).z, base, 1e-12);
  for (SectionNode n : b.prescribed)
    EXPECT_NEAR(model_to_rail(kTrack, b.blocks[n.block].section.nodes[n.node]).z, -0.060, 1e-12);
  for (const SweptBody* body : {&w, &d})
    for (SectionNode n : body->prescribed) EXPECT_NEAR(body->blocks[n.block].section.nodes[n.node].z, -0.095, 1e-12);
  for (const SweptBody* body : {&r, &w, &b, &d}) EXPECT_GT(body->prescribed.size(), 5u);
}

TEST(ElementCount, OfTheBaseCaseAtOneMillimetreStaysBelow300000) {
  TrackGeometry track;
  track.lateral_shift = 1.5e-3;
  const RigidContact contact = place_wheel(lma(), cn60(), track);
  RailMeshSpec rail_mesh = rail_spec(contact.rail_s);
  rail_mesh.x_begin = -0.016;
  rail_mesh.x_end = 0.330;
  WheelMeshSpec wheel_mesh = wheel_spec(contact.wheel_s);
  wheel_mesh.theta_begin = rail_mesh.x_begin / contact.rolling_radius;
  wheel_mesh.theta_end = rail_mesh.x_end / contact.rolling_radius;
  const SweptBody r = mesh_rail(cn60(), track, rail_mesh, {}),
                  w = mesh_wheel(lma(), 0.430, {0, contact.wheel_offset_y, contact.axle_height}, wheel_mesh, {});
  EXPECT_LT(r.elements() + w.elements(), 300000) << r.elements() << " + " << w.elements();
  for (const SweptBody* body : {&r, &w})
    for (const BlockQuality& q : measure_quality(*body)) EXPECT_LT(q.aspect_max, 20) << q.block;
}

std::string message_of(const auto& make) {
  try {
    make();
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no CaseError";
}

// A ring below the wheel is a wheel on its head: its crown is the rail's under x = 0, its axle lies below, the fine
// stations are those of the way, which goes against its angles.
TEST(RingRail, StandsUnderTheWheelWithItsFineStationsAlongTheWay) {
  const double radius = 0.2, crown = 0.15;
  RailMeshSpec spec = rail_spec();
  spec.block_height = 0.08;
  const SweptBody body = mesh_ring_rail(circular_profile(ProfileKind::rail, crown, 0.02), radius, spec, {});
  EXPECT_TRUE(body.rises());
  EXPECT_LE(body.contact.fine_begin, std::numbers::pi - spec.x_end / radius + 1e-12);
  EXPECT_GE(body.contact.fine_end, std::numbers::pi - spec.x_begin / radius - 1e-12);
  const Block& cap = body.blocks[body.contact.block];
  for (int c = 0; c <= body.contact.columns; ++c)
    for (double t : cap.stations.at) {
      const Vec3 p = swept_point(body.kind, body.origin, cap.section.nodes[c], t);
      EXPECT_NEAR(std::hypot(p.x, p.z + radius), radius - crown + std::sqrt(crown * crown - p.y * p.y), 1e-12);
    }
  const Vec3 ahead = swept_point(body.kind, body.origin, {0, -radius}, std::numbers::pi - 0.01 / radius);
  EXPECT_NEAR(ahead.x, 0.01, 1e-5);
  EXPECT_NEAR(ahead.z, -0.5 * 0.01 * 0.01 / radius, 1e-6);
  for (const SectionNode& n : body.prescribed)
    EXPECT_NEAR(body.blocks[n.block].section.nodes[n.node].z, -(radius - spec.block_height), 1e-12);
  for (const BlockQuality& q : measure_quality(body)) EXPECT_GT(q.scaled_jacobian_min, 0.3) << q.block;
}

TEST(Faults, NameWhatDoesNotFitAndTheRemedy) {
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_TRUE(has(message_of([] { rail(one_layer(12e-3)); }), "layer thicker than the head: 12 mm"));
  EXPECT_TRUE(has(message_of([] { wheel(one_layer(30e-3)); }), "layer thicker than the rim: 30 mm"));
  EXPECT_TRUE(has(message_of([] { rail(one_layer(1e-3, 0.080)); }), "layer width larger than the head: 80 mm"));
  EXPECT_TRUE(has(message_of([] {
                    rail({}, {1e-3, 70e-3, 8e-3, 3, 12e-3});
                  }),
                  "fine width larger than the running surface: 70 mm"));
  EXPECT_TRUE(has(message_of([] { rail({}, {}, 31e-3); }), "too close to the end of the rail's running surface"));
  EXPECT_TRUE(has(message_of([] { rail({}, {}, 31e-3); }), "remedy:"));
  WheelMeshSpec thin = wheel_spec();
  thin.section.rim_thickness = 0.30;
  EXPECT_TRUE(has(message_of([&] { mesh_wheel(lma(), 0.43, {}, thin, {}); }), "radii out of order"));
}

}  // namespace
}  // namespace railstrata
