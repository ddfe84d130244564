#include "fem/guards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/faults.hpp"

namespace railstrata {
namespace {

// Nothing of a sound run moves by an element in one step; false for NaN too.
bool axle_keeps_pace(const Stepper& st) {
  const AxleMotion& a = st.state().axle;
  const double travel = st.dt() * std::max({std::abs(a.vx), std::abs(a.vy), std::abs(a.vz)});
  return std::isfinite(a.x) && std::isfinite(a.spin) && travel < st.system().model.spec.mesh.element_size;
}

std::string when(const Stepper& st) {
  return fmt::format("t = {:.4g} ms, x = {:.4g} mm", 1e3 * st.state().time, 1e3 * st.position());
}

[[noreturn]] void end_run(const Stepper& st, const std::string& what, const std::string& numbers,
                          const std::string& remedy) {
  throw NumericalError(fmt::format("{} at {} ({})\n    try {}", what, when(st), numbers, remedy));
}

[[noreturn]] void end_unstable(const Stepper& st, const std::string& where) {
  throw NumericalError(
      fmt::format("the run became unstable at {}: numbers are no longer finite or beyond all bounds ({}); dt = {:.3g} "
                  "us\n    try a smaller run.step_safety",
                  when(st), where.empty() ? "forces on the axle" : where, 1e6 * st.dt()));
}

void require_shape(const BandSample& sample, const SweptBody& body) {
  std::vector<Vec2> section = body.blocks[body.contact.block].section.nodes;
  if (body.rises())
    for (Vec2& p : section) p.z = -p.z;
  const std::optional<InvertedElement> worst = inverted_element(sample, section);
  if (!worst) return;
  const Vec3 at = worst->centre;
  throw NumericalError(
      fmt::format("an element of the {}'s contact band is turned inside out {:.1f} mm from the axle, y = {:.1f} mm, z "
                  "= {:.1f} mm (Jacobian {:.2g} of the undeformed one)\n"
                  "    try a smaller run.step_safety, a lighter load, or a coarser mesh.element_size",
                  body.name, 1e3 * at.x, 1e3 * at.y, 1e3 * at.z, worst->jacobian));
}

}  // namespace

std::optional<InvertedElement> inverted_element(const BandSample& s, const std::vector<Vec2>& section) {
  assert(section.size() >= static_cast<std::size_t>(s.rows + 1) * static_cast<std::size_t>(s.columns + 1));
  std::optional<InvertedElement> worst;
  const int across = s.columns + 1, plane = (s.rows + 1) * across;
  for (int j = 0; j < s.stations; ++j)
    for (int r = 0; r < s.rows; ++r)
      for (int c = 0; c < s.columns; ++c) {
        Vec3 x[2][2][2], rest[2][2][2];  // [station][row][column]
        for (int a = 0; a < 2; ++a)
          for (int b = 0; b < 2; ++b)
            for (int d = 0; d < 2; ++d) {
              const int node = (r + b) * across + c + d;
              rest[a][b][d] = {s.along[j + a], section[node].y, section[node].z};
              x[a][b][d] = rest[a][b][d] + s.displacement[static_cast<std::size_t>(j + a) * plane + node];
            }
        for (int a = 0; a < 2; ++a)
          for (int b = 0; b < 2; ++b)
            for (int d = 0; d < 2; ++d) {
              const auto corner = [&](const Vec3(&p)[2][2][2]) {
                return dot(p[1][b][d] - p[0][b][d], cross(p[a][1][d] - p[a][0][d], p[a][b][1] - p[a][b][0]));
              };
              const double share = corner(x) / corner(rest);
              if (share > 0 || (worst && share >= worst->jacobian)) continue;
              worst = InvertedElement{0.5 * (rest[0][0][0] + rest[1][1][1]), share};
            }
      }
  return worst;
}

void require_sound(const Stepper& st) {
  if (std::isfinite(st.forces().z) && std::isfinite(st.creepage()) && axle_keeps_pace(st)) return;
  end_unstable(st, st.check_finite());
}

void require_finite(const Stepper& st) {
  if (const std::string where = st.check_finite(); !where.empty()) end_unstable(st, where);
}

void require_forward(const Stepper& st) {
  if (st.speed() <= 0 || (st.system().on_ring() && st.state().axle.spin <= 0))
    throw NumericalError(
        fmt::format("the wheel came to a stand at {}\n    try a higher drive.speed, less braking by "
                    "drive.traction_coefficient, or nearer run.positions",
                    when(st)));
}

void require_within_bounds(const Stepper& st, const HistoryRow& row, double largest_energy, std::size_t row_number,
                           const GuardLimits& limits) {
  const Model& model = st.system().model;
  const bool flies = !model.spec.irregularities.empty() && row.way.lowering > -limits.highest_flight;
  if (!flies && row.forces.z < limits.lost_contact * model.load)
    end_run(st, "the wheel lost contact with the rail",
            fmt::format("F_z = {:.3g} kN of {:.3g} kN", 1e-3 * row.forces.z, 1e-3 * model.load),
            "a longer run.run_up or more run.run_up_damping");
  if (!(std::abs(row.closure) <= limits.energy_drift * largest_energy))
    end_run(st, "the energy balance drifts",
            fmt::format("{:.3g} J beside {:.3g} J of strain energy or torque work", row.closure, largest_energy),
            "a smaller run.step_safety");
  if (!(row.forces.penetration <= limits.penetration * model.hertz.approach))
    end_run(
        st, "the wheel sinks into the rail",
        fmt::format("{:.3g} um, the approach is {:.3g} um", 1e6 * row.forces.penetration, 1e6 * model.hertz.approach),
        "a smaller run.step_safety");
  // of a body that yields the modes hold bending that stays, of which no energy is stored
  if (!model.spec.run.plasticity && !(row.energy.hourglass <= limits.hourglass_share * row.energy.strain))
    end_run(st, "hourglass modes hold too much energy",
            fmt::format("{:.3g} of the strain energy", row.energy.hourglass / row.energy.strain),
            element_options(model.spec).element == ElementKind::one_point
                ? "mesh.element = \"full\""
                : "a smaller mesh.element_size, more elements through the layers (layer.elements) or layers that are "
                  "not so soft");
  if (row_number % limits.rows_between_shapes != 0) return;
  const RollingSample sample = take_sample(st);
  require_shape(sample.rail, model.rail);
  require_shape(sample.wheel, model.wheel);
}

}  // namespace railstrata
