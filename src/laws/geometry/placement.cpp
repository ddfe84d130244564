#include "geometry/placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/faults.hpp"
#include "geometry/profile_walk.hpp"
#include "geometry/turned_wheel.hpp"

namespace railstrata {
namespace {

constexpr double kSearchStep = 0.05e-3;  // m, along the rail
constexpr double kCandidate = 1e-7;      // m: a minimum this close to the lowest sample may be the lowest of all
constexpr double kEqual = 1e-12;         // m: gaps closer than this are equal

/// Lowest point of the yawed wheel in a plane y = const: its coordinates in the wheel's own frame.
struct LowestPoint {
  double x = 0, y = 0;
};

/// x in the model frame, from the middle of the tape circle.
double along_rail(const TrackGeometry& track, const LowestPoint& p) {
  return (p.x - p.y * track.yaw) / std::hypot(1.0, track.yaw);
}

/// At the distance y from the middle of the tape circle, where the gap is least along the rail, which has the radius R
/// there. On the wheel's circle of radius r, at x of its own frame and the depth d, that is where
///   x (1 + d/D) = (r dz/dy + y d/D) tan(psi),   D the depth of the rail's axle.
/// place: SurfacePlace of the wheel at a y.
template <class Place>
LowestPoint lowest_point(const Profile& wheel, Place&& place, const TrackGeometry& track, double y,
                         double rail_radius) {
  constexpr double kClose = 1e-13;
  constexpr int kMostSteps = 50;
  const double yaw = std::atan(track.yaw), sine = std::sin(yaw), cosine = std::cos(yaw);
  LowestPoint p{0, y};
  for (int i = 0; i < kMostSteps; ++i) {
    const SurfacePlace w = place(p.y);
    const double radius = track.wheel_radius - w.height;
    p.x = radius * w.slope * track.yaw;
    if (std::isfinite(rail_radius)) {
      const double depths = std::sqrt(radius * radius - p.x * p.x) / axle_depth(rail_radius, along_rail(track, p));
      p.x = (p.x + p.y * depths * track.yaw) / (1 + depths);
    }
    const double next = std::clamp((y - p.x * sine) / cosine, wheel.y_min(), wheel.y_max());
    const bool settled = std::abs(next - p.y) < kClose;
    p.y = next;
    if (settled) break;
  }
  return p;
}

/// Vertical gap between the wheel, its tape circle at (offset_y, 0), and the canted rail.
class Gap {
 public:
  Gap(const Profile& wheel, const Profile& rail, const TrackGeometry& track, double offset_y)
      : wheel_(wheel),
        rail_(rail),
        track_(track),
        cant_(rotation_of_tangent(track.cant)),
        offset_y_(offset_y),
        turned_(wheel, track),
        wheel_begin_(rolled() ? turned_.y_begin() : wheel.y_min()),
        wheel_end_(rolled() ? turned_.y_end() : wheel.y_max()) {}

  /// A rolled wheel has its own way through `outline`; the members about its upright one then do not apply.
  bool rolled() const { return track_.roll != 0; }
  double wheel_s(double s) const { return turned_.s_at_y(wheel_y(s)); }
  TurnedPoint outline(double s) const { return turned_.outline(wheel_s(s)); }

