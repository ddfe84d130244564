#include "body/mass_scaling.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "core/parallel.hpp"

namespace railstrata {
namespace {

constexpr double kMassSlack =
    1.2;  // rows that miss the wanted step by less are left alone: an unlayered mesh stays as it is
constexpr double kThin =
    0.85;  // of an element's width: what is higher has modes along the row that are as fast as those across it

constexpr int kNone = -1, kInside = -2;

double edge_length(const Section& s, int a, int b) { return norm(s.nodes[a] - s.nodes[b]); }

}  // namespace

// Added mass of all edges across thin rows of a block.
MassScaling::Edges MassScaling::thin_edges(const SweptBody& body, int block, const std::vector<Elastic>& materials,
                                           double wanted_step) {
  const Block& b = body.blocks[block];
  const Section& s = b.section;
  const int elements = b.stations.elements(), stations = b.stations.nodes();
  Edges edges;
  for (std::size_t q = 0; q < s.quads.size(); ++q) {
    const auto& k = s.quads[q];
    const double area = quad_area(s, k);
    for (int side : {0, 1}) {  // edges (side, side + 1) and the one opposite run across the row
      const double width =
          0.5 * (edge_length(s, k[side + 1], k[(side + 2) % 4]) + edge_length(s, k[(side + 3) % 4], k[side]));
      const double height = area / width;
      if (height > kThin * width) continue;
      const std::array<Vec2, 4> corners = quad_corners(s, static_cast<int>(q));
      for (int e = 0; e < elements; ++e) {
        const Elastic& m = materials[b.material(static_cast<int>(q), e)];
        const double excess = std::pow(wanted_step / height, 2) * m.p_wave_modulus() / m.density - 1;
        if (excess < kMassSlack * kMassSlack - 1) continue;
        const double spacing = b.stations.end(e) - b.stations.at[e];
        const auto mass = corner_masses(body.kind, corners, sweep_scale(body.kind, spacing), m.density);
        for (const auto& [i, j] : {std::pair{side, side + 1}, std::pair{side + 2, (side + 3) % 4}}) {
          Edge& edge = edges[std::minmax(k[i], k[j])];
          edge.added.resize(stations, 0.0);
          const double a = 0.25 * (mass[i] + mass[j]) * excess;
          edge.added[e] += a;
          edge.added[e + 1 < stations ? e + 1 : 0] += a;
          edge.total += 2 * a;
        }
      }
    }
  }
  return edges;
}

// Paths along the edges; where edges branch or close a loop the stiffest are followed.
std::vector<std::vector<int>> MassScaling::paths(const Edges& edges, int nodes) {
  std::vector<std::pair<int, int>> order;
  for (const auto& [ends, edge] : edges) order.push_back(ends);
  std::stable_sort(order.begin(), order.end(), [&](auto& a, auto& b) { return edges.at(a).total > edges.at(b).total; });
  std::vector<std::vector<int>> next(nodes);
  std::vector<int> root(nodes);
  std::iota(root.begin(), root.end(), 0);
  auto find = [&](int n) {
    while (root[n] != n) n = root[n];
    return n;
  };
  for (const auto& [a, b] : order) {
    if (next[a].size() > 1 || next[b].size() > 1 || find(a) == find(b)) continue;
    next[a].push_back(b);
    next[b].push_back(a);
    root[find(a)] = find(b);
  }
  std::vector<std::vector<int>> out;
  std::vector<bool> seen(nodes, false);
  for (int start = 0; start < nodes; ++start) {
    if (seen[start] || next[start].size() != 1) continue;
    std::vector<int> path;
    for (int n = start;;) {
      path.push_back(n);
      seen[n] = true;
      const auto on = std::find_if(next[n].begin(), next[n].end(), [&](int m) { return !seen[m]; });
      if (on == next[n].end()) break;
      n = *on;
    }
    out.push_back(std::move(path));
  }
  return out;
}

MassScaling::MassScaling(const Body& body, double wanted_step) : layout_(body.layout) {
  const SweptBody& mesh = body.mesh;
  for (int b = 0; b < static_cast<int>(mesh.blocks.size()); ++b) {
    const BlockLayout& lay = layout_.blocks[b];
    chain_of_.emplace_back(lay.nodes, kNone);
    Edges edges = thin_edges(mesh, b, body.materials, wanted_step);
    const auto is_free = [&](int node) { return body.inverse_mass[lay.line(node, 0)] > 0; };
    std::erase_if(edges, [&](const auto& edge) { return !is_free(edge.first.first) || !is_free(edge.first.second); });
    for (auto& [ends, edge] : edges)
      for (int j = 0; j < lay.stations; ++j) {
        // a node that carries slaves is heavier than its own elements, and so is what its edges need
        const auto share = [&](int node) {
          return body.mass[lay.line(node, 0) + j] / body.element_mass[lay.line(node, 0) + j];
        };
        edge.added[j] *= std::max(share(ends.first), share(ends.second));
      }
    for (const std::vector<int>& path : paths(edges, lay.nodes)) add_chain(b, path, edges, body.mass);
  }
}

// M (M + A)^-1 of a chain by elimination from its top, k = 0, 1, …: with the pivots
//   p_0 = m_0 + a_0,   r_k = p_k - a_k,   p_k = m_k + a_(k-1) r_(k-1)/p_(k-1) + a_k
// (the same as m_k + a_(k-1) + a_k - a_(k-1)^2/p_(k-1), without the difference) the sweeps of `scale` are
//   f_k <- f_k + a_(k-1)/p_(k-1) f_(k-1) down,   f_k <- m_k/p_k f_k + a_k/p_k m_k/m_(k+1) f_(k+1) up.
void MassScaling::add_chain(int block, const std::vector<int>& nodes, const Edges& edges, const Field& body_mass) {
  const BlockLayout& lay = layout_.blocks[block];
  const auto stations = static_cast<std::size_t>(lay.stations);
  const Chain chain{block, lay.stations, nodes, static_cast<std::ptrdiff_t>(added_.size())};
  const std::size_t n = nodes.size();
  for (Field* f : {&added_, &forward_, &pivot_, &backward_, &response_}) f->resize(f->size() + n * stations, 0.0);
  for (std::size_t j = 0; j < stations; ++j) {
    const auto at = [&](std::size_t k) { return chain.factor + static_cast<std::ptrdiff_t>(k * stations + j); };
    const auto mass = [&](std::size_t k) { return body_mass[lay.line(nodes[k], 0) + static_cast<std::ptrdiff_t>(j)]; };
    double rest = mass(0);  // of the pivot without the edge onwards; written so that nothing cancels
    for (std::size_t k = 0; k < n; ++k) {
      const bool last = k + 1 == n;
      const double a = last ? 0 : edges.at(std::minmax(nodes[k], nodes[k + 1])).added[j], pivot = rest + a;
      added_[at(k)] = a;
      report_.added_mass += a;
      report_.added_in_block[block] += a;
      forward_[at(k)] = a / pivot;
      pivot_[at(k)] = mass(k) / pivot;
      if (last) break;
      backward_[at(k)] = a / pivot * mass(k) / mass(k + 1);
      rest = mass(k + 1) + a * rest / pivot;
    }
    double y = 1;
    for (std::size_t k = 0; k < n; ++k) {
      response_[at(k)] = pivot_[at(k)] * y;
      y *= forward_[at(k)];
    }
    for (std::size_t k = n - 1; k-- > 0;) response_[at(k)] += backward_[at(k)] * response_[at(k + 1)];
    for (std::size_t k = 0; k < n; ++k) report_.scaled_mass += mass(k);
  }
  for (int node : nodes) chain_of_[block][node] = kInside;
  chain_of_[block][nodes.front()] = static_cast<int>(chains_.size());
  chains_.push_back(chain);
}

bool MassScaling::acts_on(int block, int node) const { return !empty() && chain_of_[block][node] != kNone; }

void MassScaling::scale(Field& f) const {
  assert(f.size() >= static_cast<std::size_t>(layout_.size));
  for_each(static_cast<std::ptrdiff_t>(chains_.size()) * 3, [&](std::ptrdiff_t task) {
    const Chain& chain = chains_[task / 3];
    const BlockLayout& lay = layout_.blocks[chain.block];
    const int component = static_cast<int>(task % 3), last = static_cast<int>(chain.nodes.size()) - 1,
              stations = chain.stations;
    const auto line = [&](int k) { return f.data() + lay.line(chain.nodes[k], component); };
    const auto factor = [&](const Field& of, int k) {
      return of.data() + chain.factor + static_cast<std::ptrdiff_t>(k) * stations;
    };
    for (int k = 0; k < last; ++k) {
      const double *g = factor(forward_, k), *y = line(k);
      double* below = line(k + 1);
      for (int j = 0; j < stations; ++j) below[j] += g[j] * y[j];
    }
    const double* p = factor(pivot_, last);
    for (double* x = line(last); x != line(last) + stations; ++x, ++p) *x *= *p;
    for (int k = last - 1; k >= 0; --k) {
      const double *pivot = factor(pivot_, k), *b = factor(backward_, k), *below = line(k + 1);
      double* x = line(k);
      for (int j = 0; j < stations; ++j) x[j] = pivot[j] * x[j] + b[j] * below[j];
    }
  });
}

const MassScaling::Chain* MassScaling::chain_at(std::ptrdiff_t index, int& component, int& station) const {
  if (empty()) return nullptr;
  std::size_t b = layout_.blocks.size() - 1;
  while (index < layout_.blocks[b].offset) --b;
  const BlockLayout& lay = layout_.blocks[b];
  const std::ptrdiff_t line = (index - lay.offset) / lay.stride;
  component = static_cast<int>(line % 3);
  station = static_cast<int>((index - lay.offset) % lay.stride);
  const int chain = chain_of_[b][static_cast<std::size_t>(line / 3)];
  assert(chain != kInside);
  return chain >= 0 ? &chains_[static_cast<std::size_t>(chain)] : nullptr;
}

void MassScaling::add_force(Field& f, std::ptrdiff_t index, double force) const {
  int component = 0, station = 0;
  const Chain* chain = chain_at(index, component, station);
  if (!chain) {
    f[index] += force;
    return;
  }
  const double* r = response_.data() + chain->factor + station;
  for (int node : chain->nodes) {
    f[layout_.blocks[chain->block].line(node, component) + station] += *r * force;
    r += chain->stations;
  }
}

double MassScaling::share(std::ptrdiff_t index) const {
  int component = 0, station = 0;
  const Chain* chain = chain_at(index, component, station);
  return chain ? response_[chain->factor + station] : 1.0;
}

template <class Visit>
void MassScaling::each_edge(Visit&& visit) const {
  for_each(static_cast<std::ptrdiff_t>(chains_.size()) * 3, [&](std::ptrdiff_t task) {
    const Chain& chain = chains_[task / 3];
    const BlockLayout& lay = layout_.blocks[chain.block];
    const int component = static_cast<int>(task % 3);
    for (std::size_t k = 0; k + 1 < chain.nodes.size(); ++k)
      visit(task, chain.factor + static_cast<std::ptrdiff_t>(k) * chain.stations, lay.line(chain.nodes[k], component),
            lay.line(chain.nodes[k + 1], component), chain.stations);
  });
}

Field MassScaling::differences(const Field& v, Field reuse) const {
  assert(v.size() >= static_cast<std::size_t>(layout_.size));
  Field out = std::move(reuse);
  out.assign(3 * added_.size(), 0.0);
  each_edge([&](std::ptrdiff_t task, std::ptrdiff_t factor, std::ptrdiff_t here, std::ptrdiff_t below, int stations) {
    double* d = out.data() + 3 * factor + task % 3 * stations;
    for (int j = 0; j < stations; ++j) d[j] = v[here + j] - v[below + j];
  });
  return out;
}

double MassScaling::kinetic(const Field& differences_of_v, const Field& w) {
  assert(differences_of_v.size() == 3 * added_.size() && w.size() >= static_cast<std::size_t>(layout_.size));
  std::vector<double>& part = chain_energy_;
  part.assign(3 * chains_.size(), 0.0);
  each_edge([&](std::ptrdiff_t task, std::ptrdiff_t factor, std::ptrdiff_t here, std::ptrdiff_t below, int stations) {
    const double* d = differences_of_v.data() + 3 * factor + task % 3 * stations;
    for (int j = 0; j < stations; ++j) part[task] += 0.5 * added_[factor + j] * d[j] * (w[here + j] - w[below + j]);
  });
  return std::accumulate(part.begin(), part.end(), 0.0);
}

}  // namespace railstrata
