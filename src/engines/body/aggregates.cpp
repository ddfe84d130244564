#include "body/aggregates.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <map>

#include "core/parallel.hpp"

namespace railstrata {
namespace {

constexpr double kAtContact = 24e-3;  // m, largest edge of a cluster at the contact point
constexpr double kGrowth = 0.2;       // added per metre of distance from it
constexpr double kDependent = 1e-6;   // of the largest eigenvalue of a cluster's Gram matrix
constexpr double kOnePoint = 1e-12;   // m²

using Modes = Eigen::Matrix<double, 3, 6>;

}  // namespace

Aggregates::Aggregates(const Body& body, Vec2 contact)
    : body_(body), cut_(body.mesh.blocks.size()), arm_(body.layout.field()) {
  const SweptBody& mesh = body.mesh;
  std::vector<std::vector<int>> free(cut_.size());
  for (const NodeLine& l : body.lines)
    if (l.component == 0) free[l.block].push_back(l.node);
  const double radius = mesh.kind == SweepKind::revolve ? std::abs(contact.z) : 1.0;
  for (int b = 0; b < static_cast<int>(cut_.size()); ++b) {
    cut_[b].section_of.assign(mesh.blocks[b].section.nodes.size(), -1);
    cut_section(b, free[b], contact);
    cut_stations(b, radius);
    cut_[b].first_cluster = clusters();
    for (int s = 0; s < static_cast<int>(cut_[b].section.size()); ++s)
      for (int g = 0; g + 1 < static_cast<int>(cut_[b].group_first.size()); ++g) add_cluster(b, s, g);
  }
  parts_of_.resize(cluster_.size());
  for (int t = 0; t < static_cast<int>(body_.tiling.tiles.size()); ++t) {
    const int block = body_.tiling.tiles[t].block;
    const StationRange own = own_stations(body_, t);
    for (int i = 0; i < clusters(); ++i) {
      const Cluster& c = cluster_[i];
      const int first = std::max(own.begin, c.first_station), end = std::min(own.end, c.first_station + c.stations);
      if (c.block != block || first >= end) continue;
      parts_of_[i].push_back(parts());
      part_.push_back({i, t, first, end});
    }
  }
}

// Halves the nodes along the longer side until they fit.
void Aggregates::cut_section(int block, std::vector<int> nodes, Vec2 contact) {
  if (nodes.empty()) return;
  const auto& at = body_.mesh.blocks[block].section.nodes;
  Vec2 low = at[nodes[0]], high = low;
  double distance = norm(low - contact);
  for (int n : nodes) {
    low = {std::min(low.y, at[n].y), std::min(low.z, at[n].z)};
    high = {std::max(high.y, at[n].y), std::max(high.z, at[n].z)};
    distance = std::min(distance, norm(at[n] - contact));
  }
  const Vec2 extent = high - low;
  if (std::max(extent.y, extent.z) <= kAtContact + kGrowth * distance) {
    for (int n : nodes) cut_[block].section_of[n] = static_cast<int>(cut_[block].section.size());
    cut_[block].section.push_back(std::move(nodes));
    return;
  }
  const bool lateral = extent.y >= extent.z;
  const double middle = lateral ? 0.5 * (low.y + high.y) : 0.5 * (low.z + high.z);
  const auto upper =
      std::stable_partition(nodes.begin(), nodes.end(), [&](int n) { return (lateral ? at[n].y : at[n].z) < middle; });
  cut_section(block, {nodes.begin(), upper}, contact);
  cut_section(block, {upper, nodes.end()}, contact);
}

void Aggregates::cut_stations(int block, double radius) {
  const std::vector<double>& at = body_.mesh.blocks[block].stations.at;
  BlockCut& cut = cut_[block];
  // from the station under the contact to both ends
  const int n = static_cast<int>(at.size());
  auto distance = [&](int j) {
    const double t = at[j] - body_.mesh.contact_at;
    return radius * std::abs(body_.mesh.kind == SweepKind::revolve ? std::remainder(t, 2 * std::acos(-1.0)) : t);
  };
  cut.group_of.resize(n);
  cut.group_first.clear();
  int first = 0;
  double nearest = distance(0);
  for (int j = 0; j < n; ++j) {
    const double near = std::min(nearest, distance(j));
    if (j == first || radius * (at[j] - at[first]) > kAtContact + kGrowth * near) {
      first = j;
      nearest = distance(j);
      cut.group_first.push_back(j);
    } else {
      nearest = near;
    }
    cut.group_of[j] = static_cast<int>(cut.group_first.size()) - 1;
  }
  cut.group_first.push_back(n);
}

Modes Aggregates::rigid_modes(const Cluster& c, int node, int station) const {
  const Vec3 r = (1 / c.length) * arm(body_.layout.blocks[c.block], node, station);
  Modes m;
  m << 1, 0, 0, 0, r.z, -r.y,  //
      0, 1, 0, -r.z, 0, r.x,   //
      0, 0, 1, r.y, -r.x, 0;
  return m;
}

void Aggregates::add_cluster(int block, int section, int group) {
  const BlockCut& cut = cut_[block];
  const int first = cut.group_first[group], count = cut.group_first[group + 1] - first;
  Cluster c{block, section, first, count, modes_, 0, {}, 1.0, Eigen::Matrix<double, 6, 6>::Zero()};
  const std::vector<int>& nodes = cut.section[section];
  auto visit = [&](auto&& work) {
    for (int n : nodes)
      for (int j = first; j < first + count; ++j) work(n, j);
  };
  visit([&](int n, int j) { c.centre += reference_position(body_, block, n, j); });
  c.centre = (1.0 / static_cast<double>(nodes.size() * count)) * c.centre;
  double radius2 = 0;
  const BlockLayout& lay = body_.layout.blocks[block];
  visit([&](int n, int j) {
    const Vec3 r = reference_position(body_, block, n, j) - c.centre;
    double* a = arm_.data() + lay.line(n, 0) + j;
    a[0] = r.x;
    a[lay.stride] = r.y;
    a[2 * lay.stride] = r.z;
    radius2 = std::max(radius2, dot(r, r));
  });
  if (radius2 > kOnePoint) c.length = std::sqrt(radius2);
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  visit([&](int n, int j) {
    const Modes m = rigid_modes(c, n, j);
    gram += m.transpose() * m;
  });
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(gram);
  for (int k = 0; k < 6; ++k)
    if (eigen.eigenvalues()[k] > kDependent * eigen.eigenvalues()[5])
      c.basis.col(c.count++) = eigen.eigenvectors().col(k) / std::sqrt(eigen.eigenvalues()[k]);
  modes_ += c.count;
  cluster_.push_back(c);
}

int Aggregates::cluster_of(int block, int node, int station) const {
  const BlockCut& cut = cut_[block];
  const int section = cut.section_of[node];
  return section < 0
             ? -1
             : cut.first_cluster + section * (static_cast<int>(cut.group_first.size()) - 1) + cut.group_of[station];
}

void Aggregates::restrict_parts(const Field& f, int begin, int end, double* forces) const {
  assert(0 <= begin && begin <= end && end <= parts() && f.size() >= static_cast<std::size_t>(body_.layout.size));
  for_each(
      end - begin,
      [&](std::ptrdiff_t k) {
        const Part& part = part_[begin + k];
        const Cluster& c = cluster_[part.cluster];
        const BlockLayout& l = body_.layout.blocks[c.block];
        Vec3 force, moment;
        for (int n : cut_[c.block].section[c.section]) {
          const double* x = f.data() + l.line(n, 0);
          for (int j = part.first; j < part.end; ++j) {
            const Vec3 v{x[j], x[j + l.stride], x[j + 2 * l.stride]};
            force += v;
            moment += cross(arm(l, n, j), v);
          }
        }
        const double numbers[kPartNumbers] = {force.x, force.y, force.z, moment.x, moment.y, moment.z};
        std::copy_n(numbers, kPartNumbers, forces + kPartNumbers * (begin + k));
      },
      true);
}

void Aggregates::gather_parts(const double* forces, double* out) const {
  for_each(clusters(), [&](std::ptrdiff_t i) {
    const Cluster& c = cluster_[i];
    Eigen::Matrix<double, kPartNumbers, 1> all = decltype(all)::Zero();
    for (int p : parts_of_[i])
      for (int k = 0; k < kPartNumbers; ++k) all[k] += forces[kPartNumbers * p + k];
    for (int k = 3; k < kPartNumbers; ++k) all[k] /= c.length;
    Eigen::Map<Eigen::VectorXd>(out + c.first_mode, c.count) = c.basis.leftCols(c.count).transpose() * all;
  });
}

void Aggregates::prolong(const double* coefficients, Field& u, const KeptValues& kept) const {
  assert(u.size() >= static_cast<std::size_t>(body_.layout.size));
  const BodyLayout& lay = body_.layout;
  for_each(
      clusters(),
      [&](std::ptrdiff_t i) {
        const Cluster& c = cluster_[i];
        const BlockLayout& l = lay.blocks[c.block];
        const Eigen::Matrix<double, 6, 1> all =
            c.basis.leftCols(c.count) * Eigen::Map<const Eigen::VectorXd>(coefficients + c.first_mode, c.count);
        const Vec3 shift{all[0], all[1], all[2]}, turn = (1 / c.length) * Vec3{all[3], all[4], all[5]};
        const auto move = [&](int node, int begin, int end) {
          double* x = u.data() + l.line(node, 0);
          for (int j = begin; j < end; ++j) {
            const Vec3 v = shift + cross(turn, arm(l, node, j));
            x[j] += v.x;
            x[j + l.stride] += v.y;
            x[j + 2 * l.stride] += v.z;
          }
        };
        const int first = c.first_station, last = c.first_station + c.stations;
        for (int n : cut_[c.block].section[c.section]) {
          if (kept.line[c.block][n]) {
            move(n, first, last);
            continue;
          }
          for (const StationRange& run : kept.runs[c.block])
            move(n, std::max(first, run.begin), std::min(last, run.end));
        }
      },
      true);
}

Eigen::Matrix<double, 6, 1> Aggregates::modes_at(int block, int node, int station, int component) const {
  const Cluster& c = cluster_[cluster_of(block, node, station)];
  return (rigid_modes(c, node, station).row(component) * c.basis).transpose();
}

std::vector<std::vector<int>> Aggregates::neighbours() const {
  const SweptBody& mesh = body_.mesh;
  std::map<std::pair<int, int>, const Tie*> tie_of;
  for (const Tie& t : mesh.ties) tie_of[{t.slave_block, t.slave_node}] = &t;
  constexpr int kHeld = -1;
  // Clusters that carry a node; a slave's are those of its masters at the stations on either side.
  std::function<void(int, int, int, std::vector<int>&)> carriers = [&](int block, int node, int station,
                                                                       std::vector<int>& out) {
    if (!body_.ties.is_slave(block, node)) {
      out.push_back(cluster_of(block, node, station));
      return;
    }
    const Tie& t = *tie_of.at({block, node});
    const Stations& from = mesh.blocks[t.master_block].stations;
    double at = mesh.blocks[block].stations.at[station];
    if (from.closed) {
      const double period = 2 * std::acos(-1.0);
      at -= period * std::floor((at - from.at.front()) / period);
    }
    const int left =
        std::clamp(static_cast<int>(std::upper_bound(from.at.begin(), from.at.end(), at) - from.at.begin()) - 1, 0,
                   from.nodes() - 1);
    for (int k : {left - 1, left, left + 1}) {  // one more than needed: rounding may choose either side
      const int j = from.closed ? (k + from.nodes()) % from.nodes() : std::clamp(k, 0, from.nodes() - 1);
      carriers(t.master_block, t.master_node0, j, out);
      carriers(t.master_block, t.master_node1, j, out);
    }
  };
  std::vector<std::vector<int>> out(clusters());
  std::vector<int> touched;
  for (int b = 0; b < static_cast<int>(mesh.blocks.size()); ++b) {
    const Block& block = mesh.blocks[b];
    for (const auto& quad : block.section.quads)
      for (int e = 0; e < block.stations.elements(); ++e) {
        touched.clear();
        for (int j : {e, e + 1 < block.stations.nodes() ? e + 1 : 0})
          for (int n : quad) carriers(b, n, j, touched);
        std::sort(touched.begin(), touched.end());
        touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
        std::erase(touched, kHeld);
        for (int a : touched)
          for (int other : touched) {
            const auto place = std::lower_bound(out[a].begin(), out[a].end(), other);
            if (place == out[a].end() || *place != other) out[a].insert(place, other);
          }
      }
  }
  return out;
}

}  // namespace railstrata
