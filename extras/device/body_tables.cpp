#include "device/body_tables.hpp"

#include <algorithm>
#include <map>

namespace railstrata::device {
namespace {

constexpr int kEigenstressNumbers = 18;

int whole_lanes(int n) { return (n + kLanes - 1) / kLanes * kLanes; }

void add_pieces(int record, int stations, std::vector<Piece>& pieces) {
  for (int first = 0; first < stations; first += kLanes)
    pieces.push_back({record, first, std::min(kLanes, stations - first)});
}

// Numbers by station or element of all blocks, one after the other.
struct StationLists {
  std::vector<int> stations_at, groups_at;  // per block
  std::vector<double> cos_q, sin_q, cos_node, sin_node;
  std::vector<int> classes;
};

StationLists station_lists(const RollingBody& b) {
  StationLists out;
  for (std::size_t k = 0; k < b.body.layout.blocks.size(); ++k) {
    const BlockLayout& lay = b.body.layout.blocks[k];
    const BlockElements& e = b.body.elements[k];
    const auto length = static_cast<std::size_t>(whole_lanes(std::max(lay.stations, lay.elements)));
    out.stations_at.push_back(static_cast<int>(out.cos_q.size()));
    out.groups_at.push_back(static_cast<int>(out.classes.size()));
    const auto append = [&](const auto& values, std::size_t count, std::vector<double>& to) {
      const std::size_t end = to.size() + length;
      to.insert(to.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
      to.resize(end, 0.0);
    };
    append(e.cos_q, static_cast<std::size_t>(lay.elements), out.cos_q);
    append(e.sin_q, static_cast<std::size_t>(lay.elements), out.sin_q);
    append(b.cos_node[k], static_cast<std::size_t>(lay.stations), out.cos_node);
    append(b.sin_node[k], static_cast<std::size_t>(lay.stations), out.sin_node);
    out.classes.insert(out.classes.end(), e.hourglass_class.begin(), e.hourglass_class.end());
  }
  return out;
}

// Quadrilaterals of all blocks in the order of the blocks, nodes likewise, and where the rows of a quadrilateral's
// corners stand.
struct Records {
  std::vector<QuadRecord> quads;
  std::vector<NodeRecord> nodes;
  std::vector<std::ptrdiff_t> corners;
  std::vector<std::vector<int>> node_at;  // by block and section node, into nodes
  std::ptrdiff_t rows = 0;
};

void add_quads(const Body& body, int block, const StationLists& at, int references, int hourglass, Records& out) {
  const BlockLayout& lay = body.layout.blocks[block];
  const auto& quads = body.mesh.blocks[block].section.quads;
  const int row_stride = whole_lanes(lay.elements);
  for (std::size_t q = 0; q < quads.size(); ++q) {
    QuadRecord r{};
    for (int c = 0; c < 4; ++c) r.corner[c] = lay.line(quads[q][c], 0);
    r.rows = out.rows;
    r.eigenstress = -1;
    r.reference = references + static_cast<int>(q);
    r.hourglass = hourglass + static_cast<int>(q);
    r.hourglass_step = static_cast<int>(quads.size());
    r.stations_at = at.stations_at[block];
    r.groups_at = at.groups_at[block];
    r.stride = lay.stride;
    r.row_stride = row_stride;
    r.elements = lay.elements;
    r.stations = lay.stations;
    out.rows += static_cast<std::ptrdiff_t>(kCornerRows) * row_stride;
    out.quads.push_back(r);
  }
}

// first_quad: of the block, in out.quads.
void add_nodes(const RollingBody& b, int block, const StationLists& at, std::size_t first_quad, Records& out) {
  const Body& body = b.body;
  const BlockLayout& lay = body.layout.blocks[block];
  const auto& quads = body.mesh.blocks[block].section.quads;
  std::vector<std::vector<std::ptrdiff_t>> around(static_cast<std::size_t>(lay.nodes));
  for (int q : body.tiling.plans[block].order)
    for (int c = 0; c < 4; ++c) {
      const QuadRecord& r = out.quads[first_quad + static_cast<std::size_t>(q)];
      around[quads[q][c]].push_back(r.rows + static_cast<std::ptrdiff_t>(6) * c * r.row_stride);
    }
  out.node_at.emplace_back();
  for (int n = 0; n < lay.nodes; ++n) {
    NodeRecord r{};
    r.x = lay.line(n, 0);
    r.first_corner = static_cast<int>(out.corners.size());
    r.corners = static_cast<int>(around[n].size());
    r.stations_at = at.stations_at[block];
    r.stride = lay.stride;
    r.row_stride = whole_lanes(lay.elements);
    r.elements = lay.elements;
    r.stations = lay.stations;
    r.closed = lay.closed;
    r.at_once = b.schedule.at_once[block][n];
    r.radius = b.turns() ? line_radius(body, block, n) : 0.0;
    out.corners.insert(out.corners.end(), around[n].begin(), around[n].end());
    out.node_at.back().push_back(static_cast<int>(out.nodes.size()));
    out.nodes.push_back(r);
  }
}

void add_initial_stress(const Body& body, Records& records, std::vector<double>& numbers) {
  if (body.initial_stress.empty()) return;
  std::map<const double*, std::ptrdiff_t> known;  // rows of quadrilaterals with the same stress
  std::size_t k = 0;
  for (int b = 0; b < static_cast<int>(body.mesh.blocks.size()); ++b)
    for (int q = 0; q < static_cast<int>(body.mesh.blocks[b].section.quads.size()); ++q, ++k) {
      const double* rows = body.initial_stress.rows(b, q);
      if (!rows) continue;
      const auto [at, is_new] = known.emplace(rows, static_cast<std::ptrdiff_t>(numbers.size()));
      if (is_new)
        for (int n = 0; n < kEigenstressNumbers; ++n) numbers.push_back(rows[n * kTile]);
      records.quads[k].eigenstress = at->second;
    }
}

// The element tables of all blocks, one after the other.
template <class Real>
ElementArrays<Real> element_arrays(Device& device, const Body& body, const StationLists& at,
                                   const std::vector<Real>& eigenstress, std::ptrdiff_t rows) {
  std::vector<HexReference<Real>> references;
  std::vector<Real> hourglass, line[5];
  for (std::size_t k = 0; k < body.elements.size(); ++k) {
    const ElementTable<Real>& t = body.elements[k].template of<Real>();
    references.insert(references.end(), t.quads.begin(), t.quads.end());
    for (const auto& entries : t.hourglass) hourglass.insert(hourglass.end(), entries.begin(), entries.end());
    const std::size_t end =
        k + 1 < body.elements.size() ? static_cast<std::size_t>(at.stations_at[k + 1]) : at.cos_q.size();
    const auto count = static_cast<std::ptrdiff_t>(body.layout.blocks[k].elements);
    for (std::size_t n = 0; n < t.kLines.size(); ++n) {
      const auto& from = t.*t.kLines[n];
      line[n].insert(line[n].end(), from.begin(), from.begin() + count);
      line[n].resize(end, Real{0});
    }
  }
  return {on_device<HexReference<Real>>(device, references),
          on_device<Real>(device, hourglass),
          on_device<Real>(device, eigenstress),
          on_device<Real>(device, line[0]),
          on_device<Real>(device, line[1]),
          on_device<Real>(device, line[2]),
          on_device<Real>(device, line[3]),
          on_device<Real>(device, line[4]),
          {device, static_cast<std::size_t>(rows)}};
}

struct InterpolationStart {
  std::ptrdiff_t between, shares;
};

std::vector<InterpolationStart> add_interpolations(Device& device, const Ties& ties, TieArrays& out) {
  std::vector<InterpolationStart> start;
  std::vector<int> left, right, first, from;
  std::vector<double> weight, share;
  for (const Ties::Interpolation& in : ties.interpolations()) {
    start.push_back({static_cast<std::ptrdiff_t>(left.size()), static_cast<std::ptrdiff_t>(first.size())});
    left.insert(left.end(), in.left.begin(), in.left.end());
    right.insert(right.end(), in.right.begin(), in.right.end());
    weight.insert(weight.end(), in.weight.begin(), in.weight.end());
    const std::size_t stations = in.from.size() / static_cast<std::size_t>(in.slots);
    for (std::size_t j = 0; j < stations; ++j) {
      first.push_back(static_cast<int>(from.size()));
      for (std::size_t k = j; k < in.from.size(); k += stations)
        if (in.share[k] > 0) {
          from.push_back(in.from[k]);
          share.push_back(in.share[k]);
        }
    }
    first.push_back(static_cast<int>(from.size()));
  }
  out.left = on_device<int>(device, left);
  out.right = on_device<int>(device, right);
  out.first = on_device<int>(device, first);
  out.from = on_device<int>(device, from);
  out.weight = on_device<double>(device, weight);
  out.share = on_device<double>(device, share);
  return start;
}

// The slaves of a level and what their masters get, in the order in which the host adds it: the last tie first.
TieLevel tie_level(Device& device, const Body& body, const std::vector<TieRecord>& ties,
                   const std::vector<int>& lines) {
  std::vector<Piece> slaves, masters;
  std::vector<std::ptrdiff_t> order;                          // of the masters' lines
  std::map<std::ptrdiff_t, std::vector<TieShare>> shares_of;  // by line
  std::map<std::ptrdiff_t, const Ties::Line*> any_line;
  for (auto k = lines.rbegin(); k != lines.rend(); ++k) {
    const int t = *k;
    add_pieces(t, ties[t].slave_stations, slaves);
    const auto give = [&](std::ptrdiff_t line, double weight) {
      if (!shares_of.contains(line)) order.push_back(line);
      shares_of[line].push_back({t, weight});
      any_line[line] = &body.ties.lines()[t];
    };
    give(ties[t].master0, 1 - ties[t].weight1);
    give(ties[t].master1, ties[t].weight1);
  }
  std::vector<MasterRecord> records;
  std::vector<TieShare> shares;
  for (std::ptrdiff_t line : order) {
    const BlockLayout& lay = body.layout.blocks[any_line[line]->master_block];
    add_pieces(static_cast<int>(records.size()), lay.stations, masters);
    records.push_back(
        {line, lay.stride, lay.stations, static_cast<int>(shares.size()), static_cast<int>(shares_of[line].size())});
    shares.insert(shares.end(), shares_of[line].begin(), shares_of[line].end());
  }
  return {on_device<Piece>(device, slaves), on_device<Piece>(device, masters), on_device<MasterRecord>(device, records),
          on_device<TieShare>(device, shares)};
}

TieArrays tie_arrays(Device& device, const Body& body) {
  const Ties& ties = body.ties;
  TieArrays out;
  if (ties.lines().empty()) return out;
  const std::vector<InterpolationStart> start = add_interpolations(device, ties, out);
  std::vector<TieRecord> records;
  for (const Ties::Line& l : ties.lines()) {
    const BlockLayout &slave = body.layout.blocks[l.slave_block], &master = body.layout.blocks[l.master_block];
    records.push_back({slave.line(l.slave_node, 0), master.line(l.node0, 0), master.line(l.node1, 0),
                       start[l.interpolation].between, start[l.interpolation].shares, l.delta, slave.stride,
                       slave.stations, master.stride, master.stations, l.weight1});
  }
  out.ties = on_device<TieRecord>(device, records);
  out.delta_x = on_device<double>(device, ties.delta_x());
  out.delta_z = on_device<double>(device, ties.delta_z());
  for (const Ties::Level& level : ties.levels()) {
    out.levels.push_back(tie_level(device, body, records, level.lines));
    out.levels.back().first_moment = out.moments;
    out.moments += static_cast<std::ptrdiff_t>(out.levels.back().slaves.size()) * kLanes;
  }
  return out;
}

ChainArrays chain_arrays(Device& device, const RollingBody& b, const StationLists& at) {
  const MassScaling& scaling = b.scaling;
  const Body& body = b.body;
  ChainArrays out;
  std::vector<int> chain_at(static_cast<std::size_t>(b.surface.columns), -1);
  out.chain_at = on_device<int>(device, chain_at);
  if (scaling.empty()) return out;
  std::vector<ChainRecord> records;
  std::vector<ChainNode> nodes;
  std::vector<Piece> pieces;
  for (const MassScaling::Chain& c : scaling.chains()) {
    const BlockLayout& lay = body.layout.blocks[c.block];
    const int record = static_cast<int>(records.size());
    if (c.block == body.mesh.contact.block && c.nodes.front() < b.surface.columns)
      chain_at[static_cast<std::size_t>(c.nodes.front())] = record;
    add_pieces(record, c.stations, pieces);
    records.push_back({c.factor, static_cast<int>(nodes.size()), static_cast<int>(c.nodes.size()), lay.stride,
                       c.stations, at.stations_at[c.block]});
    for (int n : c.nodes) nodes.push_back({lay.line(n, 0), b.turns() ? line_radius(body, c.block, n) : 0.0});
  }
  out.chain_at.upload(chain_at);
  const MassScaling::Factors f = scaling.factors();
  out.chains = on_device<ChainRecord>(device, records);
  out.nodes = on_device<ChainNode>(device, nodes);
  out.added = on_device<double>(device, f.added);
  out.forward = on_device<double>(device, f.forward);
  out.pivot = on_device<double>(device, f.pivot);
  out.backward = on_device<double>(device, f.backward);
  out.response = on_device<double>(device, f.response);
  out.pieces = on_device<Piece>(device, pieces);
  return out;
}

std::vector<Piece> quad_pieces(const Records& records) {
  std::vector<Piece> out;
  for (std::size_t q = 0; q < records.quads.size(); ++q)
    add_pieces(static_cast<int>(q), records.quads[q].elements, out);
  return out;
}

std::vector<Piece> node_pieces(const Records& records) {
  std::vector<Piece> out;
  for (std::size_t n = 0; n < records.nodes.size(); ++n)
    add_pieces(static_cast<int>(n), records.nodes[n].stations, out);
  return out;
}

// The ends of open blocks wait for what acts on them.
std::vector<Piece> waiting_pieces(const RollingBody& b, const Records& records) {
  std::vector<Piece> out;
  for (const SectionNode& n : b.schedule.waiting)
    add_pieces(records.node_at[n.block][n.node], b.body.layout.blocks[n.block].stations, out);
  for (std::size_t n = 0; n < records.nodes.size(); ++n) {
    const NodeRecord& r = records.nodes[n];
    if (!r.at_once || r.closed) continue;
    for (int end : {0, r.stations - 1}) out.push_back({static_cast<int>(n), end, 1});
  }
  return out;
}

}  // namespace

BodyTables::BodyTables(Device& device, const RollingBody& b)
    : kind(b.body.mesh.kind), single(b.body.options.precision == Precision::single_precision) {
  const Body& body = b.body;
  const StationLists at = station_lists(b);
  Records records;
  int references = 0, hourglass = 0;
  for (int k = 0; k < static_cast<int>(body.mesh.blocks.size()); ++k) {
    const std::size_t first_quad = records.quads.size();
    add_quads(body, k, at, references, hourglass, records);
    add_nodes(b, k, at, first_quad, records);
    references += static_cast<int>(body.elements[k].table.quads.size());
    hourglass += static_cast<int>(body.elements[k].table.hourglass.size());
  }
  std::vector<double> eigenstress;
  add_initial_stress(body, records, eigenstress);
  in_double = element_arrays<double>(device, body, at, eigenstress, single ? 0 : records.rows);
  if (single) {
    const std::vector<float> rounded(eigenstress.begin(), eigenstress.end());
    in_single = element_arrays<float>(device, body, at, rounded, records.rows);
  }
  for (const QuadRecord& q : records.quads) elements += q.elements;
  quads = on_device<QuadRecord>(device, records.quads);
  nodes = on_device<NodeRecord>(device, records.nodes);
  corners = on_device<std::ptrdiff_t>(device, records.corners);
  quad_pieces = on_device<Piece>(device, device::quad_pieces(records));
  node_pieces = on_device<Piece>(device, device::node_pieces(records));
  waiting_pieces = on_device<Piece>(device, device::waiting_pieces(b, records));
  classes = on_device<int>(device, at.classes);
  cos_q = on_device<double>(device, at.cos_q);
  sin_q = on_device<double>(device, at.sin_q);
  cos_node = on_device<double>(device, at.cos_node);
  sin_node = on_device<double>(device, at.sin_node);
  inverse_mass = on_device<double>(device, body.inverse_mass);
  mass = on_device<double>(device, body.mass);
  ties = tie_arrays(device, body);
  added_mass = chain_arrays(device, b, at);
}

}  // namespace railstrata::device