  /// Model frame.
  Vec2 rail_point(double s) const { return roll(cant_, rail_.at(s).position); }
  double wheel_y(double s) const { return rail_point(s).y - offset_y_; }
  LowestPoint on_wheel(double s) const { return lowest_at(rail_point(s)); }
  double value(double s) const { return over(s, rail_point(s)); }
  /// What the places of a search are looked up with.
  struct WalkedWheel {
    RunningSurface upright;
    OutlineWalk outline;
  };
  WalkedWheel walk() const { return {RunningSurface(wheel_), OutlineWalk(turned_)}; }
  /// The same at a place of the rail, in its own frame; nothing where that does not face the wheel.
  struct Faced {
    double gap = 0, x = 0;  ///< x: of GapSamples
  };
  std::optional<Faced> faced(Vec2 on_rail, WalkedWheel& wheel) const {
    const Vec2 rail = roll(cant_, on_rail);
    const double y = rail.y - offset_y_;
    if (!(y >= wheel_begin_ && y <= wheel_end_)) return {};
    if (rolled()) return Faced{wheel.outline.height(y) - rail.z, wheel.outline.x()};
    if (track_.yaw == 0) return Faced{wheel.upright.height(y) - rail.z, 0};
    const LowestPoint p = lowest_point(
        wheel_, [&](double at) { return wheel.upright.place(at); }, track_, y, rail_radius(rail.z));
    return Faced{over(rail, p, wheel.upright.height(p.y)), along_rail(track_, p)};
  }
  /// x of GapSamples at any place.
  double x(double s) const { return rolled() ? outline(s).position.x : along_rail(track_, on_wheel(s)); }
  double derivative(double s) const {
    if (rolled()) {
      const Vec2 rail = rail_to_model(track_, rail_.at(s).tangent), wheel = outline(s).along;
      return rail.y * wheel.z / wheel.y - rail.z;
    }
    const LowestPoint p = on_wheel(s);
    const Vec2 t = roll(cant_, rail_.at(s).tangent), w = wheel_.at(wheel_.s_at_y(p.y)).tangent;
    return t.y * wheel_slope(w.z / w.y, p) - t.z * rail_steeper(s, p);
  }
  /// Depth of a point of the wheel below the axle, m.
  double depth(const LowestPoint& p) const {
    const double radius = track_.wheel_radius - wheel_.height(p.y);
    return std::sqrt((radius - p.x) * (radius + p.x));
  }
  /// Radius of the rail along rolling at a height of the model frame.
  double rail_radius(double z) const { return track_.rail_radius + z; }

 private:
  LowestPoint lowest_at(Vec2 rail) const {
    const double wheel_y = rail.y - offset_y_;
    if (track_.yaw == 0) return {0, wheel_y};
    return lowest_point(
        wheel_, [&](double y) { return place_on(wheel_, y); }, track_, wheel_y, rail_radius(rail.z));
  }
  double over(double s, Vec2 rail) const {
    if (rolled()) return outline(s).position.z - rail.z;
    const LowestPoint p = lowest_at(rail);
    return over(rail, p, wheel_.height(p.y));
  }
  double over(Vec2 rail, const LowestPoint& p, double height) const {
    return height + rise(p, height) - (rail.z - drop(rail.z, p));
  }
  /// By how much the point lies above the lowest one of its circle.
  double rise(const LowestPoint& p, double height) const {
    const double radius = track_.wheel_radius - height;
    return p.x == 0 ? 0.0 : radius - std::sqrt((radius - p.x) * (radius + p.x));
  }
  /// The same of a rail that is curved along rolling, below its highest one.
  double drop(double z, const LowestPoint& p) const {
    return track_.yaw == 0 ? 0.0 : rail_drop(rail_radius(z), along_rail(track_, p));
  }
  /// Slope across the rail, at the same x, where the profile has `of_profile`.
  double wheel_slope(double of_profile, const LowestPoint& p) const {
    if (track_.yaw == 0) return of_profile;
    const double radius = track_.wheel_radius - wheel_.height(p.y);
    return (radius * of_profile + p.x * track_.yaw) / (depth(p) * std::hypot(1.0, track_.yaw));
  }
  /// The rail's slope across over its profile's.
  double rail_steeper(double s, const LowestPoint& p) const {
    if (track_.yaw == 0 || !std::isfinite(track_.rail_radius)) return 1.0;
    const double radius = rail_radius(rail_point(s).z);
    return radius / axle_depth(radius, along_rail(track_, p));
  }

