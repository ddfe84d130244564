#include "body/ties.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <stdexcept>

#include "body/tiling.hpp"
#include "core/parallel.hpp"
#include "core/vectorize.hpp"
#include "mesh/station_weights.hpp"

namespace railstrata {
namespace {

// Room for a number at each of a line's stations; of each thread.
double* station_values(int stations) {
  thread_local std::vector<double> values;
  if (values.size() < static_cast<std::size_t>(stations)) values.resize(static_cast<std::size_t>(stations));
  return values.data();
}

int tiles_of(const BlockLayout& block) { return (block.elements + kTile - 1) / kTile; }

// (1 - w) a + w b. The fused products are written out: which of the two a compiler fuses is its choice, and the offsets
// of the ties stand in every result.
Vec3 mix(double w, Vec3 a, Vec3 b) {
  return {std::fma(1 - w, a.x, w * b.x), std::fma(1 - w, a.y, w * b.y), std::fma(1 - w, a.z, w * b.z)};
}

// Ties such that a master that is itself tied comes before those that it carries.
std::vector<int> masters_first(const std::vector<Tie>& ties) {
  std::map<std::pair<int, int>, int> tie_of;  // (block, node) -> tie
  for (int t = 0; t < static_cast<int>(ties.size()); ++t)
    if (!tie_of.emplace(std::pair{ties[t].slave_block, ties[t].slave_node}, t).second)
      throw std::logic_error("a section node is tied twice");
  std::vector<char> open(ties.size(), 0), done(ties.size(), 0);
  std::vector<int> order;
  const std::function<void(int)> visit = [&](int t) {
    if (done[t]) return;
    if (open[t]) throw std::logic_error("ties form a cycle");
    open[t] = 1;
    for (int node : {ties[t].master_node0, ties[t].master_node1})
      if (const auto known = tie_of.find({ties[t].master_block, node}); known != tie_of.end()) visit(known->second);
    order.push_back(t);
    done[t] = 1;
  };
  for (int t = 0; t < static_cast<int>(ties.size()); ++t) visit(t);
  return order;
}

// Linear between the master block's stations around each of the slave's.
Ties::Interpolation interpolation(const SweptBody& body, int slave, int master) {
  Ties::Interpolation in;
  in.slave_block = slave;
  in.master_block = master;
  const Stations& stations = body.blocks[master].stations;
  for (double t : body.blocks[slave].stations.at) {
    const StationWeights at = station_weights(stations, t);
    in.left.push_back(at.left);
    in.right.push_back(at.right);
    in.weight.push_back(at.weight);
  }
  const auto each_share = [&](auto&& visit) {
    for (std::size_t j = 0; j < in.left.size(); ++j) {
      if (in.weight[j] < 1) visit(in.left[j], static_cast<int>(j), 1 - in.weight[j]);
      if (in.weight[j] > 0) visit(in.right[j], static_cast<int>(j), in.weight[j]);
    }
  };
  std::vector<int> held(static_cast<std::size_t>(stations.nodes()), 0);
  each_share([&](int i, int, double) { ++held[i]; });
  in.slots = *std::max_element(held.begin(), held.end());
  in.from.assign(in.slots * held.size(), 0);
  in.share.assign(in.from.size(), 0.0);
  std::fill(held.begin(), held.end(), 0);
  each_share([&](int i, int j, double share) {
    const std::size_t k = held[i]++ * held.size() + static_cast<std::size_t>(i);
    in.from[k] = j;
    in.share[k] = share;
  });
  return in;
}

constexpr int kComponents = 3;

// visit(field, stage, item) for all items(field, stage) of the fields in a stage, as one range, then the next stage.
template <class Items, class Visit>
void each_item(std::span<const TiedField> fields, int stages, Items&& items, Visit&& visit) {
  const auto count = [&](int stage) {
    std::ptrdiff_t sum = 0;
    for (std::size_t f = 0; f < fields.size(); ++f) sum += items(f, stage);
    return sum;
  };
  for_each_in_stages(stages, count, [&](int stage, std::ptrdiff_t k) {
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const std::ptrdiff_t n = items(f, stage);
      if (k < n) return visit(f, stage, k);
      k -= n;
    }
  });
}

int most_levels(std::span<const TiedField> fields) {
  std::size_t most = 0;
  for (const TiedField& f : fields) most = std::max(most, f.ties.levels().size());
  return static_cast<int>(most);
}

const Ties::Level* level_of(const TiedField& field, int level) {
  const auto k = static_cast<std::size_t>(level);
  return k < field.ties.levels().size() ? &field.ties.levels()[k] : nullptr;
}

}  // namespace

