#include "device/engine.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/faults.hpp"
#include "device/launch.hpp"

namespace railstrata::device {
namespace {

constexpr double kPeriod = 2 * std::numbers::pi;
constexpr std::ptrdiff_t kFan = 64;  // numbers that one thread of a tree adds

template <class T, class Container>
DeviceArray<T> on(Device& device, const Container& values) {
  return {device, std::span<const T>(values.data(), values.size())};
}

std::ptrdiff_t lanes(const DeviceArray<Piece>& pieces) { return static_cast<std::ptrdiff_t>(pieces.size()) * kLanes; }

// Beyond what the contact's search looks at.
double band_half_length(const RollingSystem& sys) {
  return 1.5 * sys.model.hertz.a + 7 * sys.options.element_size + std::abs(sys.model.placement.contact.x);
}

std::size_t surface_numbers(const RollingBody& b) {
  return static_cast<std::size_t>(9) * b.surface.columns * b.surface.stations.nodes();
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

template <SweepKind kind>
NodeStep step_of(const RollingBody& b, const StepScope& scope) {
  return node_step<kind>(b.frame, b.mean, scope.dt, scope.damping_rate, scope.gravity);
}

}  // namespace

std::string not_on_a_device(const RollingSystem& system, bool local_steps) {
  if (local_steps) return "local time steps";
  for (const Body& b : system.bodies)
    if (!b.plastic.empty()) return "materials that yield";
  if (BodyElement::kHistory > 0) return "elements with a history";
  return {};
}

Engine::State::State(Device& device, const RollingBody& body)
    : tables(device, body),
      u(device, static_cast<std::size_t>(body.body.layout.size)),
      v(device, static_cast<std::size_t>(body.body.layout.size)),
      f(device, static_cast<std::size_t>(body.body.layout.size)),
      node_sums(device, static_cast<std::size_t>(kSumsOfNode * lanes(tables.node_pieces))),
      waiting_sums(device, static_cast<std::size_t>(kSumsOfNode * lanes(tables.waiting_pieces))),
      surface_forces(device, static_cast<std::size_t>(body.surface.columns) * body.surface.stations.nodes()),
      energies(device, static_cast<std::size_t>(2 * lanes(tables.quad_pieces))),
      stretch(device, 3 * tables.added_mass.added.size()),
      added_kinetic(device, static_cast<std::size_t>(lanes(tables.added_mass.pieces))) {}

Engine::Engine(Device& device, const RollingSystem& system, const RollingBodies& bodies)
    : device_(device),
      half_length_(band_half_length(system)),
      radius_(system.rolling_radius),
      origin_{system.rail_surface().origin, system.wheel_surface().origin},
      dashpots_(on<EndDashpotRecord>(device, dashpot_records(system))),
      end_loads_(on<EndLoadRecord>(device, end_load_records(system))),
      bore_(on<BoreRecord>(device, bore_records(system.axle))),
      dashpot_power_(device, dashpots_.size()),
      bore_loads_(device, 4 * bore_.size()),
      energies_known_(system.rail().initial_stress.empty() && system.wheel().initial_stress.empty()) {
  std::size_t longest = 4 * bore_.size() + dashpots_.size(), moments = 0, band = kResults;
  for (const RollingBody& b : bodies) {
    State& s = state_.emplace_back(device, b);
    moments = std::max(moments, static_cast<std::size_t>(s.tables.ties.moments));
    longest = std::max(
        {longest, s.node_sums.size(), s.waiting_sums.size(), moments, s.energies.size(), s.added_kinetic.size()});
    band += surface_numbers(b);
  }
  moments_ = {device, moments};
  const std::size_t pieces = longest / kFan + 8;  // of the first level
  tree_ = {{device, pieces}, {device, pieces}};
  results_ = {device, band};
  landed_ = {device, band};
}

void Engine::load(const BodyStates& states) {
  for (std::size_t k = 0; k < state_.size(); ++k) {
    state_[k].u.upload(states[k].u);
    state_[k].v.upload(states[k].v);
  }
}

void Engine::store(BodyStates& states) {
  for (std::size_t k = 0; k < state_.size(); ++k) {
    state_[k].u.download(states[k].u);
    state_[k].v.download(states[k].v);
  }
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
void Engine::element_forces(State& s, const Rotation<double>& turn) {
  BodyTables& t = s.tables;
  ElementArrays<Real>& e = t.of<Real>();
  const StationTables<Real> at{e.inv_sigma.view(), e.inv_c.view(), e.v1.view(),    e.v2.view(),   e.v3.view(),
                               e.sigma.view(),     e.c.view(),     t.cos_q.view(), t.sin_q.view()};
  launch(device_, lanes(t.quad_pieces),
         ElementForces<kind, Real>{t.quad_pieces.view(), t.quads.view(), e.references.view(), e.hourglass.view(),
                                   t.classes.view(), e.eigenstress.view(), at, s.u.view(), turn, e.rows.view()});
}

template <SweepKind kind, class Real, bool updates, bool measured>
void Engine::node_forces(State& s, const Rotation<double>& turn, const NodeStep& step) {
  BodyTables& t = s.tables;
  launch(device_, lanes(t.node_pieces),
         NodeForces<kind, Real, updates, measured>{t.node_pieces.view(), t.nodes.view(), t.corners.view(),
                                                   t.cos_q.view(), t.sin_q.view(), turn, t.of<Real>().rows.view(),
                                                   s.f.view(), step, t.inverse_mass.view(), t.cos_node.view(),
                                                   t.sin_node.view(), s.u.view(), s.v.view(), s.node_sums.view()});
}

template <SweepKind kind, class Real>
void Engine::forces_of(State& s, const RollingBody& body, const Rotation<double>& turn, const StepScope& scope) {
  element_forces<kind, Real>(s, turn);
  if (scope.sums_wanted())
    node_forces<kind, Real, true, true>(s, turn, step_of<kind>(body, scope));
  else
    node_forces<kind, Real, true, false>(s, turn, step_of<kind>(body, scope));
}

template <SweepKind kind>
void Engine::forces_of(State& s, const RollingBody& body, const Rotation<double>& turn, const StepScope& scope) {
  if (s.tables.single)
    forces_of<kind, float>(s, body, turn, scope);
  else
    forces_of<kind, double>(s, body, turn, scope);
}

void Engine::internal_force(std::size_t k, const Field& u, double psi, Field& f) {
  State& s = state_[k];
  s.u.upload(u);
  const auto evaluate = [&]<SweepKind kind, class Real>() {
    const Rotation<double> turn = kind == SweepKind::revolve ? rotation_by(psi) : Rotation<double>{};
    element_forces<kind, Real>(s, turn);
    node_forces<kind, Real, false, false>(s, turn, {});
  };
  const bool turns = s.tables.kind == SweepKind::revolve;
  if (s.tables.single)
    turns ? evaluate.operator()<SweepKind::revolve, float>() : evaluate.operator()<SweepKind::extrude, float>();
  else
    turns ? evaluate.operator()<SweepKind::revolve, double>() : evaluate.operator()<SweepKind::extrude, double>();
  s.f.download(f);
}

// Forces on slaves go to their masters; what the offsets hand to the rotation is summed.
void Engine::reduce_ties(State& s, const Rotation<double>& turn) {
  TieArrays& ties = s.tables.ties;
  const bool turns = s.tables.kind == SweepKind::revolve;
  for (std::size_t k = ties.levels.size(); k-- > 0;) {
    const TieLevel& level = ties.levels[k];
    launch(device_, 3 * lanes(level.masters),
           GatherTies{ties.tables(), level.records.view(), level.shares.view(), level.masters.view(), s.f.view()});
    launch(device_, lanes(level.slaves),
           ClearTies{ties.tables(), level.slaves.view(), turn, turns, s.f.view(),
                     moments_.view().part(level.first_moment, lanes(level.slaves))});
  }
  if (turns) sum(moments_, 1, ties.moments, kMoment);
}

void Engine::scale(State& s) {
  const ChainArrays& c = s.tables.added_mass;
  launch(device_, 3 * lanes(c.pieces), ScaleForces{c.tables(), c.pieces.view(), s.f.view()});
}

// Stations within `reach` of a sweep coordinate, and a few more.
Engine::Band Engine::band(const RollingBody& b, double centre, double reach) const {
  constexpr int kMore = 3;
  const std::vector<double>& at = b.surface.stations.at;
  const int stations = static_cast<int>(at.size());
  const auto below = [&](double t) {  // counted on over the turns of a ring
    if (!b.surface.stations.closed) return static_cast<int>(std::lower_bound(at.begin(), at.end(), t) - at.begin());
    const double turns = std::floor((t - at.front()) / kPeriod);
    return static_cast<int>(std::lower_bound(at.begin(), at.end(), t - turns * kPeriod) - at.begin()) +
           static_cast<int>(turns) * stations;
  };
  int first = below(centre - reach) - kMore, end = below(centre + reach) + kMore;
  if (!b.surface.stations.closed) {
    first = std::clamp(first, 0, stations);
    end = std::clamp(end, first, stations);
  }
  const int count = std::min(end - first, stations);
  return {(first % stations + stations) % stations, count};
}

std::ptrdiff_t Engine::pack(State& s, const RollingBody& b, const Band& range, std::ptrdiff_t at) {
  const int lines = 3 * b.surface.columns;
  const std::ptrdiff_t each = static_cast<std::ptrdiff_t>(lines) * range.count;
  launch(device_, each,
         PackBand{s.u.view(), s.v.view(), s.f.view(), b.surface.first_line, b.surface.stride, lines, range.first,
                  range.count, b.surface.stations.nodes(), results_.view().part(at, 3 * each)});
  return at + 3 * each;
}

const double* Engine::unpack(const RollingBody& b, const Band& range, const double* numbers, BodyState& state) const {
  const int lines = 3 * b.surface.columns, stations = b.surface.stations.nodes();
  for (Field* field : {&state.u, &state.v, &state.f})
    for (int line = 0; line < lines; ++line) {
      double* const to = field->data() + b.surface.first_line + static_cast<std::ptrdiff_t>(line) * b.surface.stride;
      for (int k = 0; k < range.count; ++k) to[(range.first + k) % stations] = *numbers++;
    }
  return numbers;
}

StepEngine::Loads Engine::forces(const RollingBodies& bodies, const std::array<double, 2>& drift,
                                 const StepScope& scope, const AxlePose& pose, BodyStates& states) {
  State &rail = state_[kRail], &wheel = state_[kWheel];
  const Rotation<double> turn = rotation_by(drift[kWheel]);
  forces_of<SweepKind::extrude>(rail, bodies[kRail], {}, scope);
  forces_of<SweepKind::revolve>(wheel, bodies[kWheel], turn, scope);
  reduce_ties(rail, {});
  reduce_ties(wheel, turn);
  launch(device_, static_cast<std::ptrdiff_t>(dashpots_.size()),
         AbsorbAtEnds{dashpots_.view(), rail.v.view(), rail.f.view(), dashpot_power_.view()});
  launch(device_, static_cast<std::ptrdiff_t>(end_loads_.size()), HoldEnds{end_loads_.view(), rail.f.view()});
  const auto bore_nodes = static_cast<std::ptrdiff_t>(bore_.size());
  launch(device_, bore_nodes, BoreForces{bore_.view(), wheel.f.view(), turn, bore_loads_.view()});
  sum(bore_loads_, 4, bore_nodes, kBore);
  sum(dashpot_power_, 1, static_cast<std::ptrdiff_t>(dashpots_.size()), kAbsorbed);
  scale(rail);
  scale(wheel);

  const Band on_rail = band(bodies[kRail], origin_[kWheel].x + pose.x - origin_[kRail].x, half_length_);
  const Band on_wheel = band(bodies[kWheel], pose.psi, half_length_ / radius_);
  const std::ptrdiff_t next = pack(rail, bodies[kRail], on_rail, kResults);
  const std::ptrdiff_t end = pack(wheel, bodies[kWheel], on_wheel, next);
  const std::span<double> landed = landed_.first(static_cast<std::size_t>(end));
  results_.download(landed);
  const double* numbers = unpack(bodies[kRail], on_rail, landed.data() + kResults, states[kRail]);
  unpack(bodies[kWheel], on_wheel, numbers, states[kWheel]);
  const Vec3 bore = bodies[kWheel].frame.to_model({landed[kBore], landed[kBore + 1], landed[kBore + 2]});
  return {{bore.x, bore.y, bore.z, landed[kBore + 3] - landed[kMoment]}, landed[kAbsorbed]};
}

template <SweepKind kind>
void Engine::energies_of(State& s, const RollingBody& body, const Rotation<double>& turn) {
  BodyTables& t = s.tables;
  ElementArrays<double>& e = t.in_double;
  const StationTables<double> at{e.inv_sigma.view(), e.inv_c.view(), e.v1.view(),    e.v2.view(),   e.v3.view(),
                                 e.sigma.view(),     e.c.view(),     t.cos_q.view(), t.sin_q.view()};
  launch(device_, lanes(t.quad_pieces),
         ElementEnergies<kind>{t.quad_pieces.view(), t.quads.view(), e.references.view(), e.hourglass.view(),
                               t.classes.view(), at, s.u.view(), turn, s.energies.view()});
  sum(s.energies, 2, lanes(t.quad_pieces), kEnergies);
  launch(device_, lanes(t.node_pieces),
         NodeHeights<kind>{t.node_pieces.view(), t.nodes.view(), t.mass.view(), t.cos_node.view(), t.sin_node.view(),
                           s.u.view(), body.frame.turn, s.node_sums.view()});
  sum(s.node_sums, 1, lanes(t.node_pieces), kHeight);
  chain_energy<kind, true>(s, body);
}

template <SweepKind kind, bool before>
void Engine::chain_energy(State& s, const RollingBody& body) {
  BodyTables& t = s.tables;
  const ChainArrays& c = t.added_mass;
  launch(device_, lanes(c.pieces),
         ChainEnergy<kind, before>{c.tables(), c.pieces.view(), c.added.view(), t.cos_node.view(), t.sin_node.view(),
                                   s.v.view(), body.frame, s.stretch.view(), s.added_kinetic.view()});
  if (!before) sum(s.added_kinetic, 1, lanes(c.pieces), kAddedKinetic);
}

std::span<const double> Engine::land_results() {
  const std::span<double> landed = landed_.first(kResults);
  results_.download(landed);
  return landed;
}

std::optional<StepEngine::Stored> Engine::stored_energy(const RollingBodies& bodies,
                                                        const std::array<double, 2>& drift) {
  if (!energies_known_) return std::nullopt;
  Stored out;
  for (std::size_t k = 0; k < state_.size(); ++k) {
    if (k == kRail)
      energies_of<SweepKind::extrude>(state_[k], bodies[k], {});
    else
      energies_of<SweepKind::revolve>(state_[k], bodies[k], rotation_by(drift[k]));
    const std::span<const double> landed = land_results();
    out.strain += landed[kEnergies];
    out.hourglass += landed[kEnergies + 1];
    out.weight_moment += landed[kHeight];
  }
  stretch_known_ = true;
  return out;
}

void Engine::add_forces(const std::array<std::vector<SurfaceForce>, 2>& forces) {
  for (std::size_t k = 0; k < state_.size(); ++k) {
    State& s = state_[k];
    const ChainArrays& c = s.tables.added_mass;
    records_.clear();
    for (const SurfaceForce& f : forces[k])
      records_.push_back({f.x,
                          c.chain_at[static_cast<std::size_t>(f.node.column)],
                          f.node.station,
                          {f.force.x, f.force.y, f.force.z}});
    s.surface_forces.upload(records_);
    launch(device_, static_cast<std::ptrdiff_t>(records_.size()),
           AddSurfaceForces{s.surface_forces.view(), c.tables(), s.tables.surface_stride, s.f.view()});
  }
}

template <SweepKind kind>
void Engine::update_waiting(State& s, const RollingBody& body, const StepScope& scope) {
  BodyTables& t = s.tables;
  const NodeStep step = step_of<kind>(body, scope);
  const auto start = [&]<bool measured>() {
    launch(device_, lanes(t.waiting_pieces),
           WaitingNodes<kind, measured>{t.waiting_pieces.view(), t.nodes.view(), s.f.view(), t.inverse_mass.view(),
                                        t.cos_node.view(), t.sin_node.view(), step, s.u.view(), s.v.view(),
                                        s.waiting_sums.view()});
  };
  scope.sums_wanted() ? start.template operator()<true>() : start.template operator()<false>();
}

std::array<UpdateSums, 2> Engine::update(const RollingBodies& bodies, const StepScope& scope) {
  update_waiting<SweepKind::extrude>(state_[kRail], bodies[kRail], scope);
  update_waiting<SweepKind::revolve>(state_[kWheel], bodies[kWheel], scope);
  std::array<UpdateSums, 2> out;
  if (!scope.sums_wanted()) return out;
  for (std::size_t k = 0; k < state_.size(); ++k) {
    State& s = state_[k];
    sum(s.node_sums, kSumsOfNode, lanes(s.tables.node_pieces), kSums);
    sum(s.waiting_sums, kSumsOfNode, lanes(s.tables.waiting_pieces), kSums + kSumsOfNode);
    const bool chains = stretch_known_ && s.tables.added_mass.chains.size() > 0;
    if (chains && k == kRail) chain_energy<SweepKind::extrude, false>(s, bodies[k]);
    if (chains && k == kWheel) chain_energy<SweepKind::revolve, false>(s, bodies[k]);
    const std::span<const double> landed = land_results();
    for (int part = 0; part < 2; ++part) {
      const double* sums = landed.data() + kSums + part * kSumsOfNode;
      out[k] += {0.5 * sums[0], sums[1], sums[2], sums[3], sums[4]};
    }
    if (chains) out[k].kinetic += landed[kAddedKinetic];
  }
  stretch_known_ = false;
  return out;
}

void Engine::constrain(const AxlePose& pose) {
  const Rotation<double> turn = rotation_by(pose.psi);
  State &rail = state_[kRail], &wheel = state_[kWheel];
  launch(device_, static_cast<std::ptrdiff_t>(bore_.size()),
         MoveBore{bore_.view(), pose.x, pose.y, pose.z, turn, wheel.u.view()});
  for (const TieLevel& level : wheel.tables.ties.levels)
    launch(device_, 3 * lanes(level.slaves),
           ApplyTies{wheel.tables.ties.tables(), level.slaves.view(), turn, wheel.u.view()});
  for (const TieLevel& level : rail.tables.ties.levels)
    launch(device_, 3 * lanes(level.slaves),
           ApplyTies{rail.tables.ties.tables(), level.slaves.view(), {}, rail.u.view()});
}

}  // namespace railstrata::device