  const Profile &wheel_, &rail_;
  const TrackGeometry& track_;
  Rotation<double> cant_;
  double offset_y_;
  TurnedWheel turned_;
  double wheel_begin_, wheel_end_;
};

}  // namespace

double gauge_face_y(const Profile& rail, const TrackGeometry& track) {
  const Rotation<double> cant = rotation_of_tangent(track.cant);
  const auto at = [&](double s) { return roll(cant, rail.at(s).position); };
  double top = -std::numeric_limits<double>::infinity(), top_s = 0;
  const std::size_t n = static_cast<std::size_t>(std::ceil((rail.s_max() - rail.s_min()) / kSearchStep));
  const double step = (rail.s_max() - rail.s_min()) / static_cast<double>(n);
  const std::vector<Vec2> places = even_positions(rail, rail.s_min(), step, n + 1);
  for (std::size_t i = 0; i <= n; ++i)
    if (const double z = roll(cant, places[i]).z; z > top) {
      top = z;
      top_s = rail.s_min() + static_cast<double>(i) * step;
    }
  const double wanted = top - track.gauge_depth;
  double above = top_s, below = rail.s_min();
  if (at(below).z > wanted)
    throw CaseError(
        fmt::format(
            "the rail profile {} ends {:.1f} mm below its top on the gauge side, above the gauge depth of {:.1f} mm",
            rail.name(), 1e3 * (top - at(below).z), 1e3 * track.gauge_depth),
        "give a profile that reaches further down the gauge face, or a smaller gauge_depth");
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (above + below);
    (at(middle).z > wanted ? above : below) = middle;
  }
  return at(above).y;
}

namespace {

double lateral_offset(const Profile& wheel, const Profile& rail, const TrackGeometry& track) {
  if (wheel.primitive() || rail.primitive()) return track.lateral_shift;
  const double tape_circle = 0.5 * track.back_to_back + track.flange_back_to_tape,
               rail_axis = 0.5 * track.gauge - gauge_face_y(rail, track);
  return tape_circle - rail_axis + track.lateral_shift;
}

GapSamples sample_overlap(const Gap& gap, const Profile& rail) {
  const double begin = rail.s_at_y(rail.y_min()), end = rail.s_at_y(rail.y_max());
  const int n = std::max(10, static_cast<int>(std::ceil((end - begin) / kSearchStep)));
  const std::vector<Vec2> places = even_positions(rail, begin, (end - begin) / n, static_cast<std::size_t>(n) + 1);
  Gap::WalkedWheel walked = gap.walk();
  GapSamples out;
  for (int i = 0; i <= n; ++i) {
    const double s = i == n ? end : begin + (end - begin) * i / n;
    const std::optional<Gap::Faced> faced = gap.faced(places[static_cast<std::size_t>(i)], walked);
    if (!faced) continue;
    out.add(s, faced->gap, faced->x);
  }
  return out;
}

/// Those of a known place, looked at anew where its wheel comes near.
GapSamples sample_again(const Gap& gap, const Profile& rail, const KnownPlace& known) {
  constexpr double kNear = 10e-6;  // m
  const GapSamples& before = *known.contact->searched;
  const double reached = known.descent - known.contact->wheel_offset_z + kNear;
  Gap::WalkedWheel walked = gap.walk();
  GapSamples out;
  for (std::size_t i = 0; i < before.s.size(); ++i) {
    std::optional<Gap::Faced> faced = Gap::Faced{before.gap[i], before.x[i]};
    if (before.gap[i] <= reached) faced = gap.faced(rail.at(before.s[i]).position, walked);
    if (faced) out.add(before.s[i], faced->gap, faced->x);
  }
  return out;
}

/// What place_wheel has looked at for a contact; of others it is looked at now.
std::shared_ptr<const GapSamples> samples_of(const RigidContact& contact, const Gap& gap, const Profile& rail) {
  return contact.searched ? contact.searched : std::make_shared<const GapSamples>(sample_overlap(gap, rail));
}

/// Lowest point between two samples: the gap falls before it and rises after it.
double refine(const Gap& gap, double lo, double centre, double hi) {
  const double start = gap.value(centre);
  for (int i = 0; i < 60 && hi - lo > 1e-16; ++i) {
    const double middle = 0.5 * (lo + hi);
    (gap.derivative(middle) > 0 ? hi : lo) = middle;
  }
  const double found = 0.5 * (lo + hi);
  return gap.value(found) < start - 1e-16 ? found : centre;
}

/// Rail arc length of the first contact: the lowest gap; of equal ones that nearest the tape circle, or nearest `held`.
double first_contact(const Gap& gap, const GapSamples& samples, const HeldPlace& held) {
  const double lowest = *std::min_element(samples.gap.begin(), samples.gap.end());
  const double candidate = kCandidate + held.within;
  double best_s = 0, best_gap = std::numeric_limits<double>::infinity();
  const auto off = [&](double s) { return held.within > 0 ? std::abs(s - held.rail_s) : std::abs(gap.wheel_y(s)); };
  const auto consider = [&](double s) {
    const double g = gap.value(s);
    const bool equal = std::abs(g - best_gap) <= kEqual + held.within;
    if (equal ? off(s) < off(best_s) : g < best_gap) {
      best_s = s;
      best_gap = g;
    }
  };
  const std::size_t last = samples.s.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    if (samples.gap[i] > lowest + candidate) continue;
    const double before = samples.gap[i == 0 ? 0 : i - 1], after = samples.gap[i == last ? last : i + 1];
    if (samples.gap[i] > before || samples.gap[i] > after) continue;
    if (i == 0 || i == last)
      consider(samples.s[i]);
    else
      consider(refine(gap, samples.s[i - 1], samples.s[i], samples.s[i + 1]));
  }
  return best_s;
}