Ties::Ties(const SweptBody& body, const BodyLayout& layout) : layout_(layout), kind_(body.kind) {
  for (const Block& b : body.blocks) slave_.emplace_back(b.section.nodes.size(), false);
  for (int t : masters_first(body.ties)) add_line(body, body.ties[t]);
  add_levels();
  first_piece_.push_back(0);
  for (const Line& line : lines_) first_piece_.push_back(first_piece_.back() + moment_pieces(line));
  gathered_.push_back(0);
  for (const Line& line : lines_)
    gathered_.push_back(gathered_.back() + 3L * layout.blocks[line.master_block].stations);
  int longest = 0;
  for (const BlockLayout& l : layout.blocks) longest = std::max(longest, l.stations);
#pragma omp parallel
  station_values(longest);
}

void Ties::add_line(const SweptBody& body, const Tie& tie) {
  slave_[tie.slave_block][tie.slave_node] = true;
  const auto known = std::find_if(interpolations_.begin(), interpolations_.end(), [&](const Interpolation& in) {
    return in.slave_block == tie.slave_block && in.master_block == tie.master_block;
  });
  const int index = static_cast<int>(known - interpolations_.begin());
  if (known == interpolations_.end()) interpolations_.push_back(interpolation(body, tie.slave_block, tie.master_block));
  const Interpolation& in = interpolations_[index];
  lines_.push_back({tie.slave_block, tie.slave_node, tie.master_block, tie.master_node0, tie.master_node1, tie.weight1,
                    index, static_cast<std::ptrdiff_t>(delta_x_.size())});
  const Block& slave = body.blocks[tie.slave_block];
  const Block& master = body.blocks[tie.master_block];
  const auto at = [&](int node, int station) {
    return swept_point(body.kind, {}, master.section.nodes[node], master.stations.at[station]);
  };
  for (std::size_t j = 0; j < in.left.size(); ++j) {
    const auto between = [&](int node) { return mix(in.weight[j], at(node, in.left[j]), at(node, in.right[j])); };
    const Vec3 carried = mix(tie.weight1, between(tie.master_node0), between(tie.master_node1));
    const Vec3 delta = swept_point(body.kind, {}, slave.section.nodes[tie.slave_node], slave.stations.at[j]) - carried;
    delta_x_.push_back(delta.x);
    delta_z_.push_back(delta.z);
  }
}

// Sets the level of every line, one above the levels of its masters' own ties, and what the masters get.
void Ties::add_levels() {
  std::map<std::pair<int, int>, std::size_t> level_of;  // of slaves, by block and node
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const Line& line = lines_[k];
    std::size_t level = 0;
    for (int node : {line.node0, line.node1})
      if (const auto known = level_of.find({line.master_block, node}); known != level_of.end())
        level = std::max(level, known->second + 1);
    level_of[{line.slave_block, line.slave_node}] = level;
    if (levels_.size() <= level) levels_.resize(level + 1);
    levels_[level].lines.push_back(static_cast<int>(k));
  }
  for (Level& level : levels_) {
    std::map<std::pair<int, int>, std::vector<Share>> shares_of;  // by block and node
    for (auto k = level.lines.rbegin(); k != level.lines.rend(); ++k) {
      const Line& line = lines_[*k];
      if (line.weight1 < 1) shares_of[{line.master_block, line.node0}].push_back({*k, 1 - line.weight1});
      if (line.weight1 > 0) shares_of[{line.master_block, line.node1}].push_back({*k, line.weight1});
    }
    for (const auto& [master, shares] : shares_of) {
      level.masters.push_back(
          {master.first, master.second, static_cast<int>(level.shares.size()), static_cast<int>(shares.size())});
      level.shares.insert(level.shares.end(), shares.begin(), shares.end());
    }
  }
}

