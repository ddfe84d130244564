#include "fem/contact_step.hpp"

#include <algorithm>

#include "core/body_id.hpp"
#include "fem/line_reach.hpp"

namespace railstrata {
namespace {

double inverse_mass(const RollingBody& b, std::ptrdiff_t i) { return b.scaling.share(i) * b.body.inverse_mass[i]; }

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

// Of a node of a body that turns.
FreeMotion turning_node(const RollingBody& b, const BodyState& state, std::ptrdiff_t i, SurfaceIndex at,
                        const StepScope& scope) {
  return free_wheel_node(b.frame, b.mean, b.arm(b.body.mesh.contact.block, at.column, at.station),
                         b.body.inverse_mass[i], vector_at(state.f, i, b.surface.stride),
                         vector_at(state.v, i, b.surface.stride), scope.gravity, scope.dt, scope.damping_rate);
}

void gather_rail(const MortarRows& rows, const RollingBody& b, const BodyState& state, const StepScope& scope,
                 ContactSide& side) {
  side.clear();
  for (const ContactRow& r : rows.rows) {
    const int stride = b.surface.stride;
    const FreeMotion motion =
        b.turns() ? turning_node(b, state, r.rail, {r.column, r.station}, scope)
                  : free_rail_node(b.body.inverse_mass[r.rail], vector_at(state.f, r.rail, stride),
                                   vector_at(state.v, r.rail, stride), scope.gravity, scope.dt, scope.damping_rate);
    side.before.push_back(motion.before);
    side.velocity.push_back(motion.after);
    side.inverse_mass.push_back(inverse_mass(b, r.rail));
  }
}

void gather_wheel(const std::vector<std::ptrdiff_t>& nodes, const RollingBody& b, const BodyState& state,
                  const StepScope& scope, ContactSide& side) {
  side.clear();
  for (std::ptrdiff_t i : nodes) {
    const FreeMotion motion = turning_node(b, state, i, b.surface.node_at(i), scope);
    side.before.push_back(motion.before);
    side.velocity.push_back(motion.after);
    side.inverse_mass.push_back(inverse_mass(b, i));
  }
}

}  // namespace

SearchWindow search_window(const RollingSystem& sys) {
  return {search_half_length(sys.model), 0.25 * sys.model.hertz.approach};
}

ContactStep::ContactStep(const ContactSurface& rail, const ContactSurface& wheel, const EnforcementOptions& options,
                         const SearchWindow& window)
    : search_(rail, wheel), window_(window), options_(options) {}

void ContactStep::restore(Restart restart) {
  search_.restore(std::move(restart.facets));
  reached_edge_ = restart.reached_edge;
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
  numbering_.number(*rows_, bodies[kWheel].surface, system_);
  gather_rail(*rows_, bodies[kRail], states[kRail], scope, system_.rail);
  gather_wheel(system_.wheel_nodes, bodies[kWheel], states[kWheel], scope, system_.wheel);
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
