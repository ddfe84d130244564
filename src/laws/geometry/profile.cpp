#include "geometry/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/faults.hpp"
#include "core/rotation.hpp"
#include "geometry/point_defects.hpp"
#include "geometry/smoothing_spline.hpp"

namespace railstrata {
namespace {

constexpr double kJoin = 1e-9;  // m
constexpr double kLongestDetour =
    1.25;  // of the curve over the chords between its points; 1.21 where these turn by 120 degrees

/// Signed angle from p0 to p1 about the centre, positive anticlockwise.
double sweep(const ProfileSegment& g) {
  const Vec2 a = g.p0 - g.centre, b = g.p1 - g.centre;
  return std::atan2(cross(a, b), dot(a, b));
}

double length(const ProfileSegment& g) { return g.radius > 0 ? g.radius * std::abs(sweep(g)) : norm(g.p1 - g.p0); }

void require_joined(const std::vector<ProfileSegment>& segments) {
  if (segments.empty()) throw std::invalid_argument("a profile needs at least one segment");
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const ProfileSegment& g = segments[i];
    if (i > 0 && norm(g.p0 - segments[i - 1].p1) > kJoin) throw std::invalid_argument("profile segments do not join");
    if (g.radius > 0 &&
        (std::abs(norm(g.p0 - g.centre) - g.radius) > kJoin || std::abs(norm(g.p1 - g.centre) - g.radius) > kJoin))
      throw std::invalid_argument("the ends of an arc are not on its circle");
  }
}

void require_following(const std::string& name, const SmoothingSpline& spline, const std::vector<Vec2>& points) {
  double chords = 0;
  for (std::size_t i = 1; i < points.size(); ++i) chords += norm(points[i] - points[i - 1]);
  if (!(spline.s.back() - spline.s.front() < kLongestDetour * chords))
    throw CaseError(name + ": the smooth curve through the points swings far out between them",
                    "remove stray points, or give more of them where the curve bends");
  const std::string remedy = "remove points that are almost identical, or add points where they are far apart";
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double miss = std::max(spline.miss[i - 1], spline.miss[i]);
    if (!(miss < std::max(2 * spline.tolerance, norm(points[i] - points[i - 1]))))
      throw CaseError(
          fmt::format("{}: the smooth curve misses points {} and {} by more than their distance ({:.3g} mm)", name, i,
                      i + 1, 1e3 * miss),
          remedy);
  }
  if (std::adjacent_find(spline.s.begin(), spline.s.end(), [](double a, double b) { return !(b - a > kJoin); }) !=
      spline.s.end())
    throw CaseError(name + ": the smooth curve through the points has a segment of zero length", remedy);
}

}  // namespace

Profile Profile::from_segments(ProfileKind kind, std::string name, std::vector<ProfileSegment> segments) {
  require_joined(segments);
  Profile out;
  out.kind_ = kind;
  out.name_ = std::move(name);
  out.s_ = {0.0};
  for (const ProfileSegment& g : segments) out.s_.push_back(out.s_.back() + length(g));
  out.segments_ = std::move(segments);
  out.set_origin();
  return out;
}

Profile Profile::from_points(ProfileKind kind, std::string name, const std::vector<Vec2>& points, double rounding,
                             double knots_moved) {
  if (const auto defect = find_defect(points)) throw CaseError(name + ": " + defect->message, defect->remedy);
  SmoothingSpline spline = fit_smoothing_spline(points, rounding, knots_moved);
  require_following(name, spline, points);
  Profile out;
  out.kind_ = kind;
  out.name_ = std::move(name);
  out.listed_ = std::make_shared<const ListedPoints>(ListedPoints{points, scatter_of(points, rounding)});
  out.s_ = std::move(spline.s);
  out.p_ = std::move(spline.p);
  out.d2_ = std::move(spline.d2);
  out.set_origin();
  return out;
}

Profile Profile::upturned() const {
  Profile out = *this;
  out.listed_.reset();
  out.kind_ = kind_ == ProfileKind::rail ? ProfileKind::wheel : ProfileKind::rail;
  for (ProfileSegment& g : out.segments_)
    for (Vec2* p : {&g.p0, &g.p1, &g.centre}) p->z = -p->z;
  for (std::vector<Vec2>* values : {&out.p_, &out.d2_})
    for (Vec2& v : *values) v.z = -v.z;
  return out;
}

double Profile::s_min() const { return s_.front(); }
double Profile::s_max() const { return s_.back(); }

std::size_t Profile::piece_of(double s) const {
  const auto after = std::upper_bound(s_.begin() + 1, s_.end() - 1, s);
  return static_cast<std::size_t>(after - s_.begin()) - 1;
}

Profile::Local Profile::local(std::size_t i, double s) const {
  const double h = s_[i + 1] - s_[i];
  if (!segments_.empty()) {
    const ProfileSegment& g = segments_[i];
    if (g.radius <= 0) {
      const Vec2 t = (1 / h) * (g.p1 - g.p0);
      return {g.p0 + (s - s_[i]) * t, t, {}};
    }
    const Vec2 a = g.p0 - g.centre;
    const double sense = cross(a, g.p1 - g.centre) > 0 ? 1.0 : -1.0;  // 1: anticlockwise
    const Vec2 arm = roll(rotation_by(sense * (s - s_[i]) / g.radius), a);
    return {g.centre + arm, (sense / g.radius) * Vec2{-arm.z, arm.y}, (-1 / (g.radius * g.radius)) * arm};
  }
  const double a = (s_[i + 1] - s) / h, b = (s - s_[i]) / h;
  return {a * p_[i] + b * p_[i + 1] + (h * h / 6) * ((a * a * a - a) * d2_[i] + (b * b * b - b) * d2_[i + 1]),
          (1 / h) * (p_[i + 1] - p_[i]) + (h / 6) * ((1 - 3 * a * a) * d2_[i] + (3 * b * b - 1) * d2_[i + 1]),
          a * d2_[i] + b * d2_[i + 1]};
}