/// The wheel lowered until it touches at s, a lowest place of the gap.
RigidContact contact_at(const Gap& gap, const Profile& wheel, const Profile& rail, const TrackGeometry& track,
                        double offset_y, double s) {
  const ProfilePoint r = rail.at(s);
  RigidContact out;
  out.wheel_offset_y = offset_y;
  out.wheel_offset_z = -gap.value(s);
  out.axle_height = out.wheel_offset_z + track.wheel_radius;
  out.rail_s = s;
  const Vec2 tangent = rail_to_model(track, r.tangent);
  out.point = rail_to_model(track, r.position);
  out.angle = std::atan2(tangent.z, tangent.y);
  out.yaw = std::atan(track.yaw);
  out.roll = std::atan(track.roll);
  if (gap.rolled()) {
    const TurnedPoint touched = gap.outline(s);
    out.wheel_s = gap.wheel_s(s);
    out.x = touched.position.x;
    out.rolling_radius = touched.depth;
  } else {
    const LowestPoint touched = gap.on_wheel(s);
    out.wheel_s = wheel.s_at_y(touched.y);
    out.x = touched.x * std::cos(out.yaw) - touched.y * std::sin(out.yaw);
    out.rolling_radius = track.yaw == 0 ? track.wheel_radius - wheel.at(out.wheel_s).position.z : gap.depth(touched);
  }
  out.curvature_wheel_lateral = wheel.at(out.wheel_s).curvature;
  out.curvature_rail_lateral = r.curvature;
  out.curvature_rolling = std::cos(out.angle - out.roll) /
                          out.rolling_radius;  // Meusnier: the parallel's plane is not normal to the surface
  if (std::isfinite(track.rail_radius)) {
    const double radius = gap.rail_radius(out.point.z);
    out.rail_turn = 1 / axle_depth(radius, out.x);
    out.curvature_rolling += std::cos(out.angle) * out.rail_turn;
    out.point.z -= rail_drop(radius, out.x);
  }
  return out;
}

/// Places of the samples that are lower than their neighbours.
std::vector<std::size_t> lowest_samples(const GapSamples& samples, double highest) {
  std::vector<std::size_t> out;
  for (std::size_t i = 1; i + 1 < samples.s.size(); ++i)
    if (samples.gap[i] <= highest && samples.gap[i] < samples.gap[i - 1] && samples.gap[i] <= samples.gap[i + 1])
      out.push_back(i);
  std::sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) { return samples.gap[a] < samples.gap[b]; });
  return out;
}

/// Sample of the largest gap between two of them.
std::size_t ridge_sample(const GapSamples& samples, std::size_t a, std::size_t b) {
  const auto [first, last] = std::minmax(a, b);
  const auto at = [&](std::size_t i) { return samples.gap.begin() + static_cast<std::ptrdiff_t>(i); };
  return static_cast<std::size_t>(std::max_element(at(first), at(last) + 1) - samples.gap.begin());
}

