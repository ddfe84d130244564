#include "body/ties.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include "core/staged_loop.hpp"
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

// (1 - w) a + w b. The fused products are written out: which of the two a compiler fuses is its choice, and the offsets
// of the ties stand in every result.
Vec3 mix(double w, Vec3 a, Vec3 b) {
  return {std::fma(1 - w, a.x, w * b.x), std::fma(1 - w, a.y, w * b.y), std::fma(1 - w, a.z, w * b.z)};
}

// Ties such that a master that is itself tied comes before those that it carries.
class MastersFirst {
 public:
  explicit MastersFirst(const SweptBody& body) : body_(body), state_(body.ties.size(), State::unseen) {
    for (int t = 0; t < static_cast<int>(body.ties.size()); ++t) {
      const Tie& tie = body.ties[t];
      if (!tie_of_.emplace(std::pair{tie.slave_block, tie.slave_node}, t).second)
        throw std::logic_error("a section node is tied twice");
    }
    for (int t = 0; t < static_cast<int>(body.ties.size()); ++t) visit(t);
  }
  const std::vector<int>& order() const { return order_; }

 private:
  enum class State { unseen, open, done };
  void visit(int t) {
    if (state_[t] == State::done) return;
    if (state_[t] == State::open) throw std::logic_error("ties form a cycle");
    state_[t] = State::open;
    const Tie& tie = body_.ties[t];
    for (int node : {tie.master_node0, tie.master_node1})
      if (const auto known = tie_of_.find({tie.master_block, node}); known != tie_of_.end()) visit(known->second);
    order_.push_back(t);
    state_[t] = State::done;
  }
  const SweptBody& body_;
  std::map<std::pair<int, int>, int> tie_of_;  // (block, node) -> tie
  std::vector<State> state_;
  std::vector<int> order_;
};

}  // namespace

Ties::Ties(const SweptBody& body, const BodyLayout& layout) : layout_(layout), kind_(body.kind) {
  for (const Block& b : body.blocks) slave_.emplace_back(b.section.nodes.size(), false);
  const MastersFirst sorted(body);
  for (int t : sorted.order()) add_line(body, body.ties[t]);
  add_levels();
  int longest = 0;
  for (const BlockLayout& l : layout.blocks) longest = std::max(longest, l.stations);
#pragma omp parallel
  station_values(longest);
}

// Linear between the master block's stations around each of the slave's.
Ties::Interpolation Ties::interpolation(const SweptBody& body, int slave, int master) {
  Interpolation in;
  in.slave_block = slave;
  in.master_block = master;
  const Stations& from = body.blocks[master].stations;
  for (double t : body.blocks[slave].stations.at) {
    const StationWeights at = station_weights(from, t);
    in.left.push_back(at.left);
    in.right.push_back(at.right);
    in.weight.push_back(at.weight);
  }
  transpose(from.nodes(), in);
  return in;
}

void Ties::transpose(int master_stations, Interpolation& in) {
  const auto each_share = [&](auto&& visit) {
    for (std::size_t j = 0; j < in.left.size(); ++j) {
      if (in.weight[j] < 1) visit(in.left[j], static_cast<int>(j), 1 - in.weight[j]);
      if (in.weight[j] > 0) visit(in.right[j], static_cast<int>(j), in.weight[j]);
    }
  };
  in.first.assign(master_stations + 1, 0);
  each_share([&](int i, int, double) { ++in.first[i + 1]; });
  for (int i = 0; i < master_stations; ++i) in.first[i + 1] += in.first[i];
  in.from.resize(in.first[master_stations]);
  in.share.resize(in.first[master_stations]);
  std::vector<int> next(in.first.begin(), in.first.end() - 1);
  each_share([&](int i, int j, double share) {
    const int k = next[i]++;
    in.from[k] = j;
    in.share[k] = share;
  });
  for (int i = 0; i < master_stations; ++i) in.slots = std::max(in.slots, in.first[i + 1] - in.first[i]);
  for (int slot = 0; slot < in.slots; ++slot)
    for (int i = 0; i < master_stations; ++i) {
      const int k = in.first[i] + slot;
      const bool held = k < in.first[i + 1];
      in.slot_from.push_back(held ? in.from[k] : 0);
      in.slot_share.push_back(held ? in.share[k] : 0.0);
    }
}

