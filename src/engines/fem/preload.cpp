#include "fem/preload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "body/plastic_pass.hpp"
#include "body/traversal.hpp"
#include "core/faults.hpp"
#include "fem/static_preconditioner.hpp"
#include "mesh/split_interface.hpp"

namespace railstrata {
namespace {

constexpr double kPenetration = 1e-4;         // of the Hertzian approach
constexpr double kVirtualPenetration = 0.55;  // of the approach: rigid profiles pushed so far into one another overlap
                                              // in about the patch [PiotrowskiKik2008]
constexpr double kPenaltyScale =
    1000.0;  // springs of a linear step, of a surface element's stiffness: penetrations of nanometres
constexpr double kForcing = 0.02;                // of the residual, left over by a linear step
constexpr double kLastStep = 0.3;                // of the tolerance, likewise
constexpr double kNearGap = 0.3, kFarGap = 1.5;  // of the approach, where the contact looks; farther for the gap of
                                                 // two stations ahead (bem/leading_edge.hpp)
constexpr double kSettled = 2e-3;                // change of the friction of steady rolling in a pass, over it
constexpr double kEnough = 3e-3;                 // residual before the next pass, of the change in the last one, within
constexpr double kLeastEnough = 3e-5, kMostEnough = 1e-3;
constexpr int kMostPasses = 12;
constexpr int kMostSteps = 100, kMostPlasticSteps = 400, kMostIterations = 5000;

class Preload {
 public:
  Preload(const RollingSystem& system, const RailBefore* before, const Ranks& ranks, const SteadyFriction& friction)
      : sys_(system),
        ask_(friction),
        motion_{system.start_spin, system.options.lateral_speed},
        share_(system, ranks),
        contact_(system.rail_surface(), system.wheel_surface()),
        tractions_(system.rail_surface().columns, system.rail_surface().stations.nodes()),
        friction_(tractions_),
        before_(before),
        virgin_{before ? before->history : initial_history(system.rail()), initial_history(system.wheel())},
        history_(virgin_),
        preconditioner_(system, share_, [this](StaticVector& x, StaticVector& y) { stiffness(x, y); }),
        u_(zero_vector(system)) {
    element_stiffness_ = young(sys_.rail().materials.front()) / sys_.spec().mesh.element_size;
    penalty_ = kPenaltyScale * element_stiffness_;
  }

  PreloadResult solve(double tolerance, const PreloadProgress& progress) {
    start_from_overlap();
    PreloadResult out;
    const StaticVector weight = loads();
    const double load = std::sqrt(share_.dot(weight, weight));
    for (int step = 1;; ++step) {
      update_contact();
      StaticVector r = residual();
      out.residual = std::sqrt(share_.dot(r, r)) / load;
      out.penetration = penetration();
      out.newton_steps = step;
      const double wanted = std::max(tolerance, enough_for_friction());
      const bool stop = progress && !progress(out.residual, wanted, out.cg_iterations);
      if (!std::isfinite(out.residual))
        throw NumericalError("static preload: the residual is not a number" + what_to_try());
      if (out.residual < wanted && out.penetration < kPenetration * sys_.model.hertz.approach) {
        if (!extend() && !improve_friction()) break;
        continue;
      }
      if (step > (sys_.model.spec.run.plasticity ? kMostPlasticSteps : kMostSteps))
        throw NumericalError(
            fmt::format("static preload: no equilibrium after {} steps, residual {:.2e} (wanted {:.1e}){}", step,
                        out.residual, wanted, what_to_try()));
      if (any_rank_stops(stop, out.residual))
        throw Interrupted("stopped during the static preload: there is nothing to resume yet");
      apply_gap_springs(r);
      out.cg_iterations +=
          conjugate_gradients(r, load * std::max(kLastStep * wanted, kForcing * std::min(out.residual, 1.0)));
      advance(r);
    }
    out.u = u_.body;
    if (before_) out.before = before_->u;
    out.history = std::move(history_);
    out.axle_z = u_.axle;
    out.foot_z = foot_height(sys_, 0, out.u[kRail]);
    for (NodeTraction& t : tractions_.all()) t = {};
    const double ratio = friction_ratio();
    for (std::size_t k = 0; k < rows_->rows.size(); ++k) {
      const ContactRow& row = rows_->rows[k];
      const NodeTraction t = traction_of(k, ratio);
      tractions_.at(row.column, row.station) = t;
      out.contact_force -= row.area * traction_vector(t, row.normal);
    }
    out.tractions = tractions_;
    out.motion = motion_;
    out.steady_passes = passes_;
    out.steady_change = change_;
    return out;
  }

