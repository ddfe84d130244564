#include "traffic/traffic_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/zone.hpp"
#include "record/number_text.hpp"
#include "record/unit.hpp"
#include "wear/wear_loop_page.hpp"

namespace railstrata {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();  // between two lines of a series
constexpr int kGrey = 4;                                           // among the page's colours

/// The next of 1, 2, 5, 10, … times a power of ten.
double round_up(double v) {
  const double power = std::pow(10, std::floor(std::log10(v)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power >= v * (1 - 1e-9)) return digit * power;
  return 10 * power;
}

/// Of a mechanism the row with the shortest life; null: none ends within what was followed.
const LifeRow* earliest(const std::vector<LifeRow>& lives, const std::string& mechanism) {
  const LifeRow* out = nullptr;
  for (const LifeRow& row : lives)
    if (row.mechanism == mechanism && std::isfinite(row.mgt.best) && (!out || row.mgt.best < out->mgt.best)) out = &row;
  return out;
}

/// A share that is used, up to the life by its mechanism.
ReportSeries used_line(const ClockResult& result, const char* name, const std::string& mechanism,
                       double ClockMoment::*value) {
  const LifeRow* fails = earliest(result.lives, mechanism);
  ReportSeries out{.name = name, .x = {}, .y = {}};
  for (const ClockMoment& m : result.history) {
    const double mgt = unit::kMGT.factor * m.kilograms;
    if (fails && mgt >= fails->mgt.best) break;
    out.x.push_back(mgt);
    out.y.push_back(std::min(m.*value, 1.0));
  }
  if (fails) {
    out.x.push_back(fails->mgt.best);
    out.y.push_back(1);
  }
  return out;
}

/// A depth over a round one.
ReportSeries depth_line(const ClockResult& result, const std::string& name, double ClockMoment::*depth, double one) {
  ReportSeries out{.name = fmt::format("{} (1 = {})", name, limit_text(unit::kMillimetres, one)), .x = {}, .y = {}};
  out.dash = "dash";
  for (const ClockMoment& m : result.history) {
    out.x.push_back(unit::kMGT.factor * m.kilograms);
    out.y.push_back(m.*depth / one);
  }
  return out;
}

ReportSeries grindings(const GrindingSpec& grinding, double reached) {
  ReportSeries out{.name = "grinding", .x = {}, .y = {}, .markers = false, .colour = kGrey, .dash = "dot"};
  for (double at = *grinding.every; at <= reached * (1 + 1e-12); at += *grinding.every)
    for (const double y : {0.0, 1.0, kGap}) {
      out.x.push_back(unit::kMGT.factor * at);
      out.y.push_back(y);
    }
  return out;
}

/// Depth below the new surface of a place that lies `depth` below that of a day, some of which has gone by then: at the
/// place as much of what has gone at the end as of the largest removed depth.
double from_new(const ClockResult& result, double mgt, double depth, double removed_at_end) {
  const ClockMoment* day = &result.history.front();
  for (const ClockMoment& m : result.history)
    if (unit::kMGT.factor * m.kilograms <= mgt) day = &m;
  const double end = result.history.back().removed;
  return depth + (end > 0 ? removed_at_end * day->removed / end : 0);
}

/// The place that the picture of the head marks.
struct MarkedPlace {
  std::string name;
  double mgt = 0, y = 0, depth = 0;  ///< m; below the surface of that day
};
MarkedPlace marked_place(const ClockResult& result) {
  const LifeRow* first = first_damage(result.lives);
  if (first && std::isfinite(first->mgt.best))
    return {"first crack: " + first->mechanism, first->mgt.best, first->y, first->depth};
  const ClockMoment& end = result.history.back();
  if (!(end.ductility > 0)) return {};
  return {fmt::format("most ductility used: {:.2g}", end.ductility), unit::kMGT.factor * end.kilograms, end.ductility_y,
          end.ductility_depth};
}

/// The cell whose y is nearest.
std::size_t cell_at(const RailDamage& d, double y) {
  std::size_t out = 0;
  for (std::size_t i = 0; i < d.y.size(); ++i)
    if (std::abs(d.y[i] - y) < std::abs(d.y[out] - y)) out = i;
  return out;
}

ReportSeries part_of(const ReportSeries& all, ShownCells cells) {
  ReportSeries out = all;
  const auto from = static_cast<std::ptrdiff_t>(cells.from), to = static_cast<std::ptrdiff_t>(cells.to);
  out.x.assign(all.x.begin() + from, all.x.begin() + to);
  out.y.assign(all.y.begin() + from, all.y.begin() + to);
  return out;
}

}  // namespace

ReportChart way_chart(const FollowedTraffic& traffic) {
  const ClockResult& result = traffic.best();
  ReportChart out{"traffic",
                  "The rail through its traffic",
                  "Share used: the largest of the metal that is still there; at 1 a crack begins, and the line ends. "
                  "Depths are shares of those in the legend.",
                  titled("traffic", unit::kMGT.shown),
                  "share used, depth",
                  {}};
  out.wide = true;
  for (const ReportSeries& used : {used_line(result, "ductility used", "ductility exhausted", &ClockMoment::ductility),
                                   used_line(result, "closed cycles used", "low-cycle fatigue", &ClockMoment::cycles),
                                   used_line(result, "fatigue used", "fatigue", &ClockMoment::fatigue)})
    if (*std::max_element(used.y.begin(), used.y.end()) > 0) out.series.push_back(used);
  const ClockMoment& end = result.history.back();
  const double one = round_up(std::max(end.removed, end.exhausted));
  if (end.removed > 0) out.series.push_back(depth_line(result, "removed depth", &ClockMoment::removed, one));
  if (end.exhausted > 0)
    out.series.push_back(depth_line(result, "skin without ductility", &ClockMoment::exhausted, one));
  if (const double layer = result.history.front().layer_left; std::isfinite(layer))
    out.series.push_back(depth_line(result, "layer left", &ClockMoment::layer_left, layer));
  if (const GrindingSpec& grinding = traffic.spec.life.grinding; grinding.every && *grinding.every <= result.reached)
    out.series.push_back(grindings(grinding, result.reached));
  return out;
}

ReportChart failure_chart(const FollowedTraffic& traffic) {
  const ClockResult& result = traffic.best();
  const RailDamage& d = traffic.unworn;
  std::vector<Vec2> unworn;
  for (std::size_t i = 0; i < d.y.size(); ++i) unworn.push_back({d.y[i], d.z[i]});
  std::vector<double> removed = worn_depth(unworn, result.profile);
  const MarkedPlace mark = marked_place(result);
  const std::size_t cell = cell_at(d, mark.y);
  const double deep = mark.name.empty() ? 0 : from_new(result, mark.mgt, mark.depth, removed[cell]);
  const std::vector<std::size_t> layers = layers_on(traffic.spec, BodyId::rail);
  const double foot = layers.empty() ? 0 : traffic.spec.layers[layers.front()].thickness;
  const double large = magnification({*std::max_element(removed.begin(), removed.end()), std::max(deep, foot)});
  const ShownCells cells = cells_above(d.passages, 0, 8);
  const auto line = [&](const std::string& name, std::vector<double> depth) {
    for (double& v : depth) v *= -large;
    return part_of(beside_profile(name, d, depth), cells);
  };
  ReportChart out{"head",
                  "The rail's head and where it fails first",
                  large > 1 ? fmt::format("Depths below the new surface are drawn {:.3g} times.", large) : "",
                  kAcross,
                  titled("z", unit::kMillimetres.shown),
                  {}};
  out.series = {line("new", std::vector<double>(d.y.size(), 0)),
                line(fmt::format("after {:.3g} MGT", unit::kMGT.factor * result.reached), removed)};
  if (!layers.empty()) out.series.push_back(line("bottom of the layer", std::vector<double>(d.y.size(), foot)));
  if (mark.name.empty()) return out;
  ReportSeries place = part_of(beside_profile("", d, std::vector<double>(d.y.size(), -large * deep)), {cell, cell + 1});
  place.name = fmt::format("{}, {:.2f} mm below the surface after {:.3g} MGT", mark.name,
                           unit::kMillimetres.factor * mark.depth, mark.mgt);
  place.markers = true;
  out.series.push_back(place);
  return out;
}

ReportChart deciding_chart(const TrafficRange& range) {
  ReportChart out{
      "decides",
      "What decides how long the rail lasts",
      fmt::format("Life until the first crack with one input at an end of its range, all others at their best "
                  "values ({} MGT); in brackets its share of the range. A bar that reaches the end of what "
                  "was followed may go further.",
                  range_text({range.first.best, range.first.best, range.first.best}, range.followed)),
      "first crack [MGT]",
      "",
      {}};
  const double best = std::isinf(range.first.best) ? range.followed : range.first.best;
  std::array<ReportSeries, 2> ends{ReportSeries{.name = "at the lower value", .x = {}, .y = {}},
                                   ReportSeries{.name = "at the higher value", .x = {}, .y = {}}};
  for (auto e = range.effects.rbegin(); e != range.effects.rend(); ++e) {
    const double row = static_cast<double>(out.bars.size());
    const std::string values = e->key.empty() ? "" : fmt::format(" {} to {}", e->value[0], e->value[1]);
    out.bars.push_back(fmt::format("{}{} ({:.0f} %)", e->input, values, kToPercent * e->share));
    for (std::size_t end = 0; end < ends.size(); ++end) {
      if (!e->known[end]) continue;
      const double life =
          std::isinf(e->life[end].mgt) ? std::max(range.followed, e->life[end].followed) : e->life[end].mgt;
      ends[end].x.insert(ends[end].x.end(), {best, life, kGap});
      ends[end].y.insert(ends[end].y.end(), {row, row, kGap});
    }
  }
  out.series.assign(ends.begin(), ends.end());
  return out;
}

}  // namespace railstrata