int Ties::interpolation_index(const SweptBody& body, int slave_block, int master_block) {
  const auto known = std::find_if(interpolations_.begin(), interpolations_.end(), [&](const Interpolation& in) {
    return in.slave_block == slave_block && in.master_block == master_block;
  });
  if (known != interpolations_.end()) return static_cast<int>(known - interpolations_.begin());
  interpolations_.push_back(interpolation(body, slave_block, master_block));
  return static_cast<int>(interpolations_.size()) - 1;
}

void Ties::add_line(const SweptBody& body, const Tie& tie) {
  slave_[tie.slave_block][tie.slave_node] = true;
  const int index = interpolation_index(body, tie.slave_block, tie.master_block);
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

// Of every line the level that its masters' own ties leave it.
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
  for (Level& level : levels_) add_masters(level);
}

void Ties::add_masters(Level& level) const {
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

void Ties::spread_line(const Line& line, int i, const TiedField& field) const {
  const BlockLayout& from = layout_.blocks[line.master_block];
  const Interpolation& in = interpolations_[line.interpolation];
  const double* m0 = field.values.data() + from.line(line.node0, i);
  const double* m1 = field.values.data() + from.line(line.node1, i);
  double* const carried = station_values(from.stations);
  const double w = line.weight1;
  RAILSTRATA_INDEPENDENT
  for (int j = 0; j < from.stations; ++j) carried[j] = (1 - w) * m0[j] + w * m1[j];
  double* out = field.values.data() + layout_.blocks[line.slave_block].line(line.slave_node, i);
  const int *left = in.left.data(), *right = in.right.data();
  const double* weight = in.weight.data();
  const int n = static_cast<int>(in.left.size());
  RAILSTRATA_INDEPENDENT
  for (int j = 0; j < n; ++j) {
    const double a = carried[left[j]], b = carried[right[j]];
    out[j] = a + weight[j] * (b - a);
  }
  if (field.homogeneous || kind_ != SweepKind::revolve || i == 1) return;
  // (R(psi) - I) delta; psi turns z towards x
  const double* along = (i == 0 ? delta_x_ : delta_z_).data() + line.delta;
  const double* across = (i == 0 ? delta_z_ : delta_x_).data() + line.delta;
  const double c = field.turn.c - 1, s = i == 0 ? field.turn.s : -field.turn.s;
  RAILSTRATA_INDEPENDENT
  for (int j = 0; j < n; ++j) out[j] += c * along[j] + s * across[j];
}

// What a master gets of the slaves of a level.
void Ties::gather(const Level& level, const Master& master, int i, Field& f) const {
  const BlockLayout& to = layout_.blocks[master.block];
  const int stations = to.stations;
  double* const sum = f.data() + to.line(master.node, i);
  double* const gathered = station_values(stations);
  for (int s = master.first_share; s < master.first_share + master.shares; ++s) {
    const Line& line = lines_[level.shares[s].line];
    const Interpolation& in = interpolations_[line.interpolation];
    const double* slave = f.data() + layout_.blocks[line.slave_block].line(line.slave_node, i);
    std::fill_n(gathered, stations, 0.0);
    for (int slot = 0; slot < in.slots; ++slot) {
      const int* from = in.slot_from.data() + static_cast<std::ptrdiff_t>(slot) * stations;
      const double* share = in.slot_share.data() + static_cast<std::ptrdiff_t>(slot) * stations;
      RAILSTRATA_INDEPENDENT
      for (int j = 0; j < stations; ++j) gathered[j] += share[j] * slave[from[j]];
    }
    const double weight = level.shares[s].weight;
    RAILSTRATA_INDEPENDENT
    for (int j = 0; j < stations; ++j) sum[j] += weight * gathered[j];
  }
}

// What the offsets of a line of slaves hand to the body's rotation; then the slaves have no forces.
double Ties::take_moment(const Line& line, const TiedField& field) const {
  constexpr int kParts = 8;  // a fixed number, so that the sum has the same order on every machine
  const BlockLayout& lay = layout_.blocks[line.slave_block];
  double* const x = field.values.data() + lay.line(line.slave_node, 0);
  double *const y = x + lay.stride, *const z = y + lay.stride;
  const int n = lay.stations;
  double moment = 0;
  if (kind_ == SweepKind::revolve) {
    const double *dx = delta_x_.data() + line.delta, *dz = delta_z_.data() + line.delta;
    const double c = field.turn.c, s = field.turn.s;
    const auto at = [&](int j) { return x[j] * (c * dz[j] - s * dx[j]) - z[j] * (c * dx[j] + s * dz[j]); };
    double part[kParts] = {};
    const int whole = n / kParts * kParts;
    for (int j = 0; j < whole; j += kParts)
      for (int k = 0; k < kParts; ++k) part[k] += at(j + k);
    for (int j = whole; j < n; ++j) part[j - whole] += at(j);
    for (double p : part) moment += p;
  }
  for (double* values : {x, y, z}) std::fill_n(values, n, 0.0);
  return moment;
}

namespace {

constexpr int kComponents = 3;

// Items of several fields as one range: visit(field, item) of the k-th; items(field) says how many each has.
template <class Items, class Visit>
void visit_item(std::span<const TiedField> fields, std::ptrdiff_t k, Items&& items, Visit&& visit) {
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const std::ptrdiff_t n = items(f);
    if (k < n) return visit(f, k);
    k -= n;
  }
}

template <class Items>
std::ptrdiff_t all_items(std::span<const TiedField> fields, Items&& items) {
  std::ptrdiff_t sum = 0;
  for (std::size_t f = 0; f < fields.size(); ++f) sum += items(f);
  return sum;
}

int most_levels(std::span<const TiedField> fields) {
  std::size_t most = 0;
  for (const TiedField& f : fields) most = std::max(most, f.ties.levels().size());
  return static_cast<int>(most);
}

}  // namespace