 private:
  // Nearly always the patch falls between the nodes.
  std::string what_to_try() const {
    const Model& m = sys_.model;
    return fmt::format(
        "\n    try a smaller mesh.element_size, now {:.3g} mm: the patch is about {:.3g} mm by {:.3g} mm",
        1e3 * m.spec.mesh.element_size, 2e3 * m.hertz.a, 2e3 * m.hertz.b);
  }

  double search_length() const { return 2 * sys_.model.hertz.a + 4 * sys_.spec().mesh.element_size + sys_.model.reach; }

  // How far the rigid wheel comes down to touch the heights along the middle of the contact.
  double rigid_descent() const {
    const double length = search_length(), step = 0.25 * sys_.spec().mesh.element_size;
    double least = std::numeric_limits<double>::infinity();
    for (double x = -length; x <= length; x += step)
      least = std::min(least, x * x / (2 * sys_.rolling_radius) - sys_.rail_surface().heights.at(x, 0).z -
                                  sys_.wheel_surface().heights.at(x, 0).z);
    return least;
  }

  void start_from_overlap() {
    if (before_) u_.body[kRail] = before_->u;
    u_.axle = -kVirtualPenetration * sys_.model.hertz.approach;
    if (!(sys_.rail_surface().heights.none() && sys_.wheel_surface().heights.none())) u_.axle -= rigid_descent();
    for (const NodeLine& l : sys_.wheel().lines)
      if (l.component == 2) std::fill_n(u_.body[kWheel].begin() + l.first, l.count, u_.axle);
    sys_.apply_constraints(u_.body[kRail], u_.body[kWheel], {0, 0, u_.axle, 0});
  }

  // Weight of everything on its nodes and on the axle; centrifugal forces of a wheel that rolls.
  StaticVector loads() const {
    StaticVector f = zero_vector(sys_);
    const double g = sys_.gravity;
    for (std::size_t k = 0; k < f.body.size(); ++k)
      for (const NodeLine& l : sys_.bodies[k].lines)
        if (l.component == 2)
          for (int j = 0; j < l.count; ++j) f.body[k][l.first + j] = -g * sys_.bodies[k].mass[l.first + j];
    add_centrifugal(sys_.wheel(), sys_.start_spin, f.body[kWheel]);
    if (ask_) add_acceleration(f.body[kWheel]);
    if (sys_.on_ring()) add_centrifugal(sys_.rail(), sys_.rail_spin, f.body[kRail]);
    f.axle = -g * (sys_.axle.mass_z + sys_.spec().vehicle.sprung_mass);
    return f;
  }
  // The traction of a steady start accelerates the wheel: what turns it stores some of the torque.
  void add_acceleration(Field& f) const {
    if (sys_.options.keeps_pace || sys_.on_ring()) return;
    const double travel = *sys_.spec().drive.traction() * sys_.model.load / sys_.travel_mass;
    const double turn = travel / sys_.rolling_radius;
    const Body& wheel = sys_.wheel();
    for (const NodeLine& l : wheel.lines) {
      if (l.component == 1) continue;
      const double z = line_radius(wheel, l.block, l.node);
      for (int j = 0; j < l.count; ++j) {
        const double t = wheel.mesh.blocks[l.block].stations.at[j];
        f[l.first + j] -=
            wheel.mass[l.first + j] * (l.component == 0 ? travel + turn * z * std::cos(t) : turn * z * std::sin(t));
      }
    }
  }
  static void add_centrifugal(const Body& body, double spin, Field& f) {
    const double spin2 = spin * spin;
    for (const NodeLine& l : body.lines) {
      if (l.component == 1) continue;
      const double z = line_radius(body, l.block, l.node);
      for (int j = 0; j < l.count; ++j) {
        const double t = body.mesh.blocks[l.block].stations.at[j];
        f[l.first + j] += spin2 * body.mass[l.first + j] * (l.component == 0 ? -z * std::sin(t) : z * std::cos(t));
      }
    }
  }
  // Where the ranks look at one another.
  bool any_rank_stops(bool own, double residual) const {
    if (share_.ranks().alone()) return own;
    const std::array<double, 2> marks = {residual, u_.axle};
    std::vector<double> numbers(marks.size() * share_.ranks().count);
    std::copy(marks.begin(), marks.end(), numbers.begin() + marks.size() * share_.ranks().rank);
    share_.gather(numbers.data(), std::vector<std::ptrdiff_t>(share_.ranks().count, marks.size()));
    require_same_bits(share_.ranks(), numbers);
    return largest_of_all(share_.ranks(), own) > 0;
  }

