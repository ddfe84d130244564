#include "clock/rail_crack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "bem/contact_places.hpp"
#include "clock/clock.hpp"
#include "core/parallel.hpp"
#include "crack/interval.hpp"
#include "record/unit.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

/// Whether a patch is near enough to a place across to matter.
bool near_crack(const BemPatch& patch, double y) {
  constexpr double kReach = 2;  // half widths
  const PatchGrid& g = patch.grid;
  int first = g.ny, last = -1;
  for (int i = 0; i < patch.field.size(); ++i) {
    if (!(patch.field.p[static_cast<std::size_t>(i)] > 0)) continue;
    first = std::min(first, i % patch.field.columns);
    last = std::max(last, i % patch.field.columns);
  }
  return last >= first && std::abs(y - 0.5 * (g.y(first) + g.y(last))) < kReach * 0.5 * (last - first + 1) * g.dy;
}

}  // namespace

std::vector<CrackLoad> crack_loads(const CrackSpec& crack, const std::vector<CollectiveRow>& rows, double wheels,
                                   const CrackedRail& rail) {
  if (rail.crack.allowable < RailCrack::kNot) return {};
  const std::vector<double> depths = rail.metal.grid().depths();
  const std::vector<Sym3> residual = rail.metal.residual(rail.metal.grid().nearest(rail.crack.s));
  struct Near {
    const CollectiveRow* row;
    const BemPatch* patch;
    double y;
  };
  std::vector<Near> near;
  for (const CollectiveRow& row : rows) {
    if (!row.sound() || !row.result) continue;
    for (const BemPatch* patch : patches_of(*row.result)) {
      const double y = rail.crack.s - rail.surface.unworn_s_of(patch->place.rail_s) +
                       along_plane(patch->contact, patch->place.point);
      if (near_crack(*patch, y)) near.push_back({&row, patch, y});
    }
  }
  std::vector<std::optional<CrackLoad>> made(near.size());
  for_each_that_throws(near.size(), [&](std::size_t k) {
    const CollectiveRow& row = *near[k].row;
    const CrackPlace place{
        .y = near[k].y,
        .deepest = crack.allowable,
        .azimuth = std::isfinite(rail.crack.azimuth) ? std::optional(rail.crack.azimuth) : crack.azimuth,
        .further = [&](double depth) {
          const Interval around = interval_of(depths, depth);
          return around.of(residual[static_cast<std::size_t>(around.low)],
                           residual[static_cast<std::size_t>(around.high)]);
        }};
    made[k] = {row.passages / wheels, row.result->rail, crack_plane(row.spec, *row.result, *near[k].patch, place)};
  });
  std::vector<CrackLoad> out;
  for (std::optional<CrackLoad>& load : made) out.push_back(std::move(*load));
  return out;
}

void begin_crack(const CrackSpec& crack, const Gathered& damage, const WornProfile& surface, double kilograms,
                 RailCrack& rail) {
  constexpr std::size_t kDuctility = 0, kClosedCycles = 2;  // of numbers_of, their best values
  const FirstFailure* first = nullptr;
  for (const auto& [key, failure] : damage.failures)
    if ((key.damage == kDuctility || key.damage == kClosedCycles) && (!first || failure.traffic < first->traffic))
      first = &failure;
  if (!first || !(crack.depth > 0)) return;
  rail.s = first->s;
  rail.tip = surface.removed_at(first->s) + crack.depth;
  rail.begun = first->traffic * kilograms;
}

double CrackGrowth::at_step(int step) {
  const auto found = known_.find(step);
  if (found != known_.end()) return found->second;
  const double depth = crack_.depth * std::pow(kApart, step);
  std::vector<double> grown(loads_.size());
  for_each_that_throws(loads_.size(), [&](std::size_t k) {
    grown[k] = loads_[k].share * crack_state(crack_, depth, loads_[k].rail, loads_[k].plane).growth;
  });
  const double sum = std::accumulate(grown.begin(), grown.end(), 0.0);
  return known_.emplace(step, sum * std::sin(crack_.angle)).first->second;
}

