#include "fem/rank_exchange.hpp"

#include <algorithm>
#include <cmath>

#include "core/body_id.hpp"
#include "core/parallel.hpp"

namespace railstrata {
namespace {

constexpr std::ptrdiff_t kUpdateSums = sizeof(UpdateSums) / sizeof(double);
static_assert(kUpdateSums * sizeof(double) == sizeof(UpdateSums));

// Section nodes of a body on its lines: those that wait for the contact, and those that are carried.
NodesOfBlocks line_nodes(const RollingBody& b) {
  NodeMask wanted = no_nodes(b.body.mesh);
  for (const SectionNode& n : b.schedule.waiting) wanted[n.block][n.node] = 1;
  for (const Tie& t : b.body.mesh.ties) wanted[t.slave_block][t.slave_node] = 1;
  return chosen_nodes(wanted);
}

NodesOfBlocks lines_with_moments(const RollingBody& b) {
  NodesOfBlocks out(b.body.layout.blocks.size());
  const std::vector<Ties::Line>& lines = b.body.ties.lines();
  if (b.turns() && moments_of_tiles(b.body.mesh, b.body.ties))
    for (int k = 0; k < static_cast<int>(lines.size()); ++k) out[lines[k].slave_block].push_back(k);
  return out;
}

NodesOfBlocks updated_at_once(const RollingBody& b) {
  NodesOfBlocks out(b.body.layout.blocks.size());
  for (const SectionNode& n : b.schedule.bordered) out[n.block].push_back(n.node);
  return out;
}

// Forces on lines where this rank does not collect them: nobody writes them, and mass scaling would make them smaller
// and smaller.
void clear_elsewhere(const RollingBody& b, const NodesOfBlocks& lines, const LineStations& kept, Field& f) {
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const BlockLayout& lay = b.body.layout.blocks[k];
    for (int n : lines[k])
      for (int i = 0; i < 3; ++i) {
        double* const line = f.data() + lay.line(n, i);
        int from = 0;
        for (const StationRange& r : kept[k][n]) {
          std::fill(line + from, line + r.begin, 0.0);
          from = r.end;
        }
        std::fill(line + from, line + lay.stations, 0.0);
      }
  }
}

}  // namespace

RankExchange::RankExchange(const Ranks& ranks, const Model& model, RollingBodies& bodies)
    : ranks_(ranks),
      exchange_(ranks),
      stretches_(all_stretches({&bodies[kRail].body, &bodies[kWheel].body}, {bodies[kRail].cut, bodies[kWheel].cut})),
      marks_(2 * static_cast<std::size_t>(ranks.count)),
      window_(model, bodies[kRail].body.mesh, bodies[kWheel].body.mesh) {
  for (const Stretch& s : stretches_) borders_[s.body].push_back(s);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    lines_[k] = line_nodes(bodies[k]);
    bore_[k] = nodes_on_axle(bodies[k].body.mesh, lines_[k]);
    slaves_[k] = lines_with_moments(bodies[k]);
    inner_nodes_[k] = updated_at_once(bodies[k]);
    const Ties& ties = bodies[k].body.ties;
    if (moments_of_tiles(bodies[k].body.mesh, ties))
      parts_[k].moments.assign(static_cast<std::size_t>(ties.first_piece(ties.lines().size())), 0.0);
    parts_[k].planes.resize(bodies[k].body.layout.blocks.size());
  }
  for (const Stretch& s : stretches_) parts_[s.body].planes[s.block].push_back(s.first - 1);
  place_windows(bodies, {});
}

void RankExchange::place_windows(RollingBodies& bodies, const AxlePose& pose) {
  placed_ = pose;
  sent_.clear();
  const double contact[] = {window_.rail_start + pose.x, pose.psi}, half_width = window_.half_length + window_.stride,
               width[] = {half_width, half_width / window_.radius};
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Body& b = bodies[k].body;
    const SharedLines shared{
        b.mesh, b.layout, b.tiling, b.ties, bodies[k].cut, lines_[k], bodies[k].scaling.chains(), contact[k], width[k]};
    std::vector<LineReach> reaches = line_reaches(shared, ranks_.count);
    for (SentRanges& sent : sent_ranges(shared, reaches)) sent_.push_back(std::move(sent));
    parts_[k].values = std::move(reaches[ranks_.rank].values);
    parts_[k].forces = std::move(reaches[ranks_.rank].forces);
  }
}

bool RankExchange::left_windows(const AxlePose& pose) const {
  return !(std::abs(pose.x - placed_.x) <= window_.stride &&
           std::abs(pose.psi - placed_.psi) * window_.radius <= window_.stride);
}

void RankExchange::prepare(RollingBodies& bodies, BodyStates& states, const StepScope& scope, const AxlePose& pose) {
  const bool parts = !scope.energy_wanted, moves = parts && left_windows(pose);
  if ((!parts || moves) && !all_known_) complete(bodies, states);
  if (moves) place_windows(bodies, pose);
  if (parts && all_known_)
    for (std::size_t k = 0; k < bodies.size(); ++k)
      clear_elsewhere(bodies[k], lines_[k], parts_[k].forces, states[k].f);
  for (std::size_t k = 0; k < bodies.size(); ++k) bodies[k].part = parts ? &parts_[k] : nullptr;
  if (parts) all_known_ = false;
}

