#include "fem/rank_exchange.hpp"

#include <algorithm>
#include <numeric>

#include "core/body_id.hpp"

namespace railstrata {
namespace {

constexpr std::ptrdiff_t kSums = sizeof(UpdateSums) / sizeof(double);
static_assert(kSums * sizeof(double) == sizeof(UpdateSums));

// Section nodes of a body whose forces the step reads at all stations: those that wait for the contact, those that are
// carried, and what stands on the axle.
std::vector<std::vector<int>> read_lines(const RollingBody& b) {
  std::vector<std::vector<char>> wanted;
  for (const BlockLayout& l : b.body.layout.blocks) wanted.emplace_back(l.nodes, 0);
  for (const SectionNode& n : b.schedule.waiting) wanted[n.block][n.node] = 1;
  for (const Tie& t : b.body.mesh.ties) wanted[t.slave_block][t.slave_node] = 1;
  if (b.turns())
    for (const SectionNode& n : b.body.mesh.prescribed) wanted[n.block][n.node] = 1;
  std::vector<std::vector<int>> out(wanted.size());
  for (std::size_t k = 0; k < wanted.size(); ++k)
    for (int n = 0; n < static_cast<int>(wanted[k].size()); ++n)
      if (wanted[k][n]) out[k].push_back(n);
  return out;
}

std::vector<std::vector<int>> updated_at_once(const RollingBody& b) {
  std::vector<std::vector<int>> out(b.body.layout.blocks.size());
  for (const SectionNode& n : b.schedule.bordered) out[n.block].push_back(n.node);
  return out;
}

}  // namespace

RankExchange::RankExchange(const Ranks& ranks, const RollingBodies& bodies)
    : ranks_(ranks),
      exchange_(ranks),
      stretches_(all_stretches({&bodies[kRail].body, &bodies[kWheel].body}, {bodies[kRail].cut, bodies[kWheel].cut})),
      marks_(2 * static_cast<std::size_t>(ranks.count)) {
  for (const Stretch& s : stretches_) borders_[s.body].push_back(s);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    lines_[k] = read_lines(bodies[k]);
    inner_nodes_[k] = updated_at_once(bodies[k]);
  }
  count_forces(bodies);
}

RankExchange::Kind RankExchange::kind_of(const StepScope& scope) {
  return scope.energy_wanted ? whole : scope.sums_wanted() ? measured : plain;
}

// visit(first number, how many) for all that a rank gives in a step.
template <class Visit>
void RankExchange::each_force(int rank, Kind kind, RollingBodies& bodies, BodyStates& states, Visit&& visit) {
  visit(marks_.data() + 2 * rank, 2);
  for (const Stretch& s : stretches_) {
    if (s.owner != rank) continue;
    RollingBody& b = bodies[s.body];
    const int block = s.block, tiles = s.end_tile - s.first_tile;
    const BlockLayout& lay = b.body.layout.blocks[block];
    const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(lay.nodes) * 3;
    if (kind == plain) {
      visit(b.elements.front_forces(s.first_tile), plane);
      visit(b.elements.rear_forces(s.end_tile - 1), plane);
    } else {
      visit(b.elements.front_forces(s.first_tile), tiles * plane);
      visit(b.elements.rear_forces(s.first_tile), tiles * plane);
    }
    if (kind == measured) visit(&b.schedule.chain_sums[s.first_tile].kinetic, tiles * kSums);  // chains: single tiles
    double* f = states[s.body].f.data();
    const auto visit_node = [&](int node) {
      for (int i = 0; i < 3; ++i) visit(f + lay.line(node, i) + s.first, s.end - s.first);
    };
    if (kind == whole)
      for (int n = 0; n < lay.nodes; ++n) visit_node(n);
    else
      for (int n : lines_[s.body][block]) visit_node(n);
  }
}