// visit(range) for what is kept of a line.
template <class Visit>
void Ties::each_range(const LineStations* kept, SectionNode line, Visit&& visit) const {
  if (kept == nullptr) return visit(StationRange{0, layout_.blocks[line.block].stations});
  for (const StationRange& range : (*kept)[line.block][line.node]) visit(range);
}

void Ties::spread_line(const Line& line, int i, const TiedField& field) const {
  const LineStations* const kept = field.part ? &field.part->values : nullptr;
  const SectionNode slave{line.slave_block, line.slave_node};
  const BlockLayout& from = layout_.blocks[line.master_block];
  const Interpolation& in = interpolations_[line.interpolation];
  const double* m0 = field.values.data() + from.line(line.node0, i);
  const double* m1 = field.values.data() + from.line(line.node1, i);
  double* const carried = station_values(from.stations);
  const double w = line.weight1;
  each_range(kept, {line.master_block, line.node0}, [&](StationRange range) {
    RAILSTRATA_INDEPENDENT
    for (int j = range.begin; j < range.end; ++j) carried[j] = (1 - w) * m0[j] + w * m1[j];
  });
  double* out = field.values.data() + layout_.blocks[line.slave_block].line(line.slave_node, i);
  const int *left = in.left.data(), *right = in.right.data();
  const double* weight = in.weight.data();
  each_range(kept, slave, [&](StationRange range) {
    RAILSTRATA_INDEPENDENT
    for (int j = range.begin; j < range.end; ++j) {
      const double a = carried[left[j]], b = carried[right[j]];
      out[j] = a + weight[j] * (b - a);
    }
  });
  if (field.homogeneous || kind_ != SweepKind::revolve || i == 1) return;
  // (R(psi) - I) delta; psi turns z towards x
  const double* along = (i == 0 ? delta_x_ : delta_z_).data() + line.delta;
  const double* across = (i == 0 ? delta_z_ : delta_x_).data() + line.delta;
  const double c = field.turn.c - 1, s = i == 0 ? field.turn.s : -field.turn.s;
  each_range(kept, slave, [&](StationRange range) {
    RAILSTRATA_INDEPENDENT
    for (int j = range.begin; j < range.end; ++j) out[j] += c * along[j] + s * across[j];
  });
}

void Ties::gather(int index, const TiedField& field, double* room) const {
  const Line& line = lines_[index];
  const Interpolation& in = interpolations_[line.interpolation];
  const BlockLayout &from = layout_.blocks[line.slave_block], &to = layout_.blocks[line.master_block];
  const double* const x = field.values.data() + from.line(line.slave_node, 0);
  const double *const y = x + from.stride, *const z = y + from.stride;
  double* const gathered = room + gathered_[index];
  const int stations = to.stations;
  const auto gather_range = [&](StationRange range) {
    double *const gx = gathered, *const gy = gx + stations, *const gz = gy + stations;
    for (double* const g : {gx, gy, gz}) std::fill(g + range.begin, g + range.end, 0.0);
    for (int slot = 0; slot < in.slots; ++slot) {
      const int* at = in.from.data() + static_cast<std::ptrdiff_t>(slot) * stations;
      const double* share = in.share.data() + static_cast<std::ptrdiff_t>(slot) * stations;
      RAILSTRATA_INDEPENDENT
      for (int j = range.begin; j < range.end; ++j) {
        gx[j] += share[j] * x[at[j]];
        gy[j] += share[j] * y[at[j]];
        gz[j] += share[j] * z[at[j]];
      }
    }
  };
  const LineStations* const kept = field.part ? &field.part->forces : nullptr;
  each_range(kept, {line.master_block, line.node0}, gather_range);
  if (kept != nullptr && (*kept)[line.master_block][line.node1] != (*kept)[line.master_block][line.node0])
    each_range(kept, {line.master_block, line.node1}, gather_range);
}