  void update_contact() {
    const AxlePose pose{0, 0, u_.axle, 0};
    contact_.search(u_.body[kRail], u_.body[kWheel], pose, search_length(),
                    (ask_ ? kFarGap : kNearGap) * sys_.model.hertz.approach);
    rows_ = &contact_.rows(u_.body[kRail], u_.body[kWheel], pose);
    pressure_.clear();
    active_.clear();
    for (const ContactRow& row : rows_->rows) {
      const double p = tractions_.at(row.column, row.station).p - element_stiffness_ * row.gap;
      active_.push_back(p > 0);
      pressure_.push_back(std::max(0.0, p));
    }
  }
  // The stiff springs of the linear step at the present gaps, in place of the pressures.
  void apply_gap_springs(StaticVector& r) {
    spring_.assign(rows_->rows.size(), 0.0);
    StaticVector f = zero_vector(sys_);
    for (std::size_t k = 0; k < rows_->rows.size(); ++k) {
      if (!active_[k]) continue;
      const ContactRow& row = rows_->rows[k];
      spring_[k] = tractions_.at(row.column, row.station).p - penalty_ * row.gap;
      apply_pressure(k, spring_[k] - pressure_[k], f);
    }
    reduce(f);
    share_.add(r, 1.0, f);
  }
  // Takes the step; the springs' pressures are the next multipliers, negative ones too: they open the contact there.
  void advance(StaticVector& step) {
    for (std::size_t k = 0; k < step.body.size(); ++k) sys_.bodies[k].ties.apply_homogeneous(step.body[k]);
    for (NodeTraction& t : tractions_.all()) t = {};
    for (std::size_t k = 0; k < rows_->rows.size(); ++k)
      if (active_[k])
        tractions_.at(rows_->rows[k].column, rows_->rows[k].station).p = spring_[k] - penalty_ * gap_change(k, step);
    share_.add(u_, 1.0, step);
    share_.complete(u_);
    sys_.apply_constraints(u_.body[kRail], u_.body[kWheel], {0, 0, u_.axle, 0});
  }
  double penetration() const {
    double worst = 0;
    for (std::size_t k = 0; k < rows_->rows.size(); ++k)
      if (active_[k]) worst = std::max(worst, std::abs(rows_->rows[k].gap));
    return worst;
  }

