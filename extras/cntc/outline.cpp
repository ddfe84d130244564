#include "cntc/outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "cntc/codes.hpp"
#include "core/faults.hpp"
#include "geometry/exchange_profiles.hpp"
#include "geometry/number_table.hpp"
#include "record/unit.hpp"

namespace railstrata::cntc {
namespace {

constexpr double kStep = 0.05e-3;    // m, between the points of a search
constexpr double kSamePoint = 1e-7;  // m: points nearer than this are one

std::string ending_of(std::string_view name) {
  std::string out = std::filesystem::path(name).extension().string();
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

/// Whether z points up: the ends of a rail lie below its middle, those of a wheel above its flange and tread.
bool points_up(ProfileKind kind, const std::vector<Vec2>& points) {
  const auto by_z = [](Vec2 a, Vec2 b) { return a.z < b.z; };
  const auto [least, most] = std::minmax_element(points.begin(), points.end(), by_z);
  if (kind == ProfileKind::rail) {
    const double middle = 0.5 * (points.front().y + points.back().y);
    const auto near = [&](Vec2 a, Vec2 b) { return std::abs(a.y - middle) < std::abs(b.y - middle); };
    return 0.5 * (points.front().z + points.back().z) < std::min_element(points.begin(), points.end(), near)->z;
  }
  const auto at_end = [&](auto at) {
    const double share = static_cast<double>(at - points.begin() + 1) / static_cast<double>(points.size());
    return share < 0.05 || share > 0.95;
  };
  if (at_end(least)) return false;
  if (at_end(most)) return true;
  return points[static_cast<std::size_t>((least - points.begin() + most - points.begin()) / 2)].z >
         0.5 * (least->z + most->z);
}

/// y where CONTACT's arc length is 0: at y = 0 where y rises all along, else at the listed point nearest to the origin.
double begin_of_arc(const std::vector<Vec2>& points) {
  const auto falls = [](Vec2 a, Vec2 b) { return a.y >= b.y; };
  if (std::adjacent_find(points.begin(), points.end(), falls) == points.end()) return 0;
  const auto nearer = [](Vec2 a, Vec2 b) { return norm(a) < norm(b); };
  return std::min_element(points.begin(), points.end(), nearer)->y;
}

Outline outline(ProfileKind kind, std::vector<Vec2> points, const OutlineOptions& options, const std::string& name) {
  if (options.mirror_y)
    for (Vec2& p : points) p.y = -p.y;
  if (points.size() >= 2 && points.front().y > points.back().y) std::reverse(points.begin(), points.end());
  const bool turn = options.mirror_z == 1 || (options.mirror_z == 0 && points.size() >= 2 && points_up(kind, points));
  // CONTACT's z is down, that of a Profile up.
  for (Vec2& p : points) p = options.scale * Vec2{p.y, turn ? p.z : -p.z};
  const auto repeated = [](Vec2 a, Vec2 b) { return kMilli * norm(a - b) < kSamePoint; };
  points.erase(std::unique(points.begin(), points.end(), repeated), points.end());
  points = smoothed(without_zigzags(points, options.smoothing.zigzag), options.smoothing);
  for (Vec2& p : points) p = kMilli * p;
  const double zero = begin_of_arc(points);
  double aside = 0;
  if (!points.empty() && points.front().y * points.back().y > 0) aside = points[points.size() / 2].y;
  for (Vec2& p : points) p.y -= aside;
  try {
    return {Profile::from_points(kind, name, points), aside, zero};
  } catch (const CaseError& e) {
    throw Refused(kProfile, fmt::format("{}: {}", name, e.diagnostics.front().message));
  }
}

}  // namespace

Outline::Outline(Profile profile, double aside, double zero) : profile_(std::move(profile)), aside_(aside) {
  if (covers(zero)) zero_arc_ = arc(zero);
  const double begin = profile_.s_at_y(profile_.y_min()), end = profile_.s_at_y(profile_.y_max());
  const int count = std::max(2, static_cast<int>(std::ceil((end - begin) / kStep)) + 1);
  for (int k = 0; k < count; ++k) {
    const Point next = along(std::clamp(begin + (end - begin) * k / (count - 1), begin, end));
    if (points_.empty() || next.y > points_.back().y) points_.push_back(next);
  }
}

Outline::Point Outline::along(double s) const {
  constexpr double kSteepest = 1e-9;
  const ProfilePoint p = profile_.at(s);
  return {p.position.y + aside_, -p.position.z, -p.tangent.z / std::max(p.tangent.y, kSteepest)};
}

Outline::Point Outline::at(double y) const {
  return along(profile_.s_at_y(std::clamp(y - aside_, profile_.y_min(), profile_.y_max())));
}

ProfileKind kind_of_file(std::string_view name) {
  const std::string ending = ending_of(name);
  if (ending == ".prr" || ending == ".ban") return ProfileKind::rail;
  if (ending == ".prw" || ending == ".whl") return ProfileKind::wheel;
  throw Refused(kProfile,
                fmt::format("{}: the ending does not say whether this is a rail or a wheel: give itype 0 or 1", name));
}

Outline read_outline(ProfileKind kind, const std::string& file, const OutlineOptions& options) {
  const std::string ending = ending_of(file);
  if (ending == ".slcs" || ending == ".slcw")
    throw Refused(kProfile, file + ": profiles that vary along the track or the tread are not offered");
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in || text.empty()) throw Refused(kProfile, file + ": this profile cannot be read: check its path");
  try {
    const bool simpack = text.find("point.begin") != std::string::npos;
    const NumberTable table = simpack                                ? parse_simpack(kind, text, file)
                              : ending == ".ban" || ending == ".whl" ? parse_miniprof(text, file)
                                                                     : parse_number_table(text, file);
    return outline(kind, table.rows, options, file);
  } catch (const CaseError& e) {
    throw Refused(kProfile, e.what());
  }
}

Outline outline_of(ProfileKind kind, std::span<const double> values, const OutlineOptions& options) {
  std::vector<Vec2> points;
  for (std::size_t k = 0; k + 1 < values.size(); k += 2) points.push_back({values[k], values[k + 1]});
  return outline(kind, std::move(points), options, "<values>");
}

GaugePoint gauge_point(const Outline& rail, double cant, double depth) {
  const Profile& p = rail.profile();
  const double c = std::cos(cant), s = std::sin(cant), begin = p.s_min(), end = p.s_max();
  const int count = std::max(2, static_cast<int>((end - begin) / (0.2 * kStep)));
  const auto canted = [&](double at) {
    const Outline::Point q = rail.along(std::clamp(at, begin, end));
    return Vec2{c * q.y + s * q.z, -s * q.y + c * q.z};
  };
  const auto place = [&](int k) { return begin + (end - begin) * k / count; };
  int top = 0;
  GaugePoint out{1e9, 0, 1e9};
  for (int k = 0; k <= count; ++k)
    if (const double z = canted(place(k)).z; z < out.top) {
      out.top = z;
      top = k;
    }
  const auto take = [&](Vec2 q) {
    if (q.y >= out.y) return;
    out.y = q.y;
    out.z = q.z;
  };
  const auto within = [&](double at) { return canted(at).z - out.top <= depth; };
  for (int k = 0; k <= top; ++k) {
    if (!within(place(k))) continue;
    take(canted(place(k)));
    if (k == 0 || within(place(k - 1))) continue;
    double outside = place(k - 1), inside = place(k);  // passes the depth in between
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (outside + inside);
      (within(middle) ? inside : outside) = middle;
    }
    take(canted(inside));
  }
  return out;
}

}  // namespace railstrata::cntc
