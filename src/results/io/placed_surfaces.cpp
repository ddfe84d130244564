#include "io/placed_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/turned_wheel.hpp"

namespace railstrata {
namespace {

constexpr double kSurfaceSpacing = 1e-3, kSurfaceReach = 80e-3, kHalfLength = 0.1;
constexpr int kStations = 21, kAngles = 181;

std::vector<Vec2> outline(const Profile& profile, double contact_s) {
  const double begin = std::max(profile.s_min(), contact_s - kSurfaceReach),
               end = std::min(profile.s_max(), contact_s + kSurfaceReach);
  const int pieces = static_cast<int>(std::ceil((end - begin) / kSurfaceSpacing));
  std::vector<Vec2> out;
  for (int k = 0; k <= pieces; ++k)
    out.push_back(profile.at(k == pieces ? end : begin + (end - begin) * k / pieces).position);
  return out;
}

VtkQuads swept(const std::vector<Vec2>& line, int stations, const std::function<Vec3(Vec2, int)>& at) {
  VtkQuads mesh;
  const auto n = static_cast<long long>(line.size());
  for (int s = 0; s < stations; ++s)
    for (const Vec2& p : line) mesh.points.push_back(at(p, s));
  for (long long s = 0; s + 1 < stations; ++s)
    for (long long k = 0; k + 1 < n; ++k)
      mesh.cells.push_back({s * n + k, (s + 1) * n + k, (s + 1) * n + k + 1, s * n + k + 1});
  return mesh;
}

}  // namespace

VtkQuads rail_surface(const Placement& placement, double wheel_x) {
  return swept(outline(placement.rail, placement.contact.rail_s), kStations, [&](Vec2 p, int s) {
    const Vec2 q = rail_to_model(placement.track, p);
    const double along = kHalfLength * (2.0 * s / (kStations - 1) - 1), radius = placement.track.rail_radius + q.z;
    if (!std::isfinite(radius)) return Vec3{wheel_x + along, q.y, q.z};
    const double angle = along / std::max(std::abs(radius), kHalfLength / std::numbers::pi);
    return Vec3{wheel_x + std::abs(radius) * std::sin(angle), q.y, q.z - radius * (1 - std::cos(angle))};
  });
}

VtkQuads wheel_surface(const Placement& placement, double wheel_x) {
  const RigidContact& c = placement.contact;
  const TurnedWheel turned(placement.wheel, placement.track);
  return swept(outline(placement.wheel, c.wheel_s), kAngles, [&](Vec2 p, int s) {
    const double radius = placement.track.wheel_radius - p.z, t = 2 * std::numbers::pi * s / (kAngles - 1);
    const double along = radius * std::sin(t);
    const Vec2 section = turned.section({p.y, placement.track.wheel_radius - radius * std::cos(t)});
    return Vec3{wheel_x - c.x + along * std::cos(c.yaw) - section.y * std::sin(c.yaw),
                c.wheel_offset_y + section.y * std::cos(c.yaw) + along * std::sin(c.yaw), c.wheel_offset_z + section.z};
  });
}

void write_placed_surfaces(const std::filesystem::path& folder, const Placement& placement, double wheel_x) {
  write_vtp(folder / "rail_surface.vtp", rail_surface(placement, wheel_x));
  write_vtp(folder / "wheel_surface.vtp", wheel_surface(placement, wheel_x));
}

}  // namespace railstrata
