#include "fatigue/rail_damage.hpp"

#include <numeric>
#include <utility>

namespace railstrata {
namespace {

Strip strip_of(const Profile& rail, const TrackGeometry& track, const RigidContact& contact, const StreamlineRow& row) {
  const Vec2 tangent{std::cos(contact.angle), std::sin(contact.angle)}, middle{row.y, row.z};
  const double along = dot(middle - contact.point, tangent);
  const auto edge = [&](double side) {
    return nearest_on_rail(rail, track, middle + 0.5 * side * row.width * tangent,
                           contact.rail_s + along + 0.5 * side * row.width);
  };
  return {edge(-1), edge(1)};
}

}  // namespace

const std::vector<double>& ProfileWear::depth(WearLaw law) const {
  return law == WearLaw::usfd ? usfd : law == WearLaw::kth ? kth : archard;
}

ProfileWear unworn(const Profile& profile, double cell) {
  ProfileWear out;
  const double length = profile.s_max() - profile.s_min();
  const auto n = static_cast<std::size_t>(std::ceil(length / cell));
  out.cell = length / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    out.s.push_back(profile.s_min() + (static_cast<double>(i) + 0.5) * out.cell);
    const Vec2 p = profile.at(out.s.back()).position;
    out.y.push_back(p.y);
    out.z.push_back(p.z);
  }
  for (auto* a : {&out.usfd, &out.archard, &out.kth}) a->assign(n, 0.0);
  return out;
}

RailDamage undamaged(const Profile& rail, double cell) {
  RailDamage out{unworn(rail, cell), {}, {}, {}};
  for (auto* a : {&out.passages, &out.friction_energy, &out.rcf_damage}) a->assign(out.s.size(), 0.0);
  return out;
}

void add_passages(RailDamage& damage, const Profile& rail, const TrackGeometry& track, const PatchDamage& patch,
                  double passages) {
  for (const StreamlineRow& row : patch.rows) {
    const Strip strip = strip_of(rail, track, patch.contact, row);
    if (!(strip.to > strip.from)) continue;
    const double of_area = passages * row.width / ((strip.to - strip.from) * damage.cell);
    for_cells(damage, strip, [&](std::size_t i, double length) {
      damage.friction_energy[i] += of_area * length * row.friction_energy;
      damage.usfd[i] += of_area * length * row.usfd_depth;
      damage.archard[i] += of_area * length * row.archard_depth;
      damage.kth[i] += of_area * length * row.kth_depth;
      damage.passages[i] += passages * length / damage.cell;
      damage.rcf_damage[i] += passages * patch.rcf_damage * length / damage.cell;
    });
  }
}

std::vector<AsideShare> aside_shares(double deviation, double step) {
  constexpr double kCut = 3;  // deviations
  if (!(deviation > 0)) return {{}};
  const int n = static_cast<int>(std::ceil(kCut * deviation / step));
  std::vector<AsideShare> out;
  double sum = 0;
  for (int k = -n; k <= n; ++k) {
    const double offset = k * (kCut * deviation / n), in_deviations = offset / deviation;
    out.push_back({offset, std::exp(-0.5 * in_deviations * in_deviations)});
    sum += out.back().share;
  }
  for (AsideShare& a : out) a.share /= sum;
  return out;
}

void spread_aside(std::vector<double>& cells, double cell, double deviation) {
  std::vector<double> spread(cells.size(), 0.0);
  const double last = static_cast<double>(cells.size()) - 1;
  for (const AsideShare& a : aside_shares(deviation, cell))
    for (std::size_t i = 0; i < cells.size(); ++i) {
      // between the two cells beside it
      const double to = std::clamp(static_cast<double>(i) + a.offset / cell, 0.0, last);
      const auto left = static_cast<std::size_t>(to);
      const double right = to - static_cast<double>(left);
      spread[left] += a.share * (1 - right) * cells[i];
      if (right > 0) spread[left + 1] += a.share * right * cells[i];
    }
  cells = std::move(spread);
}

void spread_aside(RailDamage& d, double deviation) {
  if (!(deviation > 0)) return;
  for (auto* a : {&d.passages, &d.friction_energy, &d.usfd, &d.archard, &d.kth, &d.rcf_damage})
    spread_aside(*a, d.cell, deviation);
}

double worn_area(const ProfileWear& damage, const std::vector<double>& depth) {
  return damage.cell * std::accumulate(depth.begin(), depth.end(), 0.0);
}

double nearest_on(const Profile& profile, Vec2 point, double guess) {
  constexpr int kMostSteps = 30;
  constexpr double kClose = 1e-10;  // m
  double s = std::clamp(guess, profile.s_min(), profile.s_max());
  for (int k = 0; k < kMostSteps; ++k) {
    const ProfilePoint p = profile.at(s);
    const double next = std::clamp(s + dot(point - p.position, p.tangent), profile.s_min(), profile.s_max());
    const bool there = std::abs(next - s) < kClose;
    s = next;
    if (there) break;
  }
  return s;
}

double nearest_on_rail(const Profile& rail, const TrackGeometry& track, Vec2 point, double guess) {
  return nearest_on(rail, model_to_rail(track, point), guess);
}

std::vector<double> smoothed_wear(const RailDamage& damage, WearLaw law) {
  constexpr double kSpread = 1e-3;  // m, standard deviation
  const double cells = kSpread / damage.cell;
  const long rounds = std::max(1L, std::lround(2 * cells * cells));  // each adds half a cell squared to the variance
  std::vector<double> depth = damage.depth(law);
  for (long round = 0; round < rounds; ++round) {
    std::vector<double> next = depth;
    for (std::size_t i = 1; i < depth.size(); ++i) {
      if (!(damage.passages[i - 1] > 0 && damage.passages[i] > 0)) continue;
      const double flow = 0.25 * (depth[i] - depth[i - 1]);
      next[i - 1] += flow;
      next[i] -= flow;
    }
    depth = std::move(next);
  }
  return depth;
}

}  // namespace railstrata
