#include "judge/window_change.hpp"

#include <algorithm>
#include <cmath>

#include "judge/check_limits.hpp"

namespace railstrata {
namespace {

constexpr double kForce = 0.005, kPressure = 0.005, kTraction = 0.02, kCreepage = 0.02, kSlipShare = 0.03;
constexpr double kLeastSlip = 1e-4;  // that creepages are compared with

}  // namespace

WindowChange change_between(const MeanContact& before, const MeanContact& last, const DriveSpec& drive) {
  WindowChange out;
  const auto differ = [&](double a, double b, double tolerance) {
    const double by = std::abs(a - b);
    out.largest = std::max(out.largest, by / tolerance);
    return by;
  };
  const double slip = std::max(std::hypot(last.creepage, last.lateral_creepage), kLeastSlip);
  const PatchMeasures &was = before.patch, &is = last.patch;
  differ(before.F_z, last.F_z, kForce * last.F_z);
  out.change = {.p_max = differ(was.p_max, is.p_max, kPressure * is.p_max),
                .q_max = differ(was.q_max, is.q_max, kTraction * is.q_max),
                .slip_area_fraction = differ(was.slip_area_fraction, is.slip_area_fraction, kSlipShare),
                .F_x = differ(before.F_x, last.F_x, kForce * last.F_z),
                .F_y = differ(before.F_y, last.F_y, kForce * last.F_z),
                .creepage_x = differ(before.creepage, last.creepage, kCreepage * slip),
                .creepage_y = differ(before.lateral_creepage, last.lateral_creepage, kCreepage * slip)};
  if (drive.creepage) out.change.creepage_x = kNotApplicable;
  if (!drive.lateral_traction_coefficient) out.change.creepage_y = kNotApplicable;
  return out;
}

void warn_of_change(const WindowChange& change, Summary& summary) {
  const CheckRow& row = check_row("windows_differ");
  if (repeats(change)) return;
  summary.warnings.push_back({.name = std::string(row.key),
                              .value = change.largest,
                              .limit = row.fem_limit,
                              .text = std::string(row.what) + ": " + std::string(row.advice)});
}

}  // namespace railstrata