  // Adds a_A p_A on both surfaces: the rail down and the wheel up.
  void apply_pressure(std::size_t k, double p, StaticVector& f) const {
    const ContactRow& row = rows_->rows[k];
    const double on_rail[3] = {row.normal.x, row.normal.y, row.normal.z};
    const double on_wheel[3] = {row.on_wheel.x, row.on_wheel.y, row.on_wheel.z};
    for (int i = 0; i < 3; ++i) {
      f.body[kRail][row.rail + i * sys_.rail_surface().stride] -= row.area * p * on_rail[i];
      const double force = row.area * p * on_wheel[i];
      for (int w = row.first; w < row.first + row.count; ++w)
        f.body[kWheel][rows_->weights[w].wheel + i * sys_.wheel_surface().stride] += rows_->weights[w].m * force;
    }
  }

  // Lateral friction of the pressures, over them.
  double friction_ratio() const {
    if (sys_.options.lateral_friction == 0) return 0;
    double normal = 0;
    for (std::size_t k = 0; k < rows_->rows.size(); ++k) normal += rows_->rows[k].area * pressure_[k];
    const FrictionLaws& laws = sys_.options.contact.friction;
    const double bound = laws.coefficient * laws.lateral_share;
    return std::clamp(sys_.options.lateral_friction / std::max(normal, std::abs(sys_.options.lateral_friction)), -bound,
                      bound);
  }
  // ratio: friction_ratio().
  NodeTraction traction_of(std::size_t k, double ratio) const {
    const ContactRow& row = rows_->rows[k];
    if (passes_ == 0) return {.p = pressure_[k], .q2 = ratio * pressure_[k]};
    const NodeTraction& t = friction_.at(row.column, row.station);
    return {.p = pressure_[k], .q1 = t.q1, .q2 = t.q2};
  }
  // N, of the wheel.
  Vec3 friction_on_rail(std::size_t k, double ratio) const {
    const ContactRow& row = rows_->rows[k];
    const TangentFrame frame = tangent_frame(row.normal);
    if (passes_ == 0) return (row.area * ratio * pressure_[k]) * frame.t2;
    const NodeTraction& t = friction_.at(row.column, row.station);
    return (row.area * t.q1) * frame.t1 + (row.area * t.q2) * frame.t2;
  }
  bool settled() const { return !ask_ || passes_ == kMostPasses || (passes_ > 0 && change_ < kSettled); }
  // Residual with which the next pass begins; 0 after the last one.
  double enough_for_friction() const {
    if (settled()) return 0;
    return passes_ == 0 ? kMostEnough : std::clamp(kEnough * change_, kLeastEnough, kMostEnough);
  }
  // Towards the friction of steady rolling (fem/steady_start.hpp); false: it is that already, or the wheel starts from
  // rest.
  bool improve_friction() {
    if (settled()) return false;
    const double ratio = friction_ratio();
    for (std::size_t k = 0; k < rows_->rows.size(); ++k)
      friction_.at(rows_->rows[k].column, rows_->rows[k].station) = traction_of(k, ratio);
    const SteadyCells cells(sys_, *rows_, pressure_);
    const SteadyAnswer answer = ask_(cells.ask(friction_, u_.body, motion_));
    ++passes_;
    change_ = cells.take(answer, friction_);
    const double speed = sys_.spec().drive.speed;
    if (!sys_.options.keeps_pace) motion_.spin -= answer.creepage_change[0] * speed / sys_.rolling_radius;
    if (sys_.options.free_sideways)
      motion_.lateral_speed += answer.creepage_change[1] * speed * std::cos(sys_.model.reference.angle);
    return true;
  }
  // It is a load of the step, not a part of its stiffness: pressures hardly know it.
  void apply_friction(StaticVector& f) const {
    const double ratio = friction_ratio();
    if (passes_ == 0 && ratio == 0) return;
    for (std::size_t k = 0; k < rows_->rows.size(); ++k) {
      const ContactRow& row = rows_->rows[k];
      const Vec3 on_rail = friction_on_rail(k, ratio);
      const Vec3 on_wheel = -yaw_back(sys_.wheel_surface().yaw, on_rail);
      add_vector(f.body[kRail], row.rail, sys_.rail_surface().stride, on_rail);
      for (int w = row.first; w < row.first + row.count; ++w)
        add_vector(f.body[kWheel], rows_->weights[w].wheel, sys_.wheel_surface().stride,
                   rows_->weights[w].m * on_wheel);
    }
  }

