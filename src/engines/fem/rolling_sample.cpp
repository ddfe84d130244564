#include "fem/rolling_sample.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "body/plastic_field.hpp"
#include "body/stress.hpp"
#include "core/rotation.hpp"
#include "mesh/split_interface.hpp"

namespace railstrata {
namespace {

// Half length of a sample: the patch and the stress field around it.
double sample_half_length(const RollingSystem& s) {
  return 1.5 * s.model.hertz.a + 2 * s.spec().mesh.element_size + s.model.reach;
}

// The node planes of a band by number; on a ring the numbers go on below zero and beyond the last station.
class BandPlanes {
 public:
  explicit BandPlanes(const Block& block)
      : at_(block.stations.at), closed_(block.stations.closed), count_(block.stations.nodes()) {}

  bool closed() const { return closed_; }
  /// Station of the block.
  int station(int plane) const { return closed_ ? ((plane % count_) + count_) % count_ : plane; }
  /// Sweep coordinate, continued over the turns of a ring.
  double coordinate(int plane) const {
    assert(closed_ || (plane >= 0 && plane < count_));
    return closed_ ? at_[station(plane)] + kPeriod * std::floor(static_cast<double>(plane) / count_) : at_[plane];
  }
  /// A sweep coordinate in the turn that begins with the first station.
  double in_first_turn(double coordinate) const {
    return closed_ ? coordinate - kPeriod * std::floor((coordinate - at_.front()) / kPeriod) : coordinate;
  }
  /// The plane nearest to a coordinate of the first turn.
  int nearest(double centre) const {
    const int above = static_cast<int>(std::lower_bound(at_.begin(), at_.end(), centre) - at_.begin());
    if (above == 0) return above;
    const bool last = above >= count_ && !closed_;
    return last || centre - coordinate(above - 1) < coordinate(above) - centre ? above - 1 : above;
  }

