#include "fem/steady_start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "body/field_algebra.hpp"
#include "contact/enforcement_law.hpp"
#include "fem/reference_frame.hpp"

namespace railstrata {
namespace {

// From the axle of a revolved body to an undeformed node of its surface, in the body's axes.
Vec3 arm_of(const ContactSurface& surface, SurfaceIndex at) {
  const double z = surface.node[at.column].z, turn = surface.stations.at[at.station];
  return {-z * std::sin(turn), 0, z * std::cos(turn)};
}

}  // namespace

SteadyCells::SteadyCells(const RollingSystem& system, const MortarRows& rows, const std::vector<double>& pressure)
    : sys_(system), rows_(rows), pressure_(pressure) {
  const ContactSurface& rail = sys_.rail_surface();
  const auto columns = std::minmax_element(rows.rows.begin(), rows.rows.end(),
                                           [](const auto& a, const auto& b) { return a.column < b.column; });
  const auto stations = std::minmax_element(rows.rows.begin(), rows.rows.end(),
                                            [](const auto& a, const auto& b) { return a.station < b.station; });
  first_column_ = columns.first->column;
  ny_ = columns.second->column - first_column_ + 1;
  nx_ = stations.second->station - stations.first->station + 1;
  along_ = rail.rises ? -1 : 1;
  first_station_ = rail.rises ? stations.second->station : stations.first->station;
  const auto& at = rail.stations.at;
  dx_ = rail.radius * (at[stations.second->station] - at[stations.first->station]) / (nx_ - 1);
  dy_ = (rail.s[columns.second->column] - rail.s[first_column_]) / (ny_ - 1);
}

std::size_t SteadyCells::cell(const ContactRow& row) const {
  return static_cast<std::size_t>(along_ * (row.station - first_station_)) * ny_ + (row.column - first_column_);
}

SteadyCells::Point SteadyCells::point(const ContactRow& row, const std::array<Field, 2>& u,
                                      const StartMotion& motion) const {
  const ContactSurface &rail = sys_.rail_surface(), &wheel = sys_.wheel_surface();
  Vec3 displaced, arm;
  for (int w = row.first; w < row.first + row.count; ++w) {
    const WheelWeight& weight = rows_.weights[w];
    displaced += weight.m * vector_at(u[kWheel], weight.wheel, wheel.stride);
    arm += weight.m * arm_of(wheel, wheel.node_at(weight.wheel));
  }
  const double speed = sys_.spec().drive.speed, passed = motion.spin * sys_.rolling_radius / speed;
  Point out;
  out.apart = passed * yaw(wheel.yaw, displaced) - vector_at(u[kRail], row.rail, rail.stride);
  out.rigid = yaw(wheel.yaw, spun(motion.spin, arm)) + Vec3{0, motion.lateral_speed, 0};
  if (sys_.on_ring())
    out.rigid -= spun(sys_.rail_spin, arm_of(rail, {row.column, row.station}));
  else
    out.rigid.x += speed;
  return out;
}

SteadyQuestion SteadyCells::ask(const SurfaceTractions& traction, const std::array<Field, 2>& u,
                                const StartMotion& motion) const {
  SteadyQuestion out;
  out.nx = nx_;
  out.ny = ny_;
  out.dx = dx_;
  out.dy = dy_;
  const std::size_t cells = static_cast<std::size_t>(nx_) * ny_;
  out.bound.assign(cells, 0.0);
  out.gap.assign(cells, std::numeric_limits<double>::infinity());
  for (int d = 0; d < 2; ++d) {
    out.traction[d].assign(cells, 0.0);
    out.slip[d].assign(cells, 0.0);
  }
  std::vector<const ContactRow*> row_of(cells + ny_, nullptr);
  for (const ContactRow& row : rows_.rows) row_of[cell(row)] = &row;
  const EnforcementOptions& contact = sys_.options.contact;
  std::array<double, 2> in_cells{}, in_rows{};
  for (std::size_t k = 0; k < rows_.rows.size(); ++k) {
    const ContactRow& row = rows_.rows[k];
    const std::size_t c = cell(row);
    const ContactRow* ahead = row_of[c + ny_];
    out.gap[c] = row.gap;
    if (!ahead) continue;
    const double f =
        contact.coefficient_across.empty() ? contact.friction.coefficient : contact.coefficient_across[row.column];
    out.bound[c] = f * pressure_[k];
    const NodeTraction& t = traction.at(row.column, row.station);
    const Point here = point(row, u, motion), there = point(*ahead, u, motion);
    const Vec3 slip =
        (0.5 / sys_.spec().drive.speed) * (here.rigid + there.rigid) + (1 / dx_) * (here.apart - there.apart);
    const TangentFrame frame = tangent_frame(row.normal);
    const std::array<double, 2> q{t.q1, t.q2}, s{dot(slip, frame.t1), dot(slip, frame.t2)};
    for (int d = 0; d < 2; ++d) {
      out.traction[d][c] = q[d];
      out.slip[d][c] = s[d];
      in_cells[d] += q[d] * dx_ * dy_;
      in_rows[d] += q[d] * row.area;
    }
  }
  const std::array<std::optional<double>, 2> wanted{
      sys_.options.keeps_pace ? std::optional<double>() : -sys_.spec().drive.traction().value_or(0) * sys_.model.load,
      sys_.options.free_sideways ? std::optional<double>(sys_.options.lateral_friction) : std::nullopt};
  for (int d = 0; d < 2; ++d)
    if (wanted[d]) out.force[d] = *wanted[d] * (in_rows[d] != 0 ? in_cells[d] / in_rows[d] : 1.0);
  return out;
}

double SteadyCells::take(const SteadyAnswer& answer, SurfaceTractions& traction) const {
  double changed = 0, all = 0;
  for (const ContactRow& row : rows_.rows) {
    NodeTraction& t = traction.at(row.column, row.station);
    const std::size_t c = cell(row);
    const double q1 = answer.traction[0][c], q2 = answer.traction[1][c];
    changed += (q1 - t.q1) * (q1 - t.q1) + (q2 - t.q2) * (q2 - t.q2);
    all += q1 * q1 + q2 * q2;
    t.q1 = q1;
    t.q2 = q2;
  }
  return all > 0 ? std::sqrt(changed / all) : 0.0;
}

}  // namespace railstrata