double CrackGrowth::rate(double depth) {
  const double place = std::log(depth / crack_.depth) / std::log(kApart);
  const int step = static_cast<int>(std::floor(place));
  const double share = place - step;
  return share > 0 ? (1 - share) * at_step(step) + share * at_step(step + 1) : at_step(step);
}

void CrackGrowth::turn(double azimuth) {
  crack_.azimuth = azimuth;
  for (CrackLoad& load : loads_) load.plane.turn(azimuth);
  known_.clear();
}

void grow(const CrackSpec& crack, CrackGrowth& growth, const CrackStep& step, RailCrack& rail) {
  constexpr double kFinest = 0.05;  // of the depth, in one step
  const double floor = crack.place ? kShallowest : crack.depth;
  double done = 0;
  const auto surface = [&](double at) {
    return step.wheels > 0 ? step.before + (step.after - step.before) * at / step.wheels : step.after;
  };
  do {
    const double left = step.wheels - done, depth = std::max(floor, rail.tip - surface(done));
    rail.tip = surface(done) + depth;
    const double rate = depth < crack.allowable ? growth.rate(depth) : 0;
    const double wheels = rate > 0 ? std::min(left, kFinest * depth / rate) : left;
    rail.tip += rate * wheels;
    done += wheels;
    const double now = rail.tip - surface(done), kg = step.from + done * step.each;
    if (now >= crack.detectable) rail.detectable = std::min(rail.detectable, kg);
    if (now >= crack.allowable) rail.allowable = std::min(rail.allowable, kg);
    if (rail.allowable < RailCrack::kNot) return;
  } while (done < step.wheels * (1 - 1e-12));
  rail.tip = std::max(rail.tip, step.after + floor);
}

void take_direction(const CrackSpec& crack, CrackGrowth& growth, RailCrack& rail) {
  if (std::isfinite(rail.azimuth)) return;
  const auto in_direction = [&](double azimuth) {
    growth.turn(azimuth);
    return growth.rate(crack.depth);
  };
  rail.azimuth = crack.azimuth ? *crack.azimuth : fastest_azimuth(in_direction);
  growth.turn(rail.azimuth);
}

std::string crack_note(const CrackSpec& crack, const RailCrack& rail, const std::vector<ClockMoment>& history) {
  if (!rail.there()) return {};
  const auto mgt = [](double kg) { return fmt::format("{:.3g} MGT", 1e-9 * kg); };
  std::string out =
      crack.place ? fmt::format("crack: {:.2g} mm deep at first", 1e3 * crack.depth)
                  : fmt::format("crack: begins after {} with a depth of {:.2g} mm", mgt(rail.begun), 1e3 * crack.depth);
  if (std::isfinite(rail.azimuth))
    out += fmt::format(", goes down at {:.0f} deg from the rolling", rail.azimuth * 180 / std::numbers::pi);
  if (rail.detectable < RailCrack::kNot)
    out += fmt::format(", is {:.2g} mm deep after {}", 1e3 * crack.detectable, mgt(rail.detectable));
  if (rail.allowable < RailCrack::kNot)
    return out + fmt::format(" and {:.2g} mm after {}: inspect at least every {}", 1e3 * crack.allowable,
                             mgt(rail.allowable), mgt(0.5 * (rail.allowable - rail.detectable)));
  const ClockMoment& end = history.back();
  if (!std::isfinite(end.crack_growth)) return out;
  out += fmt::format(" and {:.2f} mm in the end, where traffic deepens it by {:.3g} mm/MGT", 1e3 * end.crack,
                     unit::kMillimetresPerMGT.factor * end.crack_growth);
  return out + (end.crack > crack.depth ? "" : ": wear and grinding take off more than it grows");
}

}  // namespace railstrata