void Ties::add_gathered(const Level& level, const Master& master, int i, const TiedField& field,
                        const double* room) const {
  const BlockLayout& to = layout_.blocks[master.block];
  double* const sum = field.values.data() + to.line(master.node, i);
  for (int s = master.first_share; s < master.first_share + master.shares; ++s) {
    const double* const gathered =
        room + gathered_[level.shares[s].line] + static_cast<std::ptrdiff_t>(i) * to.stations;
    const double weight = level.shares[s].weight;
    each_range(field.part ? &field.part->forces : nullptr, {master.block, master.node}, [&](StationRange range) {
      RAILSTRATA_INDEPENDENT
      for (int j = range.begin; j < range.end; ++j) sum[j] += weight * gathered[j];
    });
  }
}

int Ties::moment_pieces(const Line& line) const {
  const BlockLayout& lay = layout_.blocks[line.slave_block];
  return 2 * tiles_of(lay) + (lay.closed ? 0 : 1);
}

double Ties::piece(const Line& line, const TiedField& field, StationRange at) const {
  constexpr int kParts = 8;  // a fixed number, so that the sum has the same order on every machine
  const BlockLayout& lay = layout_.blocks[line.slave_block];
  const double *x = field.values.data() + lay.line(line.slave_node, 0), *z = x + 2 * lay.stride;
  const double *dx = delta_x_.data() + line.delta, *dz = delta_z_.data() + line.delta;
  const double c = field.turn.c, s = field.turn.s;
  double moment[kTile] = {};
  const int n = at.end - at.begin;
  RAILSTRATA_INDEPENDENT
  for (int k = 0; k < n; ++k) {
    const int j = at.begin + k;
    moment[k] = x[j] * (c * dz[j] - s * dx[j]) - z[j] * (c * dx[j] + s * dz[j]);
  }
  double part[kParts] = {};
  for (int j = 0; j < kTile; j += kParts)
    for (int k = 0; k < kParts; ++k) part[k] += moment[j + k];
  double sum = 0;
  for (double p : part) sum += p;
  return sum;
}

void Ties::find_moment_pieces(const Line& line, const TiedField& field, int first, int end, double* pieces) const {
  const int elements = layout_.blocks[line.slave_block].elements;
  for (int t = first; t < end; ++t) {
    const int plane = t * kTile;
    if (t > first) pieces[2 * t] = piece(line, field, {plane, plane + 1});
    pieces[2 * t + 1] = piece(line, field, {plane + 1, std::min(plane + kTile, elements)});
  }
}

double Ties::moment(int index, const TiedField& field) const {
  if (kind_ != SweepKind::revolve) return 0;
  const Line& line = lines_[index];
  const BlockLayout& lay = layout_.blocks[line.slave_block];
  const int count = moment_pieces(line);
  const bool given = field.part != nullptr && !field.part->moments.empty();
  double* const pieces = given ? field.part->moments.data() + first_piece_[index] : station_values(count);
  const auto find_plane = [&](int station) {
    pieces[2 * (station / kTile)] = piece(line, field, {station, station + 1});
  };
  if (given) {
    for (int station : field.part->planes[line.slave_block]) find_plane(station);
  } else {
    find_plane(0);
    find_moment_pieces(line, field, 0, tiles_of(lay), pieces);
  }
  if (!lay.closed) pieces[count - 1] = piece(line, field, {lay.elements, lay.elements + 1});
  return std::accumulate(pieces, pieces + count, 0.0);
}

