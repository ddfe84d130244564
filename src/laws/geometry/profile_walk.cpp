#include "geometry/profile_walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/rotation.hpp"

namespace railstrata {
namespace {

/// 1: the arc is walked anticlockwise.
double sense(const ProfileSegment& g) { return cross(g.p0 - g.centre, g.p1 - g.centre) > 0 ? 1.0 : -1.0; }

/// Not normalised.
Vec2 tangent_at(const ProfileSegment& g, Vec2 end) {
  if (g.radius <= 0) return g.p1 - g.p0;
  const Vec2 arm = end - g.centre;
  return sense(g) * Vec2{-arm.z, arm.y};
}

/// Those of an arc of less than half a turn lie between the ones at its ends.
bool all_tangents_face(const ProfileSegment& g, Vec2 direction, double cosine) {
  const auto faces = [&](Vec2 t) { return dot(t, direction) > cosine * norm(t); };
  return faces(tangent_at(g, g.p0)) && faces(tangent_at(g, g.p1));
}

}  // namespace

std::vector<Vec2> even_positions(const Profile& profile, double begin, double step, std::size_t count) {
  constexpr std::size_t kRun = 32;  // turns of one arm: round-off adds up
  std::vector<Vec2> out(count);
  const auto place = [&](std::size_t k) { return begin + static_cast<double>(k) * step; };
  for (std::size_t first = 0, stop = 0; first < count; first = stop) {
    stop = first + 1;
    out[first] = profile.at(place(first)).position;
    if (profile.segments().empty()) continue;
    const std::size_t piece = profile.piece_of(place(first));
    const ProfileSegment& g = profile.segments()[piece];
    while (stop < std::min(count, first + kRun) && profile.piece_of(place(stop)) == piece) ++stop;
    const Vec2 along = (step / (profile.knots()[piece + 1] - profile.knots()[piece])) * (g.p1 - g.p0);
    const Rotation<double> turn = rotation_by(g.radius > 0 ? sense(g) * step / g.radius : 0.0);
    for (std::size_t k = first + 1; k < stop; ++k)
      out[k] = g.radius > 0 ? g.centre + roll(turn, out[k - 1] - g.centre) : out[k - 1] + along;
  }
  if (count > 0) profile.at(place(count - 1));  // within the curve
  return out;
}

double last_facing(const Profile& profile, double begin, double step, Vec2 direction, double cosine) {
  const double end = step > 0 ? profile.s_max() : profile.s_min();
  const auto place = [&](double k) { return begin + k * step; };
  for (double k = 0;;) {
    if (!((end - place(k)) / step > 1)) return place(k);
    const double next = place(k + 1);
    const std::size_t piece = profile.piece_of(next);
    if (!profile.segments().empty() && all_tangents_face(profile.segments()[piece], direction, cosine)) {
      const double border = profile.knots()[step > 0 ? piece + 1 : piece];
      k = std::max(k + 1, std::ceil((border - begin) / step) - 1);
      continue;
    }
    if (!(dot(profile.at(next).tangent, direction) > cosine)) return place(k);
    ++k;
  }
}

RunningSurface::RunningSurface(const Profile& profile) : profile_(profile) {
  if (profile.segments().empty()) return;
  const std::size_t first = profile.piece_of(profile.s_at_y(profile.y_min())),
                    last = profile.piece_of(profile.s_at_y(profile.y_max()));
  for (std::size_t i = first; i <= last; ++i) {
    const ProfileSegment& g = profile.segments()[i];
    const Vec2 along = g.p1 - g.p0;
    pieces_.push_back({g.p0, g.centre, i == last ? std::numeric_limits<double>::infinity() : g.p1.y, along.z / along.y,
                       g.radius > 0 ? norm(g.p0 - g.centre) : 0.0, -sense(g)});
  }
}

SurfacePlace RunningSurface::place(double y) {
  if (pieces_.empty()) return place_on(profile_, y);
  while (y >= pieces_[at_].end_y) ++at_;
  while (at_ > 0 && y < pieces_[at_ - 1].end_y) --at_;
  const Piece& g = pieces_[at_];
  if (g.radius == 0) return {g.begin.z + (y - g.begin.y) * g.slope, g.slope};
  const double across = y - g.centre.y, up = std::sqrt(std::max(0.0, (g.radius - across) * (g.radius + across)));
  return {g.centre.z + g.side * up, -g.side * across / up};
}

SurfacePlace place_on(const Profile& profile, double y) {
  const ProfilePoint p = profile.at(profile.s_at_y(y));
  return {p.position.z, p.tangent.z / p.tangent.y};
}

}  // namespace railstrata
