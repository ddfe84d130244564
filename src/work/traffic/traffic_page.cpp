#include "traffic/traffic_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "record/number_text.hpp"
#include "record/unit.hpp"
#include "traffic/assumptions.hpp"
#include "traffic/traffic_charts.hpp"

namespace railstrata {
namespace {

/// To a tenth of a mm, and never "-0.0".
std::string place_text(double y) {
  return fmt::format("y = {:.1f} mm", 0.1 * std::round(10 * unit::kMillimetres.factor * y) + 0.0);
}

/// " (12 to 31)", of several runs.
std::string range_words(const FollowedTraffic& t, const LifeRange& range) {
  if (!t.has_range()) return {};
  const auto end = [&](double v) { return range_text({v, v, v}, t.range.followed); };
  return fmt::format(" ({} to {})", end(range.low), end(range.high));
}

ReportAnswer unknown_answer(const FollowedTraffic& t) {
  std::vector<std::string> lacking;
  for (const LifeRow& row : t.best().lives) {
    const std::string text = fmt::format("{} of {} (give {})", row.mechanism, row.zone, row.rests_on);
    if (!row.known() && std::find(lacking.begin(), lacking.end(), text) == lacking.end()) lacking.push_back(text);
  }
  if (lacking.empty()) return {};
  return {"plain", "Not known", fmt::format("{}", fmt::join(lacking, "; "))};
}

ReportAnswer crack_answer(const FollowedTraffic& t) {
  const LifeRow* row = first_damage(t.best().lives);
  if (!row) return {"open", "First crack", "not known"};
  if (std::isinf(row->mgt.best)) {
    const bool sure = std::isinf(t.range.first.low) && unknown_answer(t).text.empty();
    return {sure ? "good" : "open", "No crack",
            fmt::format("within the {:.3g} MGT that were followed{}", row->followed,
                        std::isinf(t.range.first.low)
                            ? ""
                            : fmt::format("; at the lower end of its range after {:.3g} MGT", t.range.first.low))};
  }
  return {"open", "First crack",
          fmt::format("after {:.3g} MGT{} at {}, {:.2f} mm deep ({}, {}), by {}", row->mgt.best,
                      range_words(t, t.range.first), place_text(row->y), unit::kMillimetres.factor * row->depth,
                      row->zone, row->place, row->mechanism)};
}

ReportAnswer layer_answer(const FollowedTraffic& t) {
  for (const LifeRow& row : t.range.lives)
    if (row.mechanism == kWornThrough) {
      if (std::isfinite(row.mgt.best))
        return {"open", "Layer", fmt::format("worn through after {:.3g} MGT{}", row.mgt.best, range_words(t, row.mgt))};
      return {"plain", "Layer",
              fmt::format("{} of {} left after {:.3g} MGT",
                          with_unit(unit::kMillimetres, t.best().history.back().layer_left, 3),
                          with_unit(unit::kMillimetres, t.best().history.front().layer_left, 3), row.followed)};
    }
  return {};
}

ReportAnswer removed_answer(const FollowedTraffic& t) {
  const ClockMoment& end = t.best().history.back();
  const double mgt = unit::kMGT.factor * end.kilograms;
  if (!(end.removed > 0)) return {};
  return {"plain", "Wear and grinding",
          fmt::format("{} after {:.3g} MGT at {}, where most has gone", with_unit(unit::kMillimetres, end.removed, 3),
                      mgt, place_text(end.removed_y))};
}

ReportAnswer deciding_answer(const FollowedTraffic& t) {
  if (!t.has_range()) return {"plain", "Range", "one run with the best values; the flag --range computes it"};
  const std::string text = deciding_text(t.range);
  return {"plain", "Range", text.empty() ? "no input changes this answer" : text};
}

}  // namespace

std::vector<ReportAnswer> traffic_answers(const FollowedTraffic& traffic) {
  std::vector<ReportAnswer> out;
  for (const ReportAnswer& answer : {crack_answer(traffic), layer_answer(traffic), deciding_answer(traffic),
                                     removed_answer(traffic), unknown_answer(traffic)})
    if (!answer.text.empty()) out.push_back(answer);
  for (const std::string& note : traffic.best().notes) out.push_back({"open", "Note", note});
  return out;
}

CollectiveFront traffic_front(const FollowedTraffic& traffic) {
  CollectiveFront out{traffic_answers(traffic), {way_chart(traffic), failure_chart(traffic)}, {}};
  if (traffic.has_range()) out.charts.push_back(deciding_chart(traffic.range));
  out.tables.push_back(assumptions_table(traffic));
  return out;
}

}  // namespace railstrata
