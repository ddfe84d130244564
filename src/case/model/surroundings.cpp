#include "model/surroundings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/rotation.hpp"
#include "geometry/profile_walk.hpp"
#include "geometry/turned_wheel.hpp"

namespace railstrata {
namespace {

constexpr double kStep = 0.1e-3;  // m, along the profiles

double turned_angle(Vec2 tangent) { return std::atan2(tangent.z, tangent.y); }

/// One of the two profiles as it stands in the track.
struct PlacedProfile {
  const Profile& profile;
  const TrackGeometry& track;
  bool is_rail;
  double contact_s;

  Vec2 in_track(Vec2 v) const {
    return is_rail ? rail_to_model(track, v) : roll(rotation_by(std::atan(track.roll)), v);
  }
  double angle(double s) const { return turned_angle(in_track(profile.at(s).tangent)); }
  double clamped(double s) const { return std::clamp(s, profile.s_min(), profile.s_max()); }
  /// Where the body ends on one side of the contact: at the end of its profile, or where a convex body has turned away
  /// from the contact plane.
  Vec2 end(int direction) const {
    constexpr double kAway = std::numbers::pi / 4;
    const double last = direction > 0 ? profile.s_max() : profile.s_min();
    const Vec2 facing = roll(rotation_by((is_rail ? kAway : -kAway) * direction), profile.at(contact_s).tangent);
    const double s = last_facing(profile, contact_s, direction * kStep, facing, 0);
    return profile.at((last - s) * direction > kStep ? s + direction * kStep : s).position;
  }
  /// t of a point in the contact plane.
  double along_plane(Vec2 point) const {
    const ProfilePoint contact = profile.at(contact_s);
    return dot(point - contact.position, contact.tangent);
  }
};

void measure_turn(const PlacedProfile& rail, const PlacedProfile& wheel, const SolvedPatch& patch, PatchEdges& out) {
  constexpr int kPieces = 64;
  const auto at = [&](const PlacedProfile& body, int i) {
    return body.angle(body.clamped(body.contact_s + patch.low + (patch.high - patch.low) * i / kPieces));
  };
  std::vector<double> of_rail, of_wheel, between;
  for (int i = 0; i <= kPieces; ++i) {
    of_rail.push_back(at(rail, i));
    of_wheel.push_back(at(wheel, i));
    between.push_back(of_wheel.back() - of_rail.back());
  }
  const auto range = [](const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high - *low;
  };
  out.angle_spanned = std::max(range(of_rail), range(of_wheel));
  out.half_width_over_radius = 0.5 * range(between);
}

/// The nearest edge so far.
class NearestEdge {
 public:
  NearestEdge(const SolvedPatch& patch, PatchEdges& out)
      : middle_(0.5 * (patch.low + patch.high)), half_(0.5 * (patch.high - patch.low)), out_(out) {}
  /// At t in the contact plane, on the side of `direction`; y in its body's own frame.
  void offer(double t, int direction, const std::string& what, double y) {
    const double distance = std::max((t - middle_) * direction, half_), share = half_ / distance;
    if (share <= out_.edge_share) return;
    out_.edge_share = share;
    out_.edge = fmt::format("{} at y = {:.1f} mm", what, 1e3 * y);
  }

