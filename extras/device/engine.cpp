#include "device/engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "core/faults.hpp"
#include "device/launch.hpp"

namespace railstrata::device {
namespace {

constexpr std::ptrdiff_t kFan = 64;  // numbers that one thread of a tree adds

std::ptrdiff_t lanes(const DeviceArray<Piece>& pieces) { return static_cast<std::ptrdiff_t>(pieces.size()) * kLanes; }

template <class T>
std::ptrdiff_t count(const DeviceArray<T>& values) {
  return static_cast<std::ptrdiff_t>(values.size());
}

std::vector<BoreRecord> bore_records(const Axle& axle) {
  std::vector<BoreRecord> out;
  for (const BoreNode& n : axle.bore) out.push_back({n.index, n.stride, n.arm.x, n.arm.z});
  return out;
}

std::vector<EndDashpotRecord> dashpot_records(const RollingSystem& sys) {
  std::vector<EndDashpotRecord> out;
  for (const EndDashpot& d : sys.absorbers) out.push_back({d.index, d.coefficient});
  return out;
}

std::vector<EndLoadRecord> end_load_records(const RollingSystem& sys) {
  std::vector<EndLoadRecord> out;
  for (const EndLoad& l : sys.end_loads) out.push_back({l.index, l.force});
  return out;
}

RollingLaw rolling_law(const RollingSystem& sys, const RollingBodies& bodies, double dt) {
  RollingLaw law;
  law.axle = axle_law(sys, 0);
  law.torque = sys.torque;
  law.run_up = *sys.spec().run.run_up;
  law.run_up_damping = sys.spec().run.run_up_damping;
  law.dt = dt;
  law.gravity = sys.gravity;
  law.free_mass = bodies[kWheel].free_mass;
  law.free_inertia = bodies[kWheel].free_inertia;
  law.rail = bodies[kRail].frame;
  law.wheel = bodies[kWheel].frame;
  law.search_interval = ContactStep::kSearchInterval;
  return law;
}

std::string describe(Fault fault) {
  switch (fault) {
    case Fault::none:
      return {};
    case Fault::patch_too_large:
      return "an element of the rail meets more elements of the wheel than there is room for";
    case Fault::off_the_band:
      return "the contact has left the elements below the axle";
    case Fault::rows_meet:
      return "the contact has left the wheel's fine elements";
    case Fault::window_too_large:
      return "the contact has left the rail's fine elements";
  }
  return {};
}

}  // namespace

std::string not_on_a_device(const RollingSystem& system) {
  if (system.on_ring()) return "rail that is a ring";
  for (const Body& b : system.bodies)
    if (!b.plastic.empty()) return "materials that yield";
  return {};
}

Engine::State::State(Device& device, const RollingBody& body)
    : tables(device, body),
      u(device, static_cast<std::size_t>(body.body.layout.size)),
      v(device, static_cast<std::size_t>(body.body.layout.size)),
      f(device, static_cast<std::size_t>(body.body.layout.size)),
      node_sums(device, static_cast<std::size_t>(kSumsOfNode * lanes(tables.node_pieces))),
      waiting_sums(device, static_cast<std::size_t>(kSumsOfNode * lanes(tables.waiting_pieces))),
      energies(device, static_cast<std::size_t>(2 * lanes(tables.quad_pieces))),
      stretch(device, 3 * tables.added_mass.added.size()),
      added_kinetic(device, static_cast<std::size_t>(lanes(tables.added_mass.pieces))) {}

SurfaceChains Engine::State::chains() const { return {tables.added_mass.chain_at.view(), tables.added_mass.tables()}; }
SurfaceFields Engine::State::surface() const { return {chains(), f.view(), v.view(), tables.inverse_mass.view()}; }

Engine::Engine(Device& device, const RollingSystem& system, const RollingBodies& bodies, double dt)
    : device_(device),
      law_(rolling_law(system, bodies, dt)),
      contact_(device, system, law_.dt),
      dashpots_(on_device<EndDashpotRecord>(device, dashpot_records(system))),
      end_loads_(on_device<EndLoadRecord>(device, end_load_records(system))),
      bore_(on_device<BoreRecord>(device, bore_records(system.axle))),
      dashpot_power_(device, dashpots_.size()),
      end_work_(device, end_loads_.size()),
      bore_loads_(device, 4 * bore_.size()),
      results_(device, kResults),
      now_(device, 1),
      groups_(device, kSuspensionGroups),
      log_(device, kMostSteps),
      records_(kMostSteps) {
  std::size_t longest = 4 * bore_.size() + dashpots_.size() + end_loads_.size(), moments = 0;
  for (const RollingBody& b : bodies) {
    State& s = state_.emplace_back(device, b);
    moments = std::max(moments, static_cast<std::size_t>(s.tables.ties.moments));
    longest = std::max(
        {longest, s.node_sums.size(), s.waiting_sums.size(), moments, s.energies.size(), s.added_kinetic.size()});
  }
  moments_ = {device, moments};
  const std::size_t pieces = longest / kFan + 8;  // of the first level
  tree_ = {{device, pieces}, {device, pieces}};
}

void Engine::load(const RestartState& state) {
  assert(state.state.step % law_.search_interval == 0);
  for (std::size_t k = 0; k < state_.size(); ++k) {
    state_[k].u.upload(state.state.bodies[k].u);
    state_[k].v.upload(state.state.bodies[k].v);
  }
  contact_.load(state);
  groups_.upload(state.state.groups);
  law_.axle.rest_z = state.start.axle_z;
  law_.side_force = state.start.side_force;
  law_.torque_ramp = state.start.torque_ramp;
  StepState s;
  s.time = state.state.time;
  s.step = step_ = state.state.step;
  s.axle = state.state.axle;
  s.balance = state.balance;
  s.mean = state.mean;
  s.reached_edge = state.reached_edge;
  position_ = s.axle.x;
  now_.upload(std::span<const StepState>(&s, 1));
  recorded_ = {};  // they know what was there before
  launch_group(device_, BeginStep{law_, contact_.tables(), now_.view(), log_.view()});
}

void Engine::store(RestartState& state) {
  for (std::size_t k = 0; k < state_.size(); ++k) {
    state_[k].u.download(state.state.bodies[k].u);
    state_[k].v.download(state.state.bodies[k].v);
  }
  contact_.store(state);
  groups_.download(state.state.groups);
  StepState s;
  now_.download(std::span<StepState>(&s, 1));
  state.state.time = s.time;
  state.state.step = s.step;
  state.state.axle = s.axle;
  state.balance = s.balance;
  state.mean = s.mean;
  state.reached_edge = s.reached_edge != 0;
}

std::span<const StepRecord> Engine::take(int steps, bool energies) {
  assert(steps >= 1 && (steps == 1 || !energies));
  const auto first = static_cast<std::size_t>(step_ % kMostSteps);
  assert(first + static_cast<std::size_t>(steps) <= static_cast<std::size_t>(kMostSteps));
  // a rate that fades away within these steps acts no more, whether sums are made or not
  const bool damped = law_.run_up > 0 && law_.run_up_damping * (1 - smooth_rise(position_ / law_.run_up)) > 0;
  for (int k = 0; k < steps; ++k, ++step_)
    start_step({step_ % law_.search_interval == 0, damped || energies, energies});
  const std::span<StepRecord> records = std::span<StepRecord>(records_).first(static_cast<std::size_t>(steps));
  log_.download(first, records);
  position_ = records.back().axle.x;
  if (const auto fault = static_cast<Fault>(records.back().fault); fault != Fault::none)
    throw NumericalError(
        fmt::format("run.device: {} (t = {:.4g} ms)\n    run.device = \"cpu\" goes on from the checkpoint",
                    describe(fault), 1e3 * records.back().time));
  return records;
}

void Engine::start_step(const StepKind& kind) {
  if (kind.energies) return step(kind);
  std::unique_ptr<Recording>& recorded = recorded_[2 * kind.searches + kind.measured];
  if (!recorded) recorded = device_.record([this, kind] { step(kind); });
  recorded->start();
}

// Each of `sums` rows of `count` numbers, to results_ from `result` on.
void Engine::sum(const DeviceArray<double>& numbers, std::ptrdiff_t sums, std::ptrdiff_t count, int result) {
  View<const double> in = numbers.view();
  for (bool even = true, done = count == 0; !done; even = !even) {
    const std::ptrdiff_t pieces = (count + kFan - 1) / kFan;
    View<double> out = pieces == 1 ? results_.view().part(result, sums)
                                   : (even ? tree_.even : tree_.odd).view().part(0, sums * pieces);
    launch(device_, sums * pieces, SumLevel{in, out, count, pieces});
    in = out;
    count = pieces;
    done = pieces == 1;
  }
}

template <SweepKind kind, class Real>
void Engine::element_forces(State& s) {
  BodyTables& t = s.tables;
  ElementArrays<Real>& e = t.of<Real>();
  const StationTables<Real> at{e.inv_sigma.view(), e.inv_c.view(), e.sigma_c.view(), e.sigma.view(),
                               e.c.view(),         t.cos_q.view(), t.sin_q.view()};
  launch(device_, lanes(t.quad_pieces),
         ElementForces<kind, Real>{t.quad_pieces.view(), t.quads.view(), e.references.view(), e.hourglass.view(),
                                   t.classes.view(), e.eigenstress.view(), at, s.u.view(), now(), e.rows.view()});
}

template <SweepKind kind, class Real, bool updates, bool measured>
void Engine::node_forces(State& s) {
  BodyTables& t = s.tables;
  launch(device_, lanes(t.node_pieces),
         NodeForces<kind, Real, updates, measured>{t.node_pieces.view(), t.nodes.view(), t.corners.view(),
                                                   t.cos_q.view(), t.sin_q.view(), now(), t.of<Real>().rows.view(),
                                                   s.f.view(), t.inverse_mass.view(), t.cos_node.view(),
                                                   t.sin_node.view(), s.u.view(), s.v.view(), s.node_sums.view()});
}

template <SweepKind kind, class Real>
void Engine::forces_of(State& s, bool measured) {
  element_forces<kind, Real>(s);
  if (measured)
    node_forces<kind, Real, true, true>(s);
  else
    node_forces<kind, Real, true, false>(s);
}

template <SweepKind kind>
void Engine::forces_of(State& s, bool measured) {
  if (s.tables.single)
    forces_of<kind, float>(s, measured);
  else
    forces_of<kind, double>(s, measured);
}

void Engine::internal_force(std::size_t k, const Field& u, double psi, Field& f) {
  State& s = state_[k];
  s.u.upload(u);
  StepState turned;
  turned.turn = turn_of(psi);
  now_.upload(std::span<const StepState>(&turned, 1));
  const auto evaluate = [&]<SweepKind kind, class Real>() {
    element_forces<kind, Real>(s);
    node_forces<kind, Real, false, false>(s);
  };
  const bool turns = s.tables.kind == SweepKind::revolve;
  if (s.tables.single)
    turns ? evaluate.operator()<SweepKind::revolve, float>() : evaluate.operator()<SweepKind::extrude, float>();
  else
    turns ? evaluate.operator()<SweepKind::revolve, double>() : evaluate.operator()<SweepKind::extrude, double>();
  s.f.download(f);
}

void Engine::step(const StepKind& kind) {
  State &rail = state_[kRail], &wheel = state_[kWheel];
  if (kind.energies) store_energies();
  forces_of<SweepKind::extrude>(rail, kind.measured);
  forces_of<SweepKind::revolve>(wheel, kind.measured);
  reduce_ties<SweepKind::extrude>(rail);
  reduce_ties<SweepKind::revolve>(wheel);
  hold_ends();
  bore_forces();
  scale(rail);
  scale(wheel);
  contact(kind.searches);
  update_waiting<SweepKind::extrude>(rail, kind.measured);
  update_waiting<SweepKind::revolve>(wheel, kind.measured);
  if (kind.measured) add_up_updates(kind.energies);
  launch_group(device_, FinishStep{law_, now_.view(), groups_.view(), results_.view(), kind.measured, kind.energies});
  launch_group(device_, BeginStep{law_, contact_.tables(), now_.view(), log_.view()});
  launch(device_, count(bore_), MoveBore{bore_.view(), now(), wheel.u.view()});
  apply_ties<SweepKind::revolve>(wheel);
  apply_ties<SweepKind::extrude>(rail);
}

// At the displacements and velocities before the step.
void Engine::store_energies() {
  energies_of<SweepKind::extrude>(state_[kRail], kRail);
  energies_of<SweepKind::revolve>(state_[kWheel], kWheel);
  launch(device_, count(end_loads_), EndWork{end_loads_.view(), state_[kRail].u.view(), end_work_.view()});
  sum(end_work_, 1, count(end_loads_), kEndWork);
}

template <SweepKind kind>
void Engine::energies_of(State& s, int body) {
  BodyTables& t = s.tables;
  ElementArrays<double>& e = t.in_double;
  const StationTables<double> at{e.inv_sigma.view(), e.inv_c.view(), e.sigma_c.view(), e.sigma.view(),
                                 e.c.view(),         t.cos_q.view(), t.sin_q.view()};
  launch(device_, lanes(t.quad_pieces),
         ElementEnergies<kind>{t.quad_pieces.view(), t.quads.view(), e.references.view(), e.hourglass.view(),
                               t.classes.view(), e.eigenstress.view(), at, s.u.view(), now(), s.energies.view()});
  sum(s.energies, 2, lanes(t.quad_pieces), result_of(body, kStrain));
  launch(device_, lanes(t.node_pieces),
         NodeHeights<kind>{t.node_pieces.view(), t.nodes.view(), t.mass.view(), t.cos_node.view(), t.sin_node.view(),
                           s.u.view(), now(), s.node_sums.view()});
  sum(s.node_sums, 1, lanes(t.node_pieces), result_of(body, kHeight));
  chain_energy<kind, true>(s, body);
}

template <SweepKind kind, bool before>
void Engine::chain_energy(State& s, int body) {
  BodyTables& t = s.tables;
  const ChainArrays& c = t.added_mass;
  launch(device_, lanes(c.pieces),
         ChainEnergy<kind, before>{c.tables(), c.pieces.view(), c.added.view(), t.cos_node.view(), t.sin_node.view(),
                                   s.v.view(), now(), s.stretch.view(), s.added_kinetic.view()});
  if (!before) sum(s.added_kinetic, 1, lanes(c.pieces), result_of(body, kAddedKinetic));
}

// Forces on slaves go to their masters; what the offsets hand to the rotation is summed.
template <SweepKind kind>
void Engine::reduce_ties(State& s) {
  TieArrays& ties = s.tables.ties;
  for (std::size_t k = ties.levels.size(); k-- > 0;) {
    const TieLevel& level = ties.levels[k];
    launch(device_, 3 * lanes(level.masters),
           GatherTies{ties.tables(), level.records.view(), level.shares.view(), level.masters.view(), s.f.view()});
    launch(device_, lanes(level.slaves),
           ClearTies<kind>{ties.tables(), level.slaves.view(), now(), s.f.view(),
                           moments_.view().part(level.first_moment, lanes(level.slaves))});
  }
  if (kind == SweepKind::revolve) sum(moments_, 1, ties.moments, kTieMoment);
}

void Engine::hold_ends() {
  State& rail = state_[kRail];
  launch(device_, count(dashpots_),
         AbsorbAtEnds{dashpots_.view(), rail.v.view(), rail.f.view(), dashpot_power_.view()});
  sum(dashpot_power_, 1, count(dashpots_), kAbsorbed);
  launch(device_, count(end_loads_), HoldEnds{end_loads_.view(), rail.f.view()});
}

void Engine::bore_forces() {
  launch(device_, count(bore_), BoreForces{bore_.view(), state_[kWheel].f.view(), now(), bore_loads_.view()});
  sum(bore_loads_, 4, count(bore_), kBore);
}

void Engine::scale(State& s) {
  const ChainArrays& c = s.tables.added_mass;
  launch(device_, 3 * lanes(c.pieces), ScaleForces{c.tables(), c.pieces.view(), s.f.view()});
}

void Engine::contact(bool searches) {
  State &rail = state_[kRail], &wheel = state_[kWheel];
  const ContactTables& t = contact_.tables();
  const SearchScope scope{t, now(), rail.u.view(), wheel.u.view()};
  if (searches) {
    launch(device_, contact_.slots(), TestNodes{scope});
    launch(device_, contact_.facets(), ChooseFacets{scope});
  }
  launch(device_, contact_.hits(), UpdateHits{scope});
  launch(device_, contact_.band_nodes(), FreeBand{t, now(), wheel.surface(), law_.gravity});
  launch(device_, contact_.slots(), MakeRows{t, now(), rail.surface(), law_.gravity});
  const RowScope rows{t, now_.view()};
  launch(device_, contact_.slots(), TestRows{rows});
  launch_group(device_, PushRows{rows});
  launch_group(device_, SweepRows{rows});
  launch(device_, contact_.slots(), RecordRows{rows});
  launch_group(device_, AddUpRows{rows});
  launch(device_, contact_.slots(), LoadRail{t, now(), rail.chains(), rail.f.view()});
  launch(device_, contact_.band_nodes(), LoadWheel{t, now(), wheel.chains(), wheel.f.view()});
}

template <SweepKind kind>
void Engine::update_waiting(State& s, bool measured) {
  BodyTables& t = s.tables;
  const auto start = [&]<bool with_sums>() {
    launch(device_, lanes(t.waiting_pieces),
           WaitingNodes<kind, with_sums>{t.waiting_pieces.view(), t.nodes.view(), s.f.view(), t.inverse_mass.view(),
                                         t.cos_node.view(), t.sin_node.view(), now(), s.u.view(), s.v.view(),
                                         s.waiting_sums.view()});
  };
  measured ? start.template operator()<true>() : start.template operator()<false>();
}

void Engine::add_up_updates(bool energies) {
  for (int k = 0; k < static_cast<int>(state_.size()); ++k) {
    State& s = state_[static_cast<std::size_t>(k)];
    sum(s.node_sums, kSumsOfNode, lanes(s.tables.node_pieces), result_of(k, kSums));
    sum(s.waiting_sums, kSumsOfNode, lanes(s.tables.waiting_pieces), result_of(k, kSums + kSumsOfNode));
  }
  if (!energies) return;
  chain_energy<SweepKind::extrude, false>(state_[kRail], kRail);
  chain_energy<SweepKind::revolve, false>(state_[kWheel], kWheel);
}

template <SweepKind kind>
void Engine::apply_ties(State& s) {
  for (const TieLevel& level : s.tables.ties.levels)
    launch(device_, 3 * lanes(level.slaves),
           ApplyTies<kind>{s.tables.ties.tables(), level.slaves.view(), now(), s.u.view()});
}

}  // namespace railstrata::device
