#include "fem/contact_step.hpp"

#include <algorithm>

#include "core/body_id.hpp"
#include "fem/line_reach.hpp"

namespace railstrata {
namespace {

// A force [N] of the wheel on the rail in a row of the contact, to the nodes of both bodies; add(body, index, force on
// the node).
template <class Add>
void distribute(const MortarRows& rows, const ContactRow& row, const RollingBodies& bodies, Vec3 force, Add&& add) {
  const Vec3 turned = bodies[kWheel].frame.to_frame(force), to_rail = bodies[kRail].frame.to_frame(force);
  const double on_rail[3] = {to_rail.x, to_rail.y, to_rail.z}, on_wheel[3] = {-turned.x, -turned.y, -turned.z};
  for (int i = 0; i < 3; ++i) add(kRail, row.rail + i * bodies[kRail].surface.stride, on_rail[i]);
  for (int w = row.first; w < row.first + row.count; ++w)
    for (int i = 0; i < 3; ++i)
      add(kWheel, rows.weights[w].wheel + i * bodies[kWheel].surface.stride, rows.weights[w].m * on_wheel[i]);
}

// Adds a node of a body, `i` its index.
void add_node(const RollingBody& b, const BodyState& state, std::ptrdiff_t i, SurfaceIndex at, const StepScope& scope,
              ContactSide& side) {
  const double m = b.body.inverse_mass[i];
  const Vec3 f = vector_at(state.f, i, b.surface.stride), v = vector_at(state.v, i, b.surface.stride);
  const FreeMotion motion =
      b.turns() ? free_wheel_node(b.frame, b.mean, b.arm(b.body.mesh.contact.block, at.column, at.station), m, f, v,
                                  scope.gravity, scope.dt, scope.damping_rate)
                : free_rail_node(m, f, v, scope.gravity, scope.dt, scope.damping_rate);
  side.before.push_back(motion.before);
  side.velocity.push_back(motion.after);
  side.inverse_mass.push_back(b.scaling.share(i) * m);
}

}  // namespace

SearchWindow search_window(const RollingSystem& sys) {
  return {search_half_length(sys.model), 0.25 * sys.model.hertz.approach};
}

ContactStep::ContactStep(const RollingSystem& system)
    : search_(system.rail_surface(), system.wheel_surface()),
      window_(search_window(system)),
      options_(system.options.contact) {}

void ContactStep::save(RestartState& to) const {
  to.facets = search_.facets();
  to.reached_edge = reached_edge_;
}

void ContactStep::restore(RestartState&& from) {
  search_.restore(std::move(from.facets));
  reached_edge_ = from.reached_edge;
}

Vec3 ContactStep::force_on_rail(const ContactRow& row, const SurfaceTractions& tractions) const {
  return row.area * traction_vector(tractions.at(row.column, row.station), row.normal);
}

void ContactStep::find_rows(long step, RollingBodies& bodies, const BodyStates& states, const AxlePose& pose,
                            SurfaceTractions& tractions) {
  const Field& u_rail = surface_displacement(bodies[kRail], states[kRail]);
  const Field& u_wheel = surface_displacement(bodies[kWheel], states[kWheel]);
  const bool anew = step % kSearchInterval == 0;
  if (anew) search_.search(u_rail, u_wheel, pose, window_.half_length, window_.gap);
  rows_ = &search_.rows(u_rail, u_wheel, pose);
  reached_edge_ = reached_edge_ || rows_->reached_edge;
  if (!anew) return;
  kept_.clear();
  for (const ContactRow& r : rows_->rows) kept_.push_back(tractions.at(r.column, r.station));
  for (NodeTraction& t : tractions.all()) t = apart(t);
  for (std::size_t k = 0; k < kept_.size(); ++k) tractions.at(rows_->rows[k].column, rows_->rows[k].station) = kept_[k];
}

void ContactStep::gather(const RollingBodies& bodies, const BodyStates& states, const StepScope& scope) {
  number_wheel_nodes(*rows_, bodies[kWheel].surface, system_);
  system_.rail.clear();
  for (const ContactRow& r : rows_->rows)
    add_node(bodies[kRail], states[kRail], r.rail, {r.column, r.station}, scope, system_.rail);
  system_.wheel.clear();
  for (std::ptrdiff_t i : system_.wheel_nodes)
    add_node(bodies[kWheel], states[kWheel], i, bodies[kWheel].surface.node_at(i), scope, system_.wheel);
}

void ContactStep::apply_tractions(const RollingBodies& bodies, BodyStates& states,
                                  const SurfaceTractions& tractions) const {
  for (const ContactRow& row : rows_->rows) {
    if (tractions.at(row.column, row.station).p <= 0) continue;
    distribute(*rows_, row, bodies, force_on_rail(row, tractions),
               [&](std::size_t body, std::ptrdiff_t i, double part) {
                 bodies[body].scaling.add_force(states[body].f, i, -part);
               });
  }
}

ContactLosses ContactStep::measure(double dt, SurfaceTractions& tractions) {
  const ContactSystem& c = system_;
  forces_ = {};
  forces_.sweeps = c.sweeps;
  ContactLosses losses;
  for (std::size_t k = 0; k < rows_->rows.size(); ++k) {
    const ContactRow& row = rows_->rows[k];
    NodeTraction& traction = tractions.at(row.column, row.station);
    const double p = traction.p;
    if (p <= 0) continue;
    const Vec3 force = force_on_rail(row, tractions);
    Vec3 slip = -0.5 * (c.rail.before[k] + c.rail.velocity[k]);  // mean of the step, wheel against rail
    for (int w = row.first; w < row.first + row.count; ++w) {
      const int n = c.weight_node[w];
      slip += (0.5 * rows_->weights[w].m) * (c.wheel.before[n] + c.wheel.velocity[n]);
    }
    forces_.x -= force.x;
    forces_.y -= force.y;
    forces_.z -= force.z;
    forces_.penetration = std::max(forces_.penetration, -row.gap);
    ++forces_.nodes;
    const RowLosses lost = row_losses(row.area, row.normal, force, p, slip);
    losses.normal += lost.normal;
    losses.friction += lost.friction;
    traction.friction_work += dt * lost.friction / row.area;
  }
  return losses;
}

}  // namespace railstrata
