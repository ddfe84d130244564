#include "fem/line_reach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace railstrata {
namespace {

// Groups of stations, by block and section node.
class Groups {
 public:
  explicit Groups(const BodyLayout& layout) : layout_(&layout) {
    for (const BlockLayout& l : layout.blocks)
      in_.emplace_back(l.nodes, std::vector<char>((l.stations + kStationGroup - 1) / kStationGroup, 0));
  }
  bool has(SectionNode line, int station) const { return in_[line.block][line.node][station / kStationGroup]; }
  void add(SectionNode line, int station) { in_[line.block][line.node][station / kStationGroup] = 1; }
  void add_all(SectionNode line) { std::fill(in_[line.block][line.node].begin(), in_[line.block][line.node].end(), 1); }
  StationRanges ranges(SectionNode line) const {
    const std::vector<char>& in = in_[line.block][line.node];
    const int stations = layout_->blocks[line.block].stations;
    StationRanges out;
    for (int g = 0; g < static_cast<int>(in.size()); ++g) {
      if (!in[g]) continue;
      const int begin = g * kStationGroup, end = std::min(begin + kStationGroup, stations);
      if (out.empty() || out.back().end < begin)
        out.push_back({begin, end});
      else
        out.back().end = end;
    }
    return out;
  }
  LineStations ranges() const {
    LineStations out;
    for (int b = 0; b < static_cast<int>(in_.size()); ++b) {
      out.emplace_back();
      for (int n = 0; n < static_cast<int>(in_[b].size()); ++n) out[b].push_back(ranges({b, n}));
    }
    return out;
  }

 private:
  const BodyLayout* layout_;
  std::vector<std::vector<std::vector<char>>> in_;
};

// Values that all ranks read: the running surface around the contact, the base on pads, the ends of open blocks.
void add_seen_by_all(const SharedLines& body, Groups& groups) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const int contact = body.mesh.contact.block;
  const Stations& stations = body.mesh.blocks[contact].stations;
  for (int j = 0; j < stations.nodes(); ++j) {
    double away = stations.at[j] - body.contact;
    if (stations.closed) away -= kTurn * std::round(away / kTurn);
    if (std::abs(away) > body.half_width) continue;
    for (int c = 0; c <= body.mesh.contact.columns; ++c) groups.add({contact, c}, j);
  }
  for (const SectionNode& n : body.mesh.on_pads) groups.add_all(n);
  for (int b = 0; b < static_cast<int>(body.layout.blocks.size()); ++b) {
    if (body.layout.blocks[b].closed) continue;
    for (int n : body.lines[b])
      for (int end : {0, body.layout.blocks[b].stations - 1}) groups.add({b, n}, end);
  }
}

// Values that a rank's elements read.
void add_own(const SharedLines& body, int rank, Groups& groups) {
  for (std::size_t t = 0; t < body.tiling.tiles.size(); ++t) {
    if (body.cut.owner[t] != rank) continue;
    const Tile& tile = body.tiling.tiles[t];
    const int stations = body.layout.blocks[tile.block].stations;
    for (int n : body.lines[tile.block])
      for (int j = tile.first; j <= tile.end; ++j) groups.add({tile.block, n}, j < stations ? j : 0);
  }
}

// Lines that carry others come first (Ties::lines), so that one way through them is enough.
void add_masters(const Ties& ties, Groups& groups) {
  for (auto line = ties.lines().rbegin(); line != ties.lines().rend(); ++line) {
    const Ties::Interpolation& in = ties.interpolations()[line->interpolation];
    for (int j = 0; j < static_cast<int>(in.left.size()); ++j)
      if (groups.has({line->slave_block, line->slave_node}, j))
        for (int node : {line->node0, line->node1})
          for (int master : {in.left[j], in.right[j]}) groups.add({line->master_block, node}, master);
  }
}

void add_chains(const std::vector<MassScaling::Chain>& chains, Groups& groups) {
  for (const MassScaling::Chain& chain : chains)
    for (int j = 0; j < chain.stations; j += kStationGroup) {
      const auto wanted = [&](int node) { return groups.has({chain.block, node}, j); };
      if (std::any_of(chain.nodes.begin(), chain.nodes.end(), wanted))
        for (int node : chain.nodes) groups.add({chain.block, node}, j);
    }
}

void add_slaves(const SharedLines& body, Groups& groups) {
  for (const Ties::Line& line : body.ties.lines()) {
    const Ties::Interpolation& in = body.ties.interpolations()[line.interpolation];
    const auto stations = static_cast<std::size_t>(body.layout.blocks[line.master_block].stations);
    for (std::size_t k = 0; k < in.from.size(); ++k) {
      const int j = static_cast<int>(k % stations);
      const bool read =
          groups.has({line.master_block, line.node0}, j) || groups.has({line.master_block, line.node1}, j);
      if (read && in.share[k] > 0) groups.add({line.slave_block, line.slave_node}, in.from[k]);
    }
  }
}