 private:
  double middle_, half_;
  PatchEdges& out_;
};

void measure_edges(const CaseSpec& spec, const PlacedProfile& rail, const PlacedProfile& wheel,
                   const SolvedPatch& patch, PatchEdges& out) {
  NearestEdge nearest(patch, out);
  const auto lateral = [&](const PlacedProfile& body, double y) {
    const ProfilePoint contact = body.profile.at(body.contact_s);
    return (y - contact.position.y) / std::max(contact.tangent.y, 0.05);
  };
  for (const int direction : {-1, 1}) {
    for (const PlacedProfile* body : {&rail, &wheel}) {
      const Vec2 end = body->end(direction);
      nearest.offer(body->along_plane(end), direction, body->is_rail ? "the side of the rail" : "the side of the wheel",
                    end.y);
    }
    if (const double y = 0.5 * direction * spec.geometry.block_width; spec.geometry.rail_shape == RailShape::block)
      nearest.offer(lateral(rail, y), direction, "the side of the block", y);
    for (const LayerSpec& layer : spec.layers) {
      const double y = direction > 0 ? layer.high() : layer.low();
      if (!(layer.thickness_at(y) > 0)) continue;  // it has run out
      nearest.offer(lateral(layer.on == BodyId::rail ? rail : wheel, y), direction,
                    fmt::format("the edge of the {}'s layer \"{}\"", body_word(layer.on), layer.name), y);
    }
  }
}

/// PatchSurroundings::layer_change of one layer.
double change_of(const LayerSpec& layer, const PlacedProfile& body, const SolvedPatch& patch) {
  if (!layer.varies_across()) return 0;
  constexpr int kPieces = 64;
  double least = HUGE_VAL, most = 0;
  for (int i = 0; i <= kPieces; ++i) {
    const double s = body.clamped(body.contact_s + patch.low + (patch.high - patch.low) * i / kPieces),
                 thickness = layer.thickness_at(body.profile.at(s).position.y);
    least = std::min(least, thickness);
    most = std::max(most, thickness);
  }
  return (most - least) / largest_value(layer.thickness_table);
}

std::optional<FlangePlace> flange_place(const Placement& p) {
  if (p.wheel.primitive() || p.rail.primitive()) return {};
  const TurnedWheel wheel(p.wheel, p.track);
  const auto section = [&](double s) { return wheel.section(p.wheel.at(s).position); };
  Vec2 crest = section(p.wheel.s_min());
  const auto places = static_cast<std::size_t>((p.wheel.s_max() - p.wheel.s_min()) / kStep) + 1;
  for (const Vec2 place : even_positions(p.wheel, p.wheel.s_min(), kStep, places))
    if (const Vec2 at = wheel.section(place); at.z < crest.z) crest = at;
  return FlangePlace{-crest.z, -section(p.contact.wheel_s).z,
                     crest.y + p.contact.wheel_offset_y - gauge_face_y(p.rail, p.track)};
}

/// The overlap of the rigid bodies after the descent, place by place over the rail's running surface.
struct OverlapSample {
  double s = 0;
  bool overlaps = false;  ///< of the rigid bodies
  bool covered = false;
  SecondContact place;  ///< less the depression by the patch
};

OverlapSample overlap_at(double s, double descent, double depression, const Placement& p, const SolvedPatch& patch) {
  OverlapSample out;
  out.s = s;
  const ProfilePoint rail = p.rail.at(s);
  const Vec2 point = rail_to_model(p.track, rail.position);
  const double wheel_y = point.y - p.contact.wheel_offset_y;
  if (wheel_y < p.wheel.y_min() || wheel_y > p.wheel.y_max()) return out;
  const double gap = p.wheel.height(wheel_y) + p.contact.wheel_offset_z - point.z,
               angle = turned_angle(rail_to_model(p.track, rail.tangent));
  const Vec2 from_contact = point - p.contact.point, tangent{std::cos(p.contact.angle), std::sin(p.contact.angle)};
  const double t = dot(from_contact, tangent),
               distance = std::hypot(t - 0.5 * (patch.low + patch.high), dot(from_contact, {-tangent.z, tangent.y}));
  out.overlaps = gap < descent;
  out.covered = t >= patch.covered_low && t <= patch.covered_high;
  out.place = {(descent - gap) * std::cos(angle) - depression / std::max(distance, kStep), rail.position.y, wheel_y,
               angle};
  return out;
}

}  // namespace

PatchSurroundings patch_surroundings(const CaseSpec& spec, const Placement& p, const SolvedPatch& patch) {
  const PlacedProfile rail{p.rail, p.track, true, p.contact.rail_s}, wheel{p.wheel, p.track, false, p.contact.wheel_s};
  PatchSurroundings out;
  measure_turn(rail, wheel, patch, out.edges);
  measure_edges(spec, rail, wheel, patch, out.edges);
  const RigidContact& c = p.contact;
  out.curvature_rolling =
      std::max(std::cos(c.angle - c.roll) / c.rolling_radius, std::cos(c.angle) * std::abs(c.rail_turn));
  out.flange = flange_place(p);
  for (const LayerSpec& layer : spec.layers)
    out.layer_change = std::max(out.layer_change, change_of(layer, layer.on == BodyId::rail ? rail : wheel, patch));
  const auto locate = [&](const PlacedProfile& body, double& y, double& reach) {
    const ProfilePoint contact = body.profile.at(body.contact_s);
    y = contact.position.y;
    reach = std::max(std::abs(y + patch.low * contact.tangent.y), std::abs(y + patch.high * contact.tangent.y));
  };
  locate(rail, out.rail_y, out.rail_reach);
  locate(wheel, out.wheel_y, out.wheel_reach);
  return out;
}

std::optional<SecondContact> second_contact(const CaseSpec& spec, const Placement& p, const SolvedPatch& patch) {
  const double depression = patch.normal_force / (std::numbers::pi * modulus_of(spec)),
               descent = patch.approach / std::cos(p.contact.angle);
  const double begin = p.rail.s_at_y(p.rail.y_min()), end = p.rail.s_at_y(p.rail.y_max());
  std::vector<OverlapSample> samples;
  for (double s = begin; s <= end; s += kStep) samples.push_back(overlap_at(s, descent, depression, p, patch));

  // the stretch of overlap around the rigid contact is the patch's own
  const auto contact =
      std::find_if(samples.begin(), samples.end(), [&](const OverlapSample& o) { return o.s >= p.contact.rail_s; });
  for (auto o = contact; o != samples.end() && o->overlaps; ++o) o->covered = true;
  for (auto o = contact; o != samples.begin() && std::prev(o)->overlaps; --o) std::prev(o)->covered = true;

  std::optional<SecondContact> out;
  for (const OverlapSample& o : samples)
    if (o.overlaps && !o.covered && o.place.overlap > (out ? out->overlap : 0)) out = o.place;
  return out;
}

}  // namespace railstrata