double* RankExchange::moment_pieces(const Stretch& s, const Ties& ties, int line) {
  return parts_[s.body].moments.data() + ties.first_piece(static_cast<std::size_t>(line));
}

// Moments of the slaves in a rank's stretches, whose forces come from its elements alone.
void RankExchange::own_moments(const RollingBodies& bodies, BodyStates& states, const std::array<double, 2>& drift) {
  for (const Stretch& s : stretches_) {
    if (s.owner != ranks_.rank) continue;
    const Body& body = bodies[s.body].body;
    const TiedField field{body.ties, states[s.body].f, rotation_by(drift[s.body])};
    const int first = s.first_tile - body.tiling.first_tile[s.block], end = first + s.end_tile - s.first_tile;
    const std::vector<int>& slaves = slaves_[s.body][s.block];
    const auto find = [&](std::ptrdiff_t item) {
      const int line = slaves[item];
      body.ties.find_moment_pieces(body.ties.lines()[line], field, first, end, moment_pieces(s, body.ties, line));
    };
    for_each(static_cast<std::ptrdiff_t>(slaves.size()), find);
  }
}

void RankExchange::share_forces(RollingBodies& bodies, BodyStates& states, const std::array<double, 2>& drift,
                                const StepScope& scope) {
  const bool whole = scope.energy_wanted;
  for (std::size_t k = 0; k < bodies.size(); ++k) {  // planes within the own stretches
    own_chains_.clear();
    for (int c : bodies[k].schedule.own) own_chains_.push_back(bodies[k].schedule.chains[c]);
    if (whole) {
      bodies[k].elements.end(own_chains_, states[k].f);
      continue;
    }
    for (const NodesOfBlocks* nodes : {&lines_[k], &bore_[k]}) bodies[k].elements.end(own_chains_, states[k].f, nodes);
  }
  if (!whole) own_moments(bodies, states, drift);
  std::copy(mark_.begin(), mark_.end(), marks_.begin() + 2 * ranks_.rank);
  exchange_([&](int rank, auto&& visit) {
    visit(marks_.data() + 2 * rank, 2);
    for (std::size_t k = 0; k < stretches_.size(); ++k) {
      const Stretch& s = stretches_[k];
      if (s.owner != rank) continue;
      RollingBody& b = bodies[s.body];
      const int block = s.block;
      const BlockLayout& lay = b.body.layout.blocks[block];
      const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(lay.nodes) * 3;
      visit(b.elements.front_forces(s.first_tile), plane);
      visit(b.elements.rear_forces(s.end_tile - 1), plane);
      double* f = states[s.body].f.data();
      const auto visit_node = [&](int node, StationRange at) {
        for (int i = 0; i < 3; ++i) visit(f + lay.line(node, i) + at.begin, at.end - at.begin);
      };
      const StationRange all{s.first, s.end};
      if (whole) {
        for (int n = 0; n < lay.nodes; ++n) visit_node(n, all);
        continue;
      }
      for (int n : bore_[s.body][block]) visit_node(n, all);
      for (int n : lines_[s.body][block])
        for (const StationRange& r : sent_[k][n]) visit_node(n, r);
      for (int line : slaves_[s.body][block])
        visit(moment_pieces(s, b.body.ties, line) + 2 * (s.first_tile - b.body.tiling.first_tile[block]) + 1,
              moment_numbers(s));
    }
  });
  require_same_bits(ranks_, marks_);
  if (!whole) return;  // evaluate_elements goes on with the border planes
  for (std::size_t k = 0; k < bodies.size(); ++k) bodies[k].elements.end(borders_[k], states[k].f);
}

void RankExchange::share_sums(RollingBodies& bodies) {
  exchange_([&](int rank, auto&& visit) {
    for (const Stretch& s : stretches_)
      if (s.owner == rank)
        visit(&bodies[s.body].schedule.tile_sums[s.first_tile].kinetic, (s.end_tile - s.first_tile) * kUpdateSums);
  });
}

void RankExchange::complete(const RollingBodies& bodies, BodyStates& states) {
  if (all_known_) return;
  for (Field BodyState::*field : {&BodyState::u, &BodyState::v})
    exchange_([&](int rank, auto&& visit) {
      for (const Stretch& s : stretches_) {
        if (s.owner != rank) continue;
        const BlockLayout& lay = bodies[s.body].body.layout.blocks[s.block];
        double* values = (states[s.body].*field).data();
        const auto visit_nodes = [&](const std::vector<int>& nodes, int first, int end) {
          for (int n : nodes)
            for (int i = 0; i < 3; ++i) visit(values + lay.line(n, i) + first, end - first);
        };
        visit_nodes(inner_nodes_[s.body][s.block], s.first, s.end);
        // with the plane in front, and the ghost of a ring (body/traversal.hpp)
        visit_nodes(lines_[s.body][s.block], s.first - 1, s.end + (lay.closed && s.end == lay.stations));
      }
    });
  exchange_([&](int rank, auto&& visit) {
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      const PlasticElements& plastic = bodies[k].body.plastic;
      PlasticHistory& history = states[k].history;
      for (int slot = 0; slot < plastic.hot_places(history); ++slot)
        if (bodies[k].cut.owner[plastic.hot(history, slot).tile] == rank)
          visit(plastic.rows(history, slot), plastic.slot_numbers());
    }
  });
  all_known_ = true;
}

}  // namespace railstrata
