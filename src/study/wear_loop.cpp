#include "study/wear_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"
#include "jobs/state_table.hpp"
#include "many/collective_files.hpp"

namespace railstrata {
namespace {

constexpr double kSpread = 4;  // cells, standard deviation of the smoothing
const StateColumns<Vec2> kPoints{{"y", &Vec2::y, unit::kMillimetres}, {"z", &Vec2::z, unit::kMillimetres}};

/// Between two curves with the same ends, positive where the second lies to the right of the first.
double area_between(const std::vector<Vec2>& first, const std::vector<Vec2>& second) {
  double twice = 0;
  const auto walk = [&](const std::vector<Vec2>& points, double sign) {
    for (std::size_t i = 1; i < points.size(); ++i) twice += sign * cross(points[i - 1], points[i]);
  };
  walk(first, -1);
  walk(second, 1);
  return 0.5 * twice;
}

/// A wheel without a flange stands over the rail's axis, whatever the gauge.
bool has_gauge(const Placement& p) { return !p.wheel.primitive() && !p.rail.primitive(); }

void require_gauge_face(const Placement& original) {
  if (original.rail.primitive() && !original.wheel.primitive())
    throw CaseError(
        "the rail's profile is an arc or a plane: once it is worn it is a list of points, and a wheel with "
        "a flange then stands by the gauge face that it does not have",
        "take a rail's profile, or an arc for the wheel too");
}

/// The height that the reader of profiles takes off so that z = 0 at y = 0.
double origin_height(const WornRail& rail) {
  return rail.file.empty() ? 0.0 : Profile::from_points(ProfileKind::rail, "worn", rail.points).height(0);
}

void require_solved(const WearStep& step, const WornRail& before) {
  for (const CollectiveRow& row : step.rows)
    if (!row.sound())
      throw CaseError(fmt::format("step {}: {} cannot be solved on the rail of {} passages: {}", before.step + 1,
                                  row.name, before.passages, row.fault),
                      "take the load out, or change it; the steps before are kept");
}

/// m, of one collective.
std::vector<double> wear_of(const WearStep& step, const CaseSpec& spec) {
  const WearLaw law = spec.collective.wear_law;
  const std::vector<KnownWear> known = known_wear(step.damage);
  if (std::none_of(known.begin(), known.end(), [&](const KnownWear& w) { return w.law == law; }))
    throw CaseError("collective.wear_law: the case lacks the data of this law",
                    "give [material.rail] a hardness, or a grade, and for \"archard\" a wear_coefficient");
  std::vector<double> out = smoothed_wear(step.damage, law);
  if (!(*std::max_element(out.begin(), out.end()) > 0))
    throw CaseError("nothing wears: no load of the collective slips", "give loads with traction, yaw or spin");
  return out;
}

double all_passages(const std::vector<CollectiveRow>& rows) {
  double out = 0;
  for (const CollectiveRow& row : rows) out += row.passages;
  return out;
}

/// Cells' middles, and the ends, which stay.
struct Section {
  std::vector<double> s, depth;
};
Section section_of(const Profile& rail, const RailDamage& damage, const std::vector<double>& depth) {
  Section out{{rail.s_min()}, {0}};
  out.s.insert(out.s.end(), damage.s.begin(), damage.s.end());
  out.depth.insert(out.depth.end(), depth.begin(), depth.end());
  out.s.push_back(rail.s_max());
  out.depth.push_back(0);
  return out;
}

/// Takes `depth` times `share` off the profile.
void wear_off(const Profile& profile, const std::vector<double>& depth, double share, double height, WearStep& step,
              const WornRail& before) {
  const Section section = section_of(profile, step.damage, depth);
  std::vector<Vec2> old;
  step.rail.points.clear();
  for (std::size_t i = 0; i < section.s.size(); ++i) {
    const ProfilePoint p = profile.at(section.s[i]);
    old.push_back({p.position.y, p.position.z + height});
    step.rail.points.push_back(old.back() - share * section.depth[i] * p.outward);
  }
  step.rail.area = before.area + area_between(old, step.rail.points);
}

}  // namespace

WornRail unworn(const Placement& placement, double cell) {
  WornRail out;
  const RailDamage cells = undamaged(placement.rail, cell);
  for (const double s : section_of(placement.rail, cells, cells.usfd).s)
    out.points.push_back(placement.rail.at(s).position);
  return out;
}

std::vector<double> smoothed_wear(const RailDamage& damage, WearLaw law) {
  constexpr int kRounds = static_cast<int>(2 * kSpread * kSpread);  // each adds half a cell squared to the variance
  std::vector<double> depth = damage.depth(law);
  for (int round = 0; round < kRounds; ++round) {
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

CaseSpec on_worn_rail(const CaseSpec& spec, const Placement& original, const WornRail& rail) {
  CaseSpec out = spec;
  if (rail.file.empty()) return out;
  out.geometry.rail_mirror = false;  // of the file before
  out.geometry.rail_offset = 0;
  out.geometry.rail_profile = std::filesystem::absolute(rail.file).string();
  if (!has_gauge(original)) return out;
  std::vector<Vec2> points = rail.points;
  const double height = origin_height(rail);
  for (Vec2& p : points) p.z -= height;
  const double worn = gauge_face_y(Profile::from_points(ProfileKind::rail, "worn", points), original.track);
  out.geometry.gauge += 2 * (worn - gauge_face_y(original.rail, original.track));
  return out;
}

WearStep wear_step(const CaseSpec& spec, const std::filesystem::path& folder, const Placement& original,
                   const WornRail& rail, const WearStepOptions& options) {
  require_gauge_face(original);
  WearStep step;
  const CaseSpec worn = on_worn_rail(spec, original, rail);
  step.gauge = worn.geometry.gauge;
  step.rows = plan_collective(worn);
  solve_collective(step.rows, folder, options.collective);
  step.stopped = std::any_of(step.rows.begin(), step.rows.end(), [](const CollectiveRow& r) { return !r.done; });
  if (step.stopped) return step;
  require_solved(step, rail);
  const Placement placement = place(worn, folder);
  step.damage = rail_damage(step.rows, placement, options.collective.bem.cell);
  const std::vector<double> depth = wear_of(step, spec);
  const double deepest = *std::max_element(depth.begin(), depth.end()), collective = all_passages(step.rows);
  step.passages = collective * options.max_wear / deepest;
  if (options.passages_left > 0) step.passages = std::min(step.passages, options.passages_left);
  const double share = step.passages / collective;
  step.deepest = share * deepest;
  step.wanted_area = share * streamline_area(step.rows, spec.collective.wear_law);
  step.rail.step = rail.step + 1;
  step.rail.passages = rail.passages + step.passages;
  wear_off(placement.rail, depth, share, origin_height(rail), step, rail);
  return step;
}

void write_worn_profile(const std::filesystem::path& file, const std::vector<std::string>& origin,
                        const std::vector<Vec2>& points) {
  std::vector<Vec2> rows;
  for (const Vec2& p : points) rows.push_back(in_table(kPoints, p));
  write_rows(file, origin, kPoints, rows);
}

std::vector<Vec2> read_worn_profile(const std::filesystem::path& file) {
  std::vector<Vec2> points = read_rows(file, kPoints);
  for (Vec2& p : points) p = in_si(kPoints, p);
  return points;
}

}  // namespace railstrata