  // Forces on constrained nodes go to what carries them.
  void reduce(StaticVector& f) const {
    for (std::size_t k = 0; k < f.body.size(); ++k) sys_.bodies[k].ties.apply_transpose(f.body[k]);
    for (const BoreNode& n : sys_.axle.bore) f.axle += f.body[kWheel][n.index + 2 * n.stride];
    clear_constrained(f);
  }
  void clear_constrained(StaticVector& x) const {
    share_.for_kept([&](std::size_t k, std::ptrdiff_t begin, std::ptrdiff_t end) {
      const double* inverse_mass = sys_.bodies[k].inverse_mass.data();
      double* f = x.body[k].data();
      for (std::ptrdiff_t i = begin; i < end; ++i)
        if (inverse_mass[i] == 0) f[i] = 0;
    });
  }

  // From the virgin state in one increment; twice, since the bubbles follow the increment before.
  void yield(std::size_t k) {
    const Body& body = sys_.bodies[k];
    if (body.plastic.empty()) return;
    share_.elements(k).begin(u_.body[k], 0);  // the ghosts of a ring
    for (int repeat = 0; repeat < 2; ++repeat) {
      restore_points(body, virgin_[k], history_[k]);
      advance_plastic_elements(body, u_.body[k], 0, history_[k]);
    }
  }
  // Makes elements hot that are near yielding at the present displacements; false if there are none.
  bool extend() {
    int added = 0;
    for (std::size_t k = 0; k < history_.size(); ++k)
      if (!sys_.bodies[k].plastic.empty()) added += extend_plastic_elements(sys_.bodies[k], u_.body[k], 0, history_[k]);
    return added > 0;
  }
  StaticVector residual() {
    StaticVector r = zero_vector(sys_);
    for (std::size_t k = 0; k < r.body.size(); ++k) yield(k);
    share_.internal_force(u_, history_, r);
    press_on_sleepers(sys_.pads, u_.body[kRail], r.body[kRail]);
    let_sleepers_sink(sys_.pads, u_.body[kRail], r.body[kRail]);
    share_.for_kept([&](std::size_t k, std::ptrdiff_t begin, std::ptrdiff_t end) {
      for (std::ptrdiff_t i = begin; i < end; ++i) r.body[k][i] = -r.body[k][i];
    });
    for (const EndLoad& l : sys_.end_loads) r.body[kRail][l.index] += l.force;
    for (std::size_t k = 0; k < rows_->rows.size(); ++k)
      if (pressure_[k] > 0) apply_pressure(k, pressure_[k], r);
    apply_friction(r);
    reduce(r);
    share_.add(r, 1.0, loads());
    return r;
  }