void Ties::clear(const Line& line, const TiedField& field) const {
  const LineStations* const kept = field.part ? &field.part->forces : nullptr;
  const BlockLayout& lay = layout_.blocks[line.slave_block];
  for (int i = 0; i < 3; ++i) {
    double* const values = field.values.data() + lay.line(line.slave_node, i);
    each_range(kept, {line.slave_block, line.slave_node},
               [&](StationRange range) { std::fill(values + range.begin, values + range.end, 0.0); });
  }
}

void spread_ties(std::span<const TiedField> fields) {
  const auto items = [&](std::size_t f, int stage) -> std::ptrdiff_t {
    const Ties::Level* const level = level_of(fields[f], stage);
    return level ? static_cast<std::ptrdiff_t>(kComponents * level->lines.size()) : 0;
  };
  each_item(fields, most_levels(fields), items, [&](std::size_t f, int stage, std::ptrdiff_t item) {
    const Ties& ties = fields[f].ties;
    const int line = level_of(fields[f], stage)->lines[item / kComponents];
    ties.spread_line(ties.lines_[line], static_cast<int>(item % kComponents), fields[f]);
  });
}

// Level by level, the highest first: forces of slaves at their masters' stations, then these to the masters. At the end
// the slaves give their moments and are cleared, all at once.
double collect_ties(std::span<const TiedField> fields) {
  thread_local std::vector<double> moments, gathered;
  thread_local std::vector<std::ptrdiff_t> first_line, first_room;  // of each field in these, and their ends
  first_line.assign(1, 0);
  first_room.assign(1, 0);
  for (const TiedField& f : fields) {
    first_line.push_back(first_line.back() + static_cast<std::ptrdiff_t>(f.ties.lines_.size()));
    first_room.push_back(first_room.back() + f.ties.gathered_.back());
  }
  moments.assign(static_cast<std::size_t>(first_line.back()), 0.0);
  if (const auto wanted = static_cast<std::size_t>(first_room.back()); gathered.size() < wanted)
    gathered.resize(wanted);
  double *const moment = moments.data(), *const rooms = gathered.data();  // of this thread, for all of the loop's
  const std::ptrdiff_t *const line_of = first_line.data(), *const room_of = first_room.data();
  const int levels = most_levels(fields);
  const auto level_in = [&](std::size_t f, int stage) { return level_of(fields[f], levels - 1 - stage / 2); };
  const auto items = [&](std::size_t f, int stage) -> std::ptrdiff_t {
    if (stage == 2 * levels) return static_cast<std::ptrdiff_t>(fields[f].ties.lines_.size());
    const Ties::Level* const level = level_in(f, stage);
    if (level == nullptr) return 0;
    return static_cast<std::ptrdiff_t>(stage % 2 == 0 ? level->lines.size() : kComponents * level->masters.size());
  };
  each_item(fields, 2 * levels + 1, items, [&](std::size_t f, int stage, std::ptrdiff_t item) {
    const Ties& ties = fields[f].ties;
    double* const room = rooms + room_of[f];
    if (stage == 2 * levels) {
      moment[line_of[f] + item] = ties.moment(static_cast<int>(item), fields[f]);
      ties.clear(ties.lines_[item], fields[f]);
    } else if (const Ties::Level& level = *level_in(f, stage); stage % 2 == 0) {
      ties.gather(level.lines[item], fields[f], room);
    } else {
      const Ties::Master& master = level.masters[item / kComponents];
      ties.add_gathered(level, master, static_cast<int>(item % kComponents), fields[f], room);
    }
  });
  return std::accumulate(moments.begin(), moments.end(), 0.0);
}

void Ties::apply(Field& u, double psi) const {
  const TiedField field{*this, u, rotation_by(psi)};
  spread_ties({&field, 1});
}

void Ties::apply_homogeneous(Field& u) const {
  const TiedField field{*this, u, {}, true};
  spread_ties({&field, 1});
}

double Ties::apply_transpose(Field& f, double psi) const {
  const TiedField field{*this, f, rotation_by(psi)};
  return collect_ties({&field, 1});
}

}  // namespace railstrata