 private:
  static constexpr double kPeriod = 2 * std::numbers::pi;
  const std::vector<double>& at_;
  bool closed_;
  int count_;
};

// A body's motion with its axle.
struct RigidMotion {
  RigidMotion(const AxlePose& pose, const Rotation<double>& yaw_turn)
      : shift{pose.x, pose.y, pose.z}, turn(rotation_by(pose.psi)), yaw_by(yaw_turn) {}
  Vec3 displacement(Vec3 arm) const {
    const PlaneVector<double> d = rigid_displacement({shift.x, shift.z}, turn, {arm.x, arm.z});
    const Vec3 straight{d.x, shift.y, d.z};
    return straight + yaw_displacement(yaw_by, rotate(turn, arm));
  }
  Vec3 shift;
  Rotation<double> turn, yaw_by;
};

// Displacement of a node without the rigid motion of a body that turns.
Vec3 elastic_displacement(const Body& body, const Field& u, SectionNode node, int station, const RigidMotion& motion) {
  const BlockLayout& lay = body.layout.blocks[node.block];
  const std::ptrdiff_t i = lay.line(node.node, 0) + station;
  Vec3 d = vector_at(u, i, lay.stride);
  if (body.mesh.kind == SweepKind::revolve)
    d -= motion.displacement(reference_position(body, node.block, node.node, station) - body.mesh.origin);
  return d;
}

// radius: metres per unit of the sweep coordinate. Stations are those of the body in the order in which they lie along
// the rail: backwards of a ring below the wheel.
BandSample band_sample(const Body& body, const ContactBand& band, const SampledBody& at, double centre, double radius,
                       const AxlePose& pose, const Rotation<double>& yaw_turn, double half_length) {
  const BandPlanes planes(body.mesh.blocks[band.block]);
  const int elements = body.layout.blocks[band.block].elements;
  centre = planes.in_first_turn(centre);
  const int middle = planes.nearest(centre);
  // The same number of stations on either side whatever the exact position, so that samples can be averaged station by
  // station.
  const int reach =
      static_cast<int>(std::ceil(half_length / radius / (planes.coordinate(middle + 1) - planes.coordinate(middle))));
  const int first = planes.closed() ? middle - reach : std::max(middle - reach, 0);
  const int last = planes.closed() ? middle + reach : std::min(middle + reach, elements);

  BandSample s;
  s.columns = band.columns;
  s.rows = band.rows;
  s.stations = last - first;
  const bool back = body.mesh.rises();
  const auto plane = [&](int k) { return back ? last - k : first + k; };
  for (int k = 0; k <= s.stations; ++k)
    s.along.push_back((back ? -radius : radius) * (planes.coordinate(plane(k)) - centre));
  for (int k = 0; k < s.stations; ++k) {
    const int station = planes.station(std::min(plane(k), plane(k + 1)));
    if (!body.mesh.blocks[band.block].along.empty()) s.element.push_back(station);
    for (int q = 0; q < band.rows * band.columns; ++q) {
      s.stress.push_back(element_stress(body, at.u, at.history, band.block, q, station));
      if (body.plastic.empty()) continue;
      s.plastic.push_back(element_plasticity(body, pose.psi, at.history, band.block, q, station));
    }
  }
  const RigidMotion motion(pose, yaw_turn);
  const std::vector<int> below = nodes_below(body.mesh);
  for (int k = 0; k <= s.stations; ++k) {
    const auto of = [&](int node) {
      return elastic_displacement(body, at.u, {band.block, node}, planes.station(plane(k)), motion);
    };
    for (int n = 0; n < (band.rows + 1) * (band.columns + 1); ++n) s.displacement.push_back(of(n));
    for (int n : below) s.below.push_back(of(n));
  }
  return s;
}

double sleeper_below(const Stepper& st) {
  const RailPads& pads = st.system().pads;
  return pads.none() ? 0 : st.state().sleepers[sleeper_near(pads, st.position())].z;
}

/// The pressures of the rail's nodes around the wheel; x along the rail.
ContactField pressures_around(const Stepper& st) {
  const ContactSurface& surface = st.system().rail_surface();
  const std::vector<double>& at = surface.stations.at;
  const double middle = st.pose().x, half = sample_half_length(st.system());
  const auto station = [&](double x) {
    return static_cast<int>(std::lower_bound(at.begin(), at.end(), x) - at.begin());
  };
  const int first = station(middle - half);
  ContactField out;
  out.at_points = true;
  out.resize(surface.columns, std::min(station(middle + half), surface.stations.nodes()) - first);
  for (int k = 0; k < out.stations; ++k)
    for (int c = 0; c < out.columns; ++c) {
      const int i = k * out.columns + c;
      out.x[i] = at[first + k];
      out.y[i] = surface.at_contact(c).y;
      out.p[i] = st.state().tractions.at(c, first + k).p;
    }
  out.p_noise = kPressureNoise * st.largest_pressure();
  return out;
}

PatchOnWay patch_on_way(const Stepper& st) {
  const RollingSystem& sys = st.system();
  const ContactSurface &rail = sys.rail_surface(), &wheel = sys.wheel_surface();
  if (!sys.varies_along()) return {};
  PatchOnWay out;
  const AxlePose pose = st.pose();
  out.lowering = -pose.z;
  out.height = rail.heights.at(pose.x, 0).z + wheel.heights.at(wheel.radius * pose.psi, 0).z;
  const ContactField f = pressures_around(st);
  const PatchExtent extent = patch_extent(f);
  out.length = extent.length;
  out.width = extent.width;
  out.patches = contact_regions(f);
  const auto most = std::max_element(f.p.begin(), f.p.end());
  if (most != f.p.end() && *most > 0) out.p_max_x = f.x[static_cast<std::size_t>(most - f.p.begin())];
  return out;
}

StressOnWay stress_on_way(const Stepper& st) {
  StressOnWay out;
  if (!st.system().varies_along() || st.system().on_ring()) return out;
  const Body& rail = st.system().rail();
  const BodyState& state = st.state().bodies[kRail];
  const ContactBand& band = rail.mesh.contact;
  const Stations& stations = rail.mesh.blocks[static_cast<std::size_t>(band.block)].stations;
  const double half = sample_half_length(st.system()), x = st.pose().x;
  for (int e = stations.element_at(x - half); e <= stations.element_at(x + half); ++e)
    for (int q = 0; q < band.rows * band.columns; ++q) {
      const double stress = von_mises(element_stress(rail, state.u, state.history, band.block, q, e));
      if (!(stress > out.von_mises)) continue;
      const int row = q / band.columns;
      out = {stress, stations.centre(e), 0.5 * (band.depth[row] + band.depth[row + 1])};
    }
  return out;
}

std::vector<WatchedStress> stress_at_points(const Stepper& st) {
  std::vector<WatchedStress> out;
  const Body& rail = st.system().rail();
  const BodyState& state = st.state().bodies[kRail];
  const int block = rail.mesh.contact.block;
  for (const WatchedPoint& p : st.system().watched_points)
    out.push_back({element_stress(rail, state.u, state.history, block, p.quad, p.element),
                   element_plasticity(rail, 0, state.history, block, p.quad, p.element).accumulated});
  return out;
}

}  // namespace

RollingSample take_sample(const RollingSystem& sys, const SampledBody& rail, const SampledBody& wheel,
                          const SurfaceTractions& tractions, const AxlePose& pose) {
  RollingSample out;
  const double half = sample_half_length(sys);
  out.position = pose.x;
  const ContactSurface& surface = sys.rail_surface();
  const double below = surface.rises ? surface.contact_at + pose.rail_psi : pose.x;
  out.rail =
      band_sample(sys.rail(), sys.model.rail.contact, rail, below, surface.radius, {0, 0, 0, pose.rail_psi}, {}, half);
  out.wheel = band_sample(sys.wheel(), sys.model.wheel.contact, wheel, pose.psi, sys.rolling_radius, pose,
                          sys.wheel_surface().yaw, half);
  const auto& at = surface.stations.at;
  const int step = surface.rises ? -1 : 1;
  const int first = static_cast<int>(
      std::lower_bound(at.begin(), at.end(), below + step * out.rail.along.front() / surface.radius - 1e-9) -
      at.begin());
  out.first_station = step * first;
  for (int k = 0; k <= out.rail.stations; ++k)
    for (int c = 0; c < surface.columns; ++c) out.tractions.push_back(tractions.at(c, first + step * k));
  return out;
}

RollingSample take_sample(const Stepper& st) {
  const RollingState& state = st.state();
  const BodyState &rail = state.bodies[kRail], &wheel = state.bodies[kWheel];
  const bool ring = st.system().on_ring();
  const Field u_wheel = st.displacement(BodyId::wheel), u_ring = ring ? st.displacement(BodyId::rail) : Field{};
  RollingSample s = take_sample(st.system(), {ring ? u_ring : rail.u, rail.history}, {u_wheel, wheel.history},
                                state.tractions, st.pose());
  s.position = st.position();
  s.time = state.time;
  s.axle = state.axle;
  s.forces = st.forces();
  s.creepage = st.creepage();
  s.lateral_creepage = st.lateral_creepage();
  return s;
}

HistoryRow history_row(const Stepper& st, const EnergyBalance& start) {
  const RollingState& s = st.state();
  const EnergyBalance& now = st.energy();
  return {s.time,
          st.position(),
          st.torque(),
          st.forces(),
          st.largest_pressure(),
          st.creepage(),
          s.axle.vx,
          s.axle.vz,
          s.axle.spin,
          now,
          now.total() - start.total(),
          st.lateral_creepage(),
          s.axle.y,
          foot_height(st.system(), st.position(), s.bodies[kRail].u),
          sleeper_below(st),
          patch_on_way(st),
          stress_on_way(st),
          stress_at_points(st),
          st.interface_gap()};
}

}  // namespace railstrata