  // y = K x on the free degrees of freedom, sleepers standing still; constrained entries of x are not unknowns.
  void stiffness(StaticVector& x, StaticVector& y) {
    elastic(x, y);
    reduce(y);
    clear_constrained(x);
  }
  // y = (K + eps G^T a G) x, sleepers in equilibrium
  void apply(StaticVector& x, StaticVector& y) {
    elastic(x, y);
    let_sleepers_sink(sys_.pads, x.body[kRail], y.body[kRail]);
    for (std::size_t k = 0; k < rows_->rows.size(); ++k)
      if (active_[k]) apply_pressure(k, penalty_ * gap_change(k, x), y);
    reduce(y);
    clear_constrained(x);
  }
  void elastic(StaticVector& x, StaticVector& y) {
    Field& wheel = x.body[kWheel];
    for (const BoreNode& n : sys_.axle.bore) {
      wheel[n.index] = wheel[n.index + n.stride] = 0;
      wheel[n.index + 2 * n.stride] = x.axle;
    }
    for (std::size_t k = 0; k < x.body.size(); ++k) sys_.bodies[k].ties.apply_homogeneous(x.body[k]);
    share_.linear_force(x, y);
    press_on_sleepers(sys_.pads, x.body[kRail], y.body[kRail]);
    y.axle = 0;
  }
  double gap_change(std::size_t k, const StaticVector& x) const {
    const ContactRow& row = rows_->rows[k];
    const ContactSurface& wheel = sys_.wheel_surface();
    const Vec3 rail = yaw_back(wheel.yaw, -vector_at(x.body[kRail], row.rail, sys_.rail_surface().stride));
    const double away[3] = {rail.x, rail.y, rail.z};
    const double n[3] = {row.on_wheel.x, row.on_wheel.y, row.on_wheel.z};
    double g = 0;
    for (int i = 0; i < 3; ++i) {
      double w = away[i];
      for (int j = row.first; j < row.first + row.count; ++j)
        w += rows_->weights[j].m * x.body[kWheel][rows_->weights[j].wheel + i * wheel.stride];
      g += n[i] * w;
    }
    return g;
  }

  // Solves for r in place, down to |r| <= wanted; returns the number of iterations.
  int conjugate_gradients(StaticVector& r, double wanted) {
    preconditioner_.set_contact(*rows_, active_, penalty_);
    StaticVector x = zero_vector(sys_), z = zero_vector(sys_), p = zero_vector(sys_), q = zero_vector(sys_);
    double rz = 1;
    int iteration = 0;
    for (; iteration < kMostIterations && share_.dot(r, r) > wanted * wanted; ++iteration) {
      preconditioner_.apply(r, z);
      const double next = share_.dot(r, z);
      share_.scale_and_add(p, iteration > 0 ? next / rz : 0.0, z);
      rz = next;
      apply(p, q);
      const double alpha = rz / share_.dot(p, q);
      share_.add(x, alpha, p);
      share_.add(r, -alpha, q);
    }
    r = std::move(x);
    return iteration;
  }

  const RollingSystem& sys_;
  const SteadyFriction& ask_;
  StartMotion motion_;
  StaticShare share_;
  MortarContact contact_;
  SurfaceTractions tractions_, friction_;  // friction_: of steady rolling, after the first pass
  int passes_ = 0;
  double change_ = 0;  // of the friction in the last pass, over it
  const RailBefore* before_;
  const std::array<PlasticHistory, 2> virgin_;
  std::array<PlasticHistory, 2> history_;  // at the present displacements
  StaticPreconditioner preconditioner_;
  StaticVector u_;
  double element_stiffness_ = 0;  // Pa/m, weighs gaps against pressures where a node is to open or close
  double penalty_ = 0;            // Pa/m, of the springs in a linear step
  const MortarRows* rows_ = nullptr;
  std::vector<double> pressure_, spring_;
  std::vector<char> active_;
};

// At rest layers are bonded everywhere. Fields of both systems have the same places.
RollingSystem bonded(const RollingSystem& system) {
  Model model = system.model;
  model.rail = bonded(std::move(model.rail));
  return RollingSystem(model);
}

}  // namespace

PreloadResult solve_preload(const RollingSystem& system, double tolerance, const PreloadProgress& progress,
                            const RailBefore* before, const Ranks& ranks, const SteadyFriction& friction) {
  if (!system.rail().mesh.interfaces.empty())
    return solve_preload(bonded(system), tolerance, progress, before, ranks, friction);
  const auto start = std::chrono::steady_clock::now();
  PreloadResult result = Preload(system, before, ranks, friction).solve(tolerance, progress);
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace railstrata