void spread_ties(std::span<const TiedField> fields) {
  const auto items_at = [&](int stage) {
    return [&fields, stage](std::size_t f) {
      const auto& levels = fields[f].ties.levels();
      const auto level = static_cast<std::size_t>(stage);
      return level < levels.size() ? kComponents * static_cast<std::ptrdiff_t>(levels[level].lines.size()) : 0;
    };
  };
  for_each_in_stages(
      most_levels(fields), [&](int stage) { return all_items(fields, items_at(stage)); },
      [&](int stage, std::ptrdiff_t k) {
        visit_item(fields, k, items_at(stage), [&](std::size_t f, std::ptrdiff_t item) {
          const Ties& ties = fields[f].ties;
          const int line = ties.levels_[static_cast<std::size_t>(stage)].lines[item / kComponents];
          ties.spread_line(ties.lines_[line], static_cast<int>(item % kComponents), fields[f]);
        });
      });
}

// Masters gather level by level, the highest first; then the slaves give their moments and are cleared, all at once.
double collect_ties(std::span<const TiedField> fields) {
  thread_local std::vector<double> room;
  const int levels = most_levels(fields);
  const auto lines = [&](std::size_t f) { return static_cast<std::ptrdiff_t>(fields[f].ties.lines().size()); };
  room.assign(static_cast<std::size_t>(all_items(fields, lines)), 0.0);
  double* const moment = room.data();  // of this thread, for all of the loop's
  const auto items_at = [&](int stage) {
    return [&, stage](std::size_t f) {
      if (stage == levels) return lines(f);
      const auto& own = fields[f].ties.levels();
      const auto level = static_cast<std::size_t>(levels - 1 - stage);
      return level < own.size() ? kComponents * static_cast<std::ptrdiff_t>(own[level].masters.size()) : 0;
    };
  };
  for_each_in_stages(
      levels + 1, [&](int stage) { return all_items(fields, items_at(stage)); },
      [&](int stage, std::ptrdiff_t k) {
        visit_item(fields, k, items_at(stage), [&](std::size_t f, std::ptrdiff_t item) {
          const Ties& ties = fields[f].ties;
          if (stage == levels) {
            moment[k] = ties.take_moment(ties.lines_[item], fields[f]);
            return;
          }
          const Ties::Level& level = ties.levels_[static_cast<std::size_t>(levels - 1 - stage)];
          ties.gather(level, level.masters[item / kComponents], static_cast<int>(item % kComponents), fields[f].values);
        });
      });
  return std::accumulate(room.begin(), room.end(), 0.0);
}

void Ties::apply(Field& u, double psi) const {
  const TiedField field{*this, u, rotation_by(psi)};
  spread_ties({&field, 1});
}

void Ties::apply_homogeneous(Field& u) const {
  const TiedField field{*this, u, {}, true};
  spread_ties({&field, 1});
}

void Ties::apply_transpose(Field& f) const { apply_transpose_turned(f, 0); }

double Ties::apply_transpose_turned(Field& f, double psi) const {
  const TiedField field{*this, f, rotation_by(psi)};
  return collect_ties({&field, 1});
}

}  // namespace railstrata