std::size_t sample_near(const GapSamples& samples, double s) {
  const auto next = std::lower_bound(samples.s.begin(), samples.s.end() - 1, s);
  return static_cast<std::size_t>(next - samples.s.begin());
}

/// Sums over an overlap, each with the weight of its depth.
struct OverlapSums {
  double weight = 0, s = 0, x = 0, angle = 0;
  void add(double depth, double at, double along, double inclination) {
    const double w = depth * depth * std::sqrt(depth);  // depth^2.5
    weight += w;
    s += w * at;
    x += w * along;
    angle += w * inclination;
  }
};

/// Over the samples of a stretch; where fewer than kFew of them overlap, between these too.
OverlapSums overlap_sums(const Gap& gap, const Profile& rail, const TrackGeometry& track, const GapSamples& samples,
                         const RailStretch& stretch, double offset_z) {
  constexpr std::size_t kFew = 60;
  const Rotation<double> cant = rotation_of_tangent(track.cant);
  const auto inclination = [&](double s) {
    const Vec2 t = roll(cant, rail.at(s).tangent);
    return std::atan2(t.z, t.y);
  };
  const auto depth = [&](std::size_t i) { return -offset_z - samples.gap[i]; };
  const auto at = [&](double s) {
    return static_cast<std::size_t>(std::lower_bound(samples.s.begin(), samples.s.end(), s) - samples.s.begin());
  };
  const std::size_t begin = at(stretch.low), end = at(stretch.high);
  OverlapSums out;
  std::size_t overlapped = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (!(depth(i) > 0)) continue;
    ++overlapped;
    out.add(depth(i), samples.s[i], samples.x[i], inclination(samples.s[i]));
  }
  if (overlapped == 0 || overlapped >= kFew) return out;
  out = {};
  const std::size_t parts = kFew / overlapped + 1;
  for (std::size_t i = begin; i + 1 < end; ++i) {
    if (!(depth(i) > 0) && !(depth(i + 1) > 0)) continue;
    for (std::size_t k = 0; k < parts; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(parts),
                   s = samples.s[i] + share * (samples.s[i + 1] - samples.s[i]), deep = -offset_z - gap.value(s);
      if (deep > 0) out.add(deep, s, gap.x(s), inclination(s));
    }
  }
  return out;
}

std::string pair_name(const Profile& wheel, const Profile& rail) {
  return fmt::format("wheel {} on rail {}", wheel.name(), rail.name());
}

}  // namespace

Rotation<double> rotation_of_tangent(double tangent) {
  const double c = 1 / std::hypot(1.0, tangent);
  return {c, tangent * c};
}

Vec2 rail_to_model(const TrackGeometry& track, Vec2 rail_point) {
  return roll(rotation_of_tangent(track.cant), rail_point);
}
Vec2 model_to_rail(const TrackGeometry& track, Vec2 model_point) {
  return roll(rotation_of_tangent(-track.cant), model_point);
}

double wheel_spin(const RigidContact& contact) {
  const double of_wheel = -std::sin(contact.angle - contact.roll) / contact.rolling_radius;
  return contact.rail_turn == 0 ? of_wheel : of_wheel - std::sin(contact.angle) * contact.rail_turn;
}

double axle_depth(double rail_radius, double x) {
  return std::copysign(std::sqrt(rail_radius * rail_radius - x * x), rail_radius);
}

double rail_drop(double rail_radius, double x) {
  return std::isfinite(rail_radius) ? x * x / (rail_radius + axle_depth(rail_radius, x)) : 0.0;
}

double yaw_creepage(const RigidContact& contact) {
  return 0.0 - (contact.roll == 0 ? std::tan(contact.yaw) / std::cos(contact.angle) : lateral_motion(contact));
}

