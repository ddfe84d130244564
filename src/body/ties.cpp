#include "body/ties.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "core/parallel.hpp"
#include "mesh/station_weights.hpp"

namespace railstrata {
namespace {

// Values of a line's masters at their stations; of each thread.
std::vector<double>& master_values() {
  thread_local std::vector<double> values;
  return values;
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
  std::size_t longest = 0;
  for (const BlockLayout& l : layout.blocks) longest = std::max(longest, static_cast<std::size_t>(l.stations));
#pragma omp parallel
  master_values().reserve(longest);
}

// Linear between the master block's stations around each of the slave's.
Ties::Interpolation Ties::interpolation(const SweptBody& body, int slave, int master) {
  Interpolation in{slave, master, {}, {}, {}, {}, {}, {}};
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

void Ties::apply_component(Field& u, int i, Rotation<double> turn, bool homogeneous) const {
  std::vector<double>& carried = master_values();
  const bool turning = !homogeneous && kind_ == SweepKind::revolve && i != 1;
  const double cos_psi = turn.c, sin_psi = turn.s;
  for (const Line& line : lines_) {
    const BlockLayout& from = layout_.blocks[line.master_block];
    const double* m0 = u.data() + from.line(line.node0, i);
    const double* m1 = u.data() + from.line(line.node1, i);
    carried.resize(from.stations);
    for (int j = 0; j < from.stations; ++j) carried[j] = (1 - line.weight1) * m0[j] + line.weight1 * m1[j];
    const Interpolation& in = interpolations_[line.interpolation];
    double* out = u.data() + layout_.blocks[line.slave_block].line(line.slave_node, i);
    const int n = static_cast<int>(in.left.size());
    for (int j = 0; j < n; ++j)
      out[j] = carried[in.left[j]] + in.weight[j] * (carried[in.right[j]] - carried[in.left[j]]);
    if (turning) {  // (R(psi) - I) delta; psi turns z towards x
      const double* dx = delta_x_.data() + line.delta;
      const double* dz = delta_z_.data() + line.delta;
      if (i == 0)
        for (int j = 0; j < n; ++j) out[j] += (cos_psi - 1) * dx[j] + sin_psi * dz[j];
      else
        for (int j = 0; j < n; ++j) out[j] += (cos_psi - 1) * dz[j] - sin_psi * dx[j];
    }
  }
}

double Ties::apply_transpose_component(Field& f, int i, Rotation<double> turn) const {
  const bool turning = kind_ == SweepKind::revolve && i != 1;
  const double cos_psi = turn.c, sin_psi = turn.s;
  double moment = 0;
  for (auto line = lines_.rbegin(); line != lines_.rend(); ++line) {
    const BlockLayout& to = layout_.blocks[line->master_block];
    const Interpolation& in = interpolations_[line->interpolation];
    double* out = f.data() + layout_.blocks[line->slave_block].line(line->slave_node, i);
    const int n = static_cast<int>(in.left.size());
    if (turning) {
      const double* dx = delta_x_.data() + line->delta;
      const double* dz = delta_z_.data() + line->delta;
      if (i == 0)
        for (int j = 0; j < n; ++j) moment += out[j] * (cos_psi * dz[j] - sin_psi * dx[j]);
      else
        for (int j = 0; j < n; ++j) moment -= out[j] * (cos_psi * dx[j] + sin_psi * dz[j]);
    }
    double* m0 = f.data() + to.line(line->node0, i);
    double* m1 = f.data() + to.line(line->node1, i);
    for (int j = 0; j < to.stations; ++j) {
      double gathered = 0;
      for (int k = in.first[j]; k < in.first[j + 1]; ++k) gathered += in.share[k] * out[in.from[k]];
      m0[j] += (1 - line->weight1) * gathered;
      m1[j] += line->weight1 * gathered;
    }
    std::fill(out, out + n, 0.0);
  }
  return moment;
}

void Ties::apply(Field& u, double psi) const {
  const Rotation<double> turn = rotation_by(psi);
  for_each(3, [&](std::ptrdiff_t i) { apply_component(u, static_cast<int>(i), turn, false); });
}

void Ties::apply_homogeneous(Field& u) const {
  for_each(3, [&](std::ptrdiff_t i) { apply_component(u, static_cast<int>(i), {}, true); });
}

void Ties::apply_transpose(Field& f) const { apply_transpose_turned(f, 0); }

double Ties::apply_transpose_turned(Field& f, double psi) const {
  const Rotation<double> turn = rotation_by(psi);
  double moment[3];
  for_each(3, [&](std::ptrdiff_t i) { moment[i] = apply_transpose_component(f, static_cast<int>(i), turn); });
  return moment[0] + moment[1] + moment[2];
}

}  // namespace railstrata