bool axle_carries(const SweptBody& mesh) {
  return std::any_of(mesh.ties.begin(), mesh.ties.end(), [&](const Tie& t) {
    return std::any_of(mesh.prescribed.begin(), mesh.prescribed.end(), [&](const SectionNode& n) {
      return n.block == t.master_block && (n.node == t.master_node0 || n.node == t.master_node1);
    });
  });
}

void add_for_axle(const SharedLines& body, Groups& groups) {
  if (body.mesh.kind != SweepKind::revolve || moments_of_tiles(body.mesh, body.ties)) return;
  for (const Ties::Line& line : body.ties.lines())
    for (const SectionNode& n :
         {SectionNode{line.slave_block, line.slave_node}, SectionNode{line.master_block, line.node0},
          SectionNode{line.master_block, line.node1}})
      groups.add_all(n);
}

}  // namespace

NodesOfBlocks chosen_nodes(const NodeMask& mask) {
  NodesOfBlocks out(mask.size());
  for (std::size_t k = 0; k < mask.size(); ++k)
    for (int n = 0; n < static_cast<int>(mask[k].size()); ++n)
      if (mask[k][n]) out[k].push_back(n);
  return out;
}

NodesOfBlocks nodes_on_axle(const SweptBody& mesh, const NodesOfBlocks& lines) {
  NodeMask wanted = no_nodes(mesh);
  if (mesh.kind == SweepKind::revolve)
    for (const SectionNode& n : mesh.prescribed) wanted[n.block][n.node] = 1;
  for (std::size_t k = 0; k < lines.size(); ++k)
    for (int n : lines[k]) wanted[k][n] = 0;
  return chosen_nodes(wanted);
}

double search_half_length(const Model& model) {
  const double ahead = std::abs(model.placement.contact.x);  // of the axle: a yawed wheel's contact
  return 1.5 * model.hertz.a + 3 * model.spec.mesh.element_size + ahead + model.reach;
}

// The wheel's stations opposite lie where the rail's do but for the strain and the correction of the projection; the
// window is wider by a quarter and by elements of its own.
ContactWindow::ContactWindow(const Model& model, const SweptBody& rail, const SweptBody& wheel)
    : half_length(1.25 * search_half_length(model) + 7 * model.spec.mesh.element_size),
      stride(4 * model.spec.mesh.element_size),
      rail_start(wheel.origin.x - rail.origin.x),
      radius(std::numeric_limits<double>::infinity()) {
  for (int n = 0; n <= wheel.contact.columns; ++n)
    radius = std::min(radius, std::abs(wheel.blocks[wheel.contact.block].section.nodes[n].z));
}

std::vector<LineReach> line_reaches(const SharedLines& body, int ranks) {
  std::vector<LineReach> out;
  for (int rank = 0; rank < ranks; ++rank) {
    Groups groups(body.layout);
    add_seen_by_all(body, groups);
    add_own(body, rank, groups);
    add_masters(body.ties, groups);
    LineStations values = groups.ranges();
    add_for_axle(body, groups);
    add_chains(body.chains, groups);
    add_slaves(body, groups);
    out.push_back({std::move(values), groups.ranges()});
  }
  return out;
}

bool moments_of_tiles(const SweptBody& mesh, const Ties& ties) {
  return ties.levels().size() <= 1 && !axle_carries(mesh);
}

std::vector<SentRanges> sent_ranges(const SharedLines& body, const std::vector<LineReach>& reaches) {
  std::vector<SentRanges> out;
  for (const OwnedChain& s : stretches(body.tiling, body.cut)) {
    const int block = body.tiling.block(s), plane = body.tiling.border_plane(s),
              end = body.tiling.tiles[s.end_tile - 1].end;
    Groups wanted(body.layout);
    for (int rank = 0; rank < static_cast<int>(reaches.size()); ++rank)
      if (rank != s.owner)
        for (int n : body.lines[block])
          for (const StationRange& r : reaches[rank].forces[block][n])
            for (int j = r.begin; j < r.end; ++j) wanted.add({block, n}, j);
    SentRanges sent(body.layout.blocks[block].nodes);
    for (int n : body.lines[block])
      for (const StationRange& r : wanted.ranges({block, n})) {
        const StationRange inside{std::max(r.begin, plane + 1), std::min(r.end, end)};
        if (inside.begin < inside.end) sent[n].push_back(inside);
      }
    out.push_back(std::move(sent));
  }
  return out;
}

}  // namespace railstrata
