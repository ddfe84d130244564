#include "body/ties.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>

#include "core/parallel.hpp"

namespace railstrata {

Ties::Ties(const SweptBody& body, const BodyLayout& layout) : layout_(layout), kind_(body.kind) {
  for (const Block& b : body.blocks) slave_.emplace_back(b.section.nodes.size(), false);
  std::map<std::pair<int, int>, int> tie_of;  // (block, node) -> tie
  for (int t = 0; t < static_cast<int>(body.ties.size()); ++t) {
    const Tie& tie = body.ties[t];
    if (!tie_of.emplace(std::pair{tie.slave_block, tie.slave_node}, t).second)
      throw std::logic_error("a section node is tied twice");
    slave_[tie.slave_block][tie.slave_node] = true;
  }

  std::map<std::pair<int, int>, int> interpolation_of;
  auto interpolation = [&](int slave, int master) {
    const auto [known, added] =
        interpolation_of.emplace(std::pair{slave, master}, static_cast<int>(interpolations_.size()));
    if (!added) return known->second;
    Interpolation in{slave, master, {}, {}, {}, {}, {}, {}};
    const Stations& from = body.blocks[master].stations;
    const double period = 2 * std::numbers::pi;
    const int n = from.nodes();
    for (double t : body.blocks[slave].stations.at) {
      if (from.closed) {  // into [first, first + period)
        t = from.at.front() + std::fmod(t - from.at.front(), period);
        if (t < from.at.front()) t += period;
      }
      int left = static_cast<int>(std::upper_bound(from.at.begin(), from.at.end(), t) - from.at.begin()) - 1;
      if (!from.closed) left = std::clamp(left, 0, n - 2);
      const int right = left + 1 < n ? left + 1 : 0;
      const double t1 = right > left ? from.at[right] : from.at[0] + period;
      in.left.push_back(left);
      in.right.push_back(right);
      in.weight.push_back(std::clamp((t - from.at[left]) / (t1 - from.at[left]), 0.0, 1.0));
    }
    in.first.assign(n + 1, 0);
    auto each_share = [&](auto&& give) {
      for (std::size_t j = 0; j < in.left.size(); ++j) {
        if (in.weight[j] < 1) give(in.left[j], static_cast<int>(j), 1 - in.weight[j]);
        if (in.weight[j] > 0) give(in.right[j], static_cast<int>(j), in.weight[j]);
      }
    };
    each_share([&](int i, int, double) { ++in.first[i + 1]; });
    for (int i = 0; i < n; ++i) in.first[i + 1] += in.first[i];
    in.from.resize(in.first[n]);
    in.share.resize(in.first[n]);
    std::vector<int> next(in.first.begin(), in.first.end() - 1);
    each_share([&](int i, int j, double share) { in.from[next[i]] = j, in.share[next[i]++] = share; });
    interpolations_.push_back(std::move(in));
    return known->second;
  };

  std::vector<int> state(body.ties.size(), 0);
  std::function<void(int)> visit = [&](int t) {
    if (state[t] == 2) return;
    if (state[t] == 1) throw std::logic_error("ties form a cycle");
    state[t] = 1;
    const Tie& tie = body.ties[t];
    for (int node : {tie.master_node0, tie.master_node1})
      if (const auto known = tie_of.find({tie.master_block, node}); known != tie_of.end()) visit(known->second);
    Line line{tie.slave_block,
              tie.slave_node,
              tie.master_block,
              tie.master_node0,
              tie.master_node1,
              tie.weight1,
              interpolation(tie.slave_block, tie.master_block),
              0};
    line.delta = static_cast<std::ptrdiff_t>(delta_x_.size());
    const Interpolation& in = interpolations_[line.interpolation];
    const Block& slave = body.blocks[tie.slave_block];
    const Block& master = body.blocks[tie.master_block];
    for (std::size_t j = 0; j < in.left.size(); ++j) {
      auto at = [&](int node, int station) {
        return swept_point(body.kind, {}, master.section.nodes[node], master.stations.at[station]);
      };
      auto between = [&](int node) {
        return (1 - in.weight[j]) * at(node, in.left[j]) + in.weight[j] * at(node, in.right[j]);
      };
      const Vec3 carried = (1 - tie.weight1) * between(tie.master_node0) + tie.weight1 * between(tie.master_node1);
      const Vec3 delta =
          swept_point(body.kind, {}, slave.section.nodes[tie.slave_node], slave.stations.at[j]) - carried;
      delta_x_.push_back(delta.x);
      delta_y_.push_back(delta.y);
      delta_z_.push_back(delta.z);
    }
    lines_.push_back(line);
    state[t] = 2;
  };
  for (int t = 0; t < static_cast<int>(body.ties.size()); ++t) visit(t);
}

void Ties::spread_component(Field& u, int i, double cos_psi, double sin_psi, bool homogeneous) const {
  std::vector<double>& carried = carried_[i];
  const bool turning = !homogeneous && kind_ == SweepKind::revolve && i != 1;
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

double Ties::collect_component(Field& f, int i, double cos_psi, double sin_psi) const {
  const bool turning = kind_ == SweepKind::revolve && i != 1;
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

void Ties::spread(Field& u, double psi, bool homogeneous) const {
  const double c = std::cos(psi), s = std::sin(psi);
  for_each(
      3, [&](std::ptrdiff_t i) { spread_component(u, static_cast<int>(i), c, s, homogeneous); }, true);
}

void Ties::collect(Field& f) const { collect_turning(f, 0); }

double Ties::collect_turning(Field& f, double psi) const {
  const double c = std::cos(psi), s = std::sin(psi);
  double moment[3];
  for_each(
      3, [&](std::ptrdiff_t i) { moment[i] = collect_component(f, static_cast<int>(i), c, s); }, true);
  return moment[0] + moment[1] + moment[2];
}

}  // namespace railstrata