RigidContact place_wheel(const Profile& wheel, const Profile& rail, const TrackGeometry& track, const HeldPlace& held,
                         const KnownPlace& known) {
  const double offset_y = lateral_offset(wheel, rail, track);
  const Gap gap(wheel, rail, track, offset_y);
  const bool known_there = known.contact && known.contact->searched;
  const auto searched =
      std::make_shared<const GapSamples>(known_there ? sample_again(gap, rail, known) : sample_overlap(gap, rail));
  const GapSamples& samples = *searched;
  if (samples.s.size() < 3)
    throw CaseError(fmt::format("{}: the wheel misses the rail; its tape circle stands {:.1f} mm from the rail's axis",
                                pair_name(wheel, rail), 1e3 * offset_y),
                    "check lateral_shift, gauge and back_to_back");
  const double s = first_contact(gap, samples, held);
  if (s - samples.s.front() < kSearchStep || samples.s.back() - s < kSearchStep)
    throw CaseError(fmt::format("{}: the contact lies at the end of a profile, at wheel y = {:.2f} mm",
                                pair_name(wheel, rail), 1e3 * gap.wheel_y(s)),
                    "check lateral_shift, gauge, back_to_back and cant, or give profiles that reach further");

  RigidContact out = contact_at(gap, wheel, rail, track, offset_y, s);
  out.searched = searched;
  return out;
}

std::vector<RigidContact> further_contacts(const Profile& wheel, const Profile& rail, const TrackGeometry& track,
                                           const RigidContact& first, double descent) {
  constexpr double kRidge = 1e-6;  // m
  const Gap gap(wheel, rail, track, first.wheel_offset_y);
  const auto searched = samples_of(first, gap, rail);
  const GapSamples& samples = *searched;
  std::vector<std::size_t> places{sample_near(samples, first.rail_s)};
  std::vector<RigidContact> out;
  for (const std::size_t i : lowest_samples(samples, descent - first.wheel_offset_z)) {
    const bool own = std::all_of(places.begin(), places.end(), [&](std::size_t place) {
      const std::size_t apart = std::max(i, place) - std::min(i, place);
      return apart > 1 && samples.gap[ridge_sample(samples, i, place)] > samples.gap[i] + kRidge;
    });
    if (!own) continue;
    places.push_back(i);
    const double s = refine(gap, samples.s[i - 1], samples.s[i], samples.s[i + 1]);
    out.push_back(contact_at(gap, wheel, rail, track, first.wheel_offset_y, s));
    out.back().searched = searched;
  }
  return out;
}

RigidContact overlap_place(const Profile& wheel, const Profile& rail, const TrackGeometry& track,
                           const RigidContact& first, const RailStretch& stretch, double offset_z) {
  constexpr double kSamePlace = 1e-8, kSameAngle = 1e-7;  // m, rad
  if (first.settled) return first;
  const Gap gap(wheel, rail, track, first.wheel_offset_y);
  const auto searched = samples_of(first, gap, rail);
  const OverlapSums sums = overlap_sums(gap, rail, track, *searched, stretch, offset_z);
  if (!(sums.weight > 0)) return first;
  const double s = sums.s / sums.weight, angle = sums.angle / sums.weight;
  if (std::abs(s - first.rail_s) < kSamePlace && std::abs(angle - first.angle) < kSameAngle) return first;
  RigidContact out = contact_at(gap, wheel, rail, track, first.wheel_offset_y, s);
  const double half_gap = 0.5 * (gap.value(s) + first.wheel_offset_z);
  out.point.z += half_gap;
  out.rolling_radius += half_gap;
  out.wheel_offset_z = first.wheel_offset_z;
  out.axle_height = first.axle_height;
  out.x = sums.x / sums.weight;
  out.angle = angle;
  out.curvature_wheel_lateral = first.curvature_wheel_lateral;
  out.curvature_rail_lateral = first.curvature_rail_lateral;
  out.curvature_rolling = std::cos(out.angle - out.roll) / out.rolling_radius + std::cos(out.angle) * out.rail_turn;
  return out;
}

Ridge ridge_between(const Profile& wheel, const Profile& rail, const TrackGeometry& track, const RigidContact& a,
                    const RigidContact& b) {
  const auto searched = samples_of(b, Gap(wheel, rail, track, a.wheel_offset_y), rail);
  const GapSamples& samples = *searched;
  const std::size_t i = ridge_sample(samples, sample_near(samples, a.rail_s), sample_near(samples, b.rail_s));
  return {samples.s[i], samples.gap[i]};
}

}  // namespace railstrata
