#include "passes/run_residual.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/faults.hpp"
#include "fem/rail_at_rest.hpp"

namespace railstrata {
namespace {

constexpr double kStart = 6, kFarthestBehind = 6, kNearest = 4;  // half-lengths

std::string too_short(const Model& model, double a) {
  const double run_up = model.spec.run.run_up, start = std::max(kStart * a, run_up);
  return fmt::format(
      "the run is too short: stations are steady from {:.3g} mm ({}) to {:g} half-lengths of the patch ({:.3g} mm) "
      "behind the wheel; let run.positions end at {:.3g} mm or more",
      1e3 * start,
      run_up > kStart * a ? std::string("run.run_up") : fmt::format("{:g} half-lengths of the patch", kStart), kNearest,
      1e3 * kNearest * a, 1e3 * (start + kFarthestBehind * a));
}

constexpr ResidualNumber kNumbers[] = {
    {"sigma_x_min", unit::kMPa, "Most compressive residual stress along the rail",
     [](const RunResidual& r) { return r.pass.row.stress[0]; }},
    {"sigma_x_depth", unit::kMillimetres, "Its depth", [](const RunResidual& r) { return r.pass.row.stress_depth[0]; }},
    {"sigma_y_min", unit::kMPa, "Most compressive residual stress across the rail, along the surface",
     [](const RunResidual& r) { return r.pass.row.stress[1]; }},
    {"sigma_y_depth", unit::kMillimetres, "Its depth", [](const RunResidual& r) { return r.pass.row.stress_depth[1]; }},
    {"plastic_strain", unit::kNone, "Largest equivalent plastic strain √(2/3) |E^p|",
     [](const RunResidual& r) { return r.pass.row.strain; }},
    {"balance", unit::kNone,
     "Larger resultant of the shear stresses τ_xy and τ_xz over the section, divided by the integral of |σ_x|: 0 in "
     "equilibrium",
     [](const RunResidual& r) { return r.pass.row.balance; }},
    {"steady_from", unit::kMillimetres, "First station of the mean, measured from the start of the wheel",
     [](const RunResidual& r) { return r.from; }},
    {"steady_to", unit::kMillimetres, "Last station of the mean", [](const RunResidual& r) { return r.to; }},
    {"uneven", unit::kNone,
     "Largest difference of the plastic strain between the two halves of these stations, divided by the largest "
     "plastic strain: 0 where rolling is steady",
     [](const RunResidual& r) { return r.pass.uneven; }}};

}  // namespace

std::span<const ResidualNumber> residual_numbers() { return kNumbers; }

RunResidual run_residual(const RollingSystem& system, const RollingState& end) {
  RunResidual out;
  const Model& model = system.model;
  const double a = hertz_estimate(model.spec, model.placement.contact).a, wheel = end.axle.pose().x;
  out.from = wheel - kFarthestBehind * a;
  out.to = wheel - kNearest * a;
  if (out.from < std::max(kStart * a, model.spec.run.run_up)) {
    out.none = too_short(model, a);
    return out;
  }
  const Body& rail = system.rail();
  const PlasticHistory& history = end.bodies[kRail].history;
  const double middle = 0.5 * (out.from + out.to);
  const PlasticSection after = plastic_section(rail, history, out.from, out.to), before = on_quads({}, after);
  const bool yielded = std::any_of(after.history.begin(), after.history.end(), [](double v) { return v != 0; });
  if (!yielded) {
    out.none = "the rail has not yielded there";
    return out;
  }
  RailBefore at_rest;
  at_rest.history = history_of_section(rail, after);
  try {
    at_rest.u = rail_at_rest(system, at_rest.history, true);
  } catch (const NumericalError& e) {  // the run itself is sound
    out.none = e.what();
    return out;
  }
  out.pass = rolled_pass(system, model, before, after, at_rest, middle);
  out.pass.uneven = unevenness(before, plastic_section(rail, history, out.from, middle),
                               plastic_section(rail, history, middle, out.to));
  return out;
}

std::string describe(const RunResidual& residual) {
  if (!residual.none.empty()) return fmt::format("residual stress not available: {}", residual.none);
  const PassRow& row = residual.pass.row;
  return fmt::format(
      "residual stress behind the wheel: {:.0f} MPa along, {:.0f} MPa across where it is most compressive",
      1e-6 * row.stress[0], 1e-6 * row.stress[1]);
}

std::string doubt_of(const RunResidual& residual) {
  if (!residual.none.empty() || residual.pass.uneven <= kLargestUnevenness) return {};
  return fmt::format(
      "plastic strain varies by {:.2g} of its largest along the stations that give the residual stress: roll farther, "
      "or use `railstrata passes --engine fem` with a given creepage, which becomes steady sooner",
      residual.pass.uneven);
}

}  // namespace railstrata