// The nodes that a rank alone updates.
template <class Visit>
void RankExchange::each_value(int rank, const RollingBodies& bodies, BodyStates& states, Field BodyState::*field,
                              Visit&& visit) const {
  for (const Stretch& s : stretches_) {
    if (s.owner != rank) continue;
    const Body& body = bodies[s.body].body;
    const int block = s.block;
    double* values = (states[s.body].*field).data();
    for (int n : inner_nodes_[s.body][block])
      for (int i = 0; i < 3; ++i) visit(values + body.layout.blocks[block].line(n, i) + s.first, s.end - s.first);
  }
}

// The history of a rank's elements that may yield.
template <class Visit>
void RankExchange::each_slot(int rank, const RollingBodies& bodies, BodyStates& states, Visit&& visit) const {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const PlasticElements& plastic = bodies[k].body.plastic;
    if (plastic.empty()) continue;
    Field& history = states[k].history;
    for (int slot = 0; slot < plastic.hot_places(history); ++slot)
      if (bodies[k].cut.owner[plastic.hot(history, slot).tile] == rank)
        visit(history.data() + plastic.slot_first(slot), plastic.slot_numbers());
  }
}

void RankExchange::count_forces(const RollingBodies& bodies) {
  for (int kind = 0; kind < kKinds; ++kind) {
    counts_[kind].assign(static_cast<std::size_t>(ranks_.count), 2);
    for (const Stretch& s : stretches_) {
      const Body& body = bodies[s.body].body;
      const int block = s.block, tiles = s.end_tile - s.first_tile;
      const std::ptrdiff_t nodes = body.layout.blocks[block].nodes;
      const auto lines = kind == whole ? nodes : static_cast<std::ptrdiff_t>(lines_[s.body][block].size());
      const std::ptrdiff_t planes = kind == plain ? 2 : 2 * tiles, sums = kind == measured ? tiles * kSums : 0;
      counts_[kind][s.owner] += 3 * (planes * nodes + lines * (s.end - s.first)) + sums;
    }
  }
}

std::array<double, 2> RankExchange::step_bytes() const {
  const auto received = [](const std::vector<std::ptrdiff_t>& counts) {
    const std::ptrdiff_t all = std::accumulate(counts.begin(), counts.end(), std::ptrdiff_t{0});
    return 8.0 * static_cast<double>(all - *std::min_element(counts.begin(), counts.end()));
  };
  return {received(counts_[plain]), received(counts_[measured])};
}

void RankExchange::prepare(const RollingBodies& bodies, BodyStates& states, const StepScope& scope) {
  const Kind kind = kind_of(scope);
  if ((kind == measured && !planes_known_) || (kind == whole && !all_known_)) complete(bodies, states);
  if (kind == plain) planes_known_ = false;
  if (kind != whole) all_known_ = false;
}

void RankExchange::share_forces(RollingBodies& bodies, BodyStates& states, const StepScope& scope) {
  const Kind kind = kind_of(scope);
  if (kind == plain)  // planes within the own stretches
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      own_chains_.clear();
      for (int c : bodies[k].schedule.own) own_chains_.push_back(bodies[k].schedule.chains[c]);
      bodies[k].elements.end(own_chains_, states[k].f);
    }
  std::copy(mark_.begin(), mark_.end(), marks_.begin() + 2 * ranks_.rank);
  exchange_([&](int rank, auto&& visit) { each_force(rank, kind, bodies, states, visit); });
  require_same_bits(ranks_, marks_);
  for (std::size_t k = 0; k < bodies.size(); ++k)
    bodies[k].elements.end(kind == plain ? borders_[k] : bodies[k].schedule.chains, states[k].f);
}

void RankExchange::complete(const RollingBodies& bodies, BodyStates& states) {
  if (all_known_) return;
  for (Field BodyState::*field : {&BodyState::u, &BodyState::v})
    exchange_([&](int rank, auto&& visit) { each_value(rank, bodies, states, field, visit); });
  exchange_([&](int rank, auto&& visit) { each_slot(rank, bodies, states, visit); });
  planes_known_ = all_known_ = true;
}

}  // namespace railstrata