ProfilePoint Profile::at(double s) const {
  if (!(s >= s_min() - kJoin && s <= s_max() + kJoin))
    throw std::out_of_range(name_ + ": arc length outside the profile");
  const Local c = local(piece_of(s), s);
  const double speed = norm(c.d1), side = kind_ == ProfileKind::rail ? 1.0 : -1.0;
  const Vec2 t = (1 / speed) * c.d1;
  return {c.position, t, side * Vec2{-t.z, t.y}, -side * cross(c.d1, c.d2) / (speed * speed * speed)};
}

double Profile::s_at_y_within(std::size_t piece, double y, double lo, double hi) const {
  double s = 0.5 * (lo + hi);
  if (!knot_y_.empty()) {  // by the chord
    const double share = (y - knot_y_[piece]) / (knot_y_[piece + 1] - knot_y_[piece]);
    const double guess = s_[piece] + share * (s_[piece + 1] - s_[piece]);
    if (guess > lo && guess < hi) s = guess;
  }
  for (int i = 0; i < 100 && hi - lo > 0; ++i) {
    const Local c = local(piece, s);
    const double error = c.position.y - y;
    (error > 0 ? hi : lo) = s;
    double next = s - error / c.d1.y;
    if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
    if (std::abs(next - s) < 1e-15) return next;
    s = next;
  }
  return s;
}

double Profile::s_at_y(double y) const {
  if (!(y >= y_min() - kJoin && y <= y_max() + kJoin))
    throw std::out_of_range(name_ + ": no running surface at this lateral coordinate");
  if (y <= y_min()) return graph_begin_;
  if (y >= y_max()) return graph_end_;
  const auto begin = knot_y_.begin() + static_cast<std::ptrdiff_t>(piece_of(graph_begin_)),
             end = knot_y_.begin() + static_cast<std::ptrdiff_t>(piece_of(graph_end_));
  const std::size_t piece = static_cast<std::size_t>(std::upper_bound(begin + 1, end + 1, y) - knot_y_.begin()) - 1;
  return s_at_y_within(piece, y, std::max(s_[piece], graph_begin_),
                       std::min(s_[piece + 1], graph_end_));  // beyond, a piece may fold back
}

double Profile::turning_of_slope(std::size_t piece, double near, double far) const {
  if (!segments_.empty()) return far;
  const double begin = d2_[piece].y, end = d2_[piece + 1].y;
  if (!(begin * end < 0)) return far;
  const double s = s_[piece] + (s_[piece + 1] - s_[piece]) * begin / (begin - end);
  return (s - near) * (s - far) < 0 ? s : far;
}

double Profile::graph_end(bool towards_field) const {
  const std::size_t pieces = s_.size() - 1;
  for (std::size_t i = piece_of(0.0); i < pieces; towards_field ? ++i : --i) {  // --i past zero wraps and ends the loop
    const double near = i == piece_of(0.0) ? 0.0 : s_[towards_field ? i : i + 1], far = s_[towards_field ? i + 1 : i];
    if (local(i, near).d1.y <= 0) return near;
    const double steepest = turning_of_slope(i, near, far), end = local(i, steepest).d1.y <= 0 ? steepest : far;
    if (local(i, end).d1.y > 0) continue;
    double good = near, bad = end;
    for (int k = 0; k < 80; ++k) {
      const double middle = 0.5 * (good + bad);
      (local(i, middle).d1.y > 0 ? good : bad) = middle;
    }
    return good;
  }
  return towards_field ? s_max() : s_min();
}

void Profile::set_origin() {
  const std::size_t pieces = s_.size() - 1;
  std::size_t crossing = pieces;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < pieces; ++i) {
    const Vec2 a = local(i, s_[i]).position, b = local(i, s_[i + 1]).position;
    const double height = std::min(std::abs(a.z), std::abs(b.z));
    if (a.y <= 0 && b.y >= 0 && a.y < b.y && height < nearest) {
      crossing = i;
      nearest = height;
    }
  }
  if (crossing == pieces)
    throw CaseError(
        name_ + ": the profile does not cover y = 0",
        "move the origin to the rail's axis or the wheel's tape circle; y must increase towards the field side");
  const double zero = s_at_y_within(crossing, 0.0, s_[crossing], s_[crossing + 1]);
  for (double& s : s_) s -= zero;
  for (std::size_t i = 0; i < s_.size(); ++i) knot_y_.push_back(local(std::min(i, pieces - 1), s_[i]).position.y);
  graph_begin_ = graph_end(false);
  graph_end_ = graph_end(true);
  graph_y_begin_ = at(graph_begin_).position.y;
  graph_y_end_ = at(graph_end_).position.y;
  if (!(graph_y_begin_ <= 0 && graph_y_end_ >= 0 && graph_y_begin_ < graph_y_end_))
    throw CaseError(name_ + ": the profile turns back at y = 0",
                    "correct or smooth the points near y = 0; y must increase towards the field side there");
}

}  // namespace railstrata
