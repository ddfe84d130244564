#include "body/local_steps.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.hpp"

namespace railstrata {
namespace {

constexpr double kStepSlack = 1.2;  // elements that miss the wanted step by less are left alone, as with mass scaling
constexpr double kMargin = 1.02;    // of the stages' reach over the Ritz value of omega_max

using NodeSets = std::vector<std::vector<bool>>;  // per block and section node

NodeSets no_nodes(const SweptBody& body) {
  NodeSets out;
  for (const Block& b : body.blocks) out.emplace_back(b.section.nodes.size(), false);
  return out;
}

// Takes the masters of the slaves in a set into it; false if they were all there.
bool add_masters(const SweptBody& body, NodeSets& set) {
  bool added = false;
  for (const Tie& t : body.ties)
    if (set[t.slave_block][t.slave_node])
      for (int n : {t.master_node0, t.master_node1})
        if (!set[t.master_block][n]) added = set[t.master_block][n] = true;
  return added;
}

double shortest_spacing(const SweptBody& body, const Block& b, double radius) {
  double least = HUGE_VAL;
  for (int e = 0; e + 1 < b.stations.nodes(); ++e) least = std::min(least, b.stations.at[e + 1] - b.stations.at[e]);
  return body.kind == SweepKind::revolve ? radius * least : least;
}

double wave_speed(const Block& block, int quad, const std::vector<Elastic>& materials) {
  double fastest = 0;
  for (int set = 0; set < block.sets(); ++set) {
    const Elastic& m = materials[block.material_of_set(set, quad)];
    fastest = std::max(fastest, std::sqrt(m.p_wave_modulus() / m.density));
  }
  return fastest;
}

// Nodes of quadrilaterals that a pressure wave crosses in less than `step` over the slack, and the masters of those
// that are carried.
NodeSets fast_nodes(const SweptBody& body, const std::vector<Elastic>& materials, double step) {
  NodeSets out = no_nodes(body);
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const Section& s = body.blocks[b].section;
    for (std::size_t q = 0; q < s.quads.size(); ++q) {
      const auto& k = s.quads[q];
      const auto edge = [&](int side) { return norm(s.nodes[k[(side + 1) % 4]] - s.nodes[k[side]]); };
      const double area = quad_area(s, k);
      const double across = area / std::max(0.5 * (edge(0) + edge(2)), 0.5 * (edge(1) + edge(3)));
      const double least = std::min(across, shortest_spacing(body, body.blocks[b], std::abs(s.nodes[k[0]].z)));
      if (wave_speed(body.blocks[b], static_cast<int>(q), materials) * step <= kStepSlack * least) continue;
      for (int n : k) out[b][n] = true;
    }
  }
  while (add_masters(body, out)) {
  }
  return out;
}

// With them those that they carry.
NodeSets moving_nodes(const SweptBody& body, NodeSets fine) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const Tie& t : body.ties)
      if (!fine[t.slave_block][t.slave_node] &&
          (fine[t.master_block][t.master_node0] || fine[t.master_block][t.master_node1]))
        changed = fine[t.slave_block][t.slave_node] = true;
  }
  return fine;
}

struct Extract {
  SweptBody body;
  std::vector<std::vector<std::pair<int, int>>> of;  // per block and node of the part: block and node of the whole
};

using QuadSets = std::vector<std::vector<bool>>;  // per block and quadrilateral

struct Kept {
  NodeSets nodes, covered;  // covered: by a quadrilateral that is kept
  QuadSets quads;
  void add(const SweptBody& whole, std::size_t b, std::size_t q) {
    quads[b][q] = true;
    for (int n : whole.blocks[b].section.quads[q]) nodes[b][n] = covered[b][n] = true;
  }
};

// The quadrilaterals that touch a moving node, their nodes and the masters of these; a master that would stand alone
// brings a quadrilateral, whose forces do not change.
Kept kept_parts(const SweptBody& whole, const NodeSets& moving) {
  Kept kept{no_nodes(whole), no_nodes(whole), {}};
  for (std::size_t b = 0; b < whole.blocks.size(); ++b) {
    const auto& all = whole.blocks[b].section.quads;
    kept.quads.emplace_back(all.size(), false);
    for (std::size_t q = 0; q < all.size(); ++q)
      if (std::any_of(all[q].begin(), all[q].end(), [&](int n) { return moving[b][n]; })) kept.add(whole, b, q);
  }
  for (bool changed = true; changed;) {
    changed = add_masters(whole, kept.nodes);
    for (std::size_t b = 0; b < whole.blocks.size(); ++b)
      for (std::size_t q = 0; q < kept.quads[b].size(); ++q)
        for (int n : whole.blocks[b].section.quads[q])
          if (kept.nodes[b][n] && !kept.covered[b][n]) {
            kept.add(whole, b, q);
            changed = true;
          }
  }
  return kept;
}

// The kept nodes and quadrilaterals of a block with numbers of their own; new_number: per node, -1 for those left out.
Block extract_block(const Block& whole, const std::vector<bool>& nodes, const std::vector<bool>& quads,
                    std::vector<int>& new_number) {
  assert(nodes.size() == whole.section.nodes.size() && quads.size() == whole.section.quads.size());
  const Section& from = whole.section;
  Block block{whole.name, {}, whole.stations, {{}, whole.along.of_element}};
  block.along.sets.resize(whole.along.sets.size());
  new_number.assign(from.nodes.size(), -1);
  for (std::size_t n = 0; n < from.nodes.size(); ++n) {
    if (!nodes[n]) continue;
    new_number[n] = static_cast<int>(block.section.nodes.size());
    block.section.nodes.push_back(from.nodes[n]);
  }
  for (std::size_t q = 0; q < from.quads.size(); ++q) {
    if (!quads[q]) continue;
    std::array<int, 4> k = from.quads[q];
    for (int& n : k) n = new_number[n];
    block.section.quads.push_back(k);
    block.section.quad_material.push_back(from.quad_material[q]);
    for (std::size_t set = 0; set < block.along.sets.size(); ++set)
      block.along.sets[set].push_back(whole.along.sets[set][q]);
  }
  return block;
}

Extract extract(const SweptBody& whole, const NodeSets& moving) {
  const Kept kept = kept_parts(whole, moving);
  Extract out;
  out.body.name = whole.name;
  out.body.kind = whole.kind;
  out.body.origin = whole.origin;
  out.body.materials = whole.materials;
  std::vector<int> block_of(whole.blocks.size(), -1);
  std::vector<std::vector<int>> node_of(whole.blocks.size());
  for (std::size_t b = 0; b < whole.blocks.size(); ++b) {
    if (std::find(kept.nodes[b].begin(), kept.nodes[b].end(), true) == kept.nodes[b].end()) continue;
    block_of[b] = static_cast<int>(out.body.blocks.size());
    out.body.blocks.push_back(extract_block(whole.blocks[b], kept.nodes[b], kept.quads[b], node_of[b]));
    out.of.emplace_back();
    for (std::size_t n = 0; n < node_of[b].size(); ++n)
      if (node_of[b][n] >= 0) out.of.back().emplace_back(static_cast<int>(b), static_cast<int>(n));
  }
  for (const Tie& t : whole.ties)
    if (kept.nodes[t.slave_block][t.slave_node])
      out.body.ties.push_back({block_of[t.slave_block], node_of[t.slave_block][t.slave_node], block_of[t.master_block],
                               node_of[t.master_block][t.master_node0], node_of[t.master_block][t.master_node1],
                               t.weight1});
  return out;
}

}  // namespace

Stages::Stages(int count_, double damping)
    : count(count_), delta(1 + damping / (static_cast<double>(count_) * count_)), omega(0), b(count_), c(count_) {
  // T_k and T_k' at delta, upwards
  std::vector<double> t{1, delta}, slope{0, 1};
  for (int k = 1; k < count; ++k) {
    t.push_back(2 * delta * t[k] - t[k - 1]);
    slope.push_back(2 * t[k] + 2 * delta * slope[k] - slope[k - 1]);
  }
  omega = 2 * slope[count] / t[count];
  for (int k = 1; k < count; ++k) {
    b[k] = t[k - 1] / t[k + 1];
    c[k] = t[k] / t[k + 1];
  }
}

LocalSteps::Part::Part(const SweptBody& mesh, const std::vector<Elastic>& materials, const ElementOptions& options)
    : body(mesh, materials, options), traversal(body) {
  for (Field* f : {&start, &moved, &stretched, &force, &frozen, &now, &before, &acceleration, &inverse_mass, &arm})
    *f = body.layout.field();
}

LocalSteps::LocalSteps(const Body& whole, const ElementOptions& options, double wanted_step) {
  const SweptBody& mesh = whole.mesh;
  fine_ = fast_nodes(mesh, whole.materials, wanted_step);
  const NodeSets moving = moving_nodes(mesh, fine_);
  for (std::size_t b = 0; b < fine_.size(); ++b)
    for (std::size_t n = 0; n < fine_[b].size(); ++n)
      fine_[b][n] = fine_[b][n] && whole.is_free(static_cast<int>(b), static_cast<int>(n));
  Extract part = extract(mesh, moving);
  if (part.body.blocks.empty()) return;
  part_ = std::make_unique<Part>(part.body, whole.materials, options);
  acts_on_ = no_nodes(mesh);
  for (std::size_t b = 0; b < part.of.size(); ++b)
    for (std::size_t n = 0; n < part.of[b].size(); ++n)
      for (int i = 0; i < 3; ++i) {
        const auto [block, node] = part.of[b][n];
        add_line(whole, block, node, i, static_cast<int>(b), static_cast<int>(n));
      }
}

// One component of one node of the whole, as it stands in the part.
void LocalSteps::add_line(const Body& whole, int block, int node, int i, int part_block, int part_node) {
  const BlockLayout& to = part_->body.layout.blocks[part_block];
  const std::ptrdiff_t from = whole.layout.blocks[block].line(node, i);
  const Copy line{from, to.line(part_node, i), to.stations, whole.inverse_mass[from] > 0, fine_[block][node]};
  part_->lines.push_back(line);
  std::copy_n(whole.inverse_mass.begin() + line.body, line.count, part_->inverse_mass.begin() + line.part);
  acts_on_[block][node] = line.free;
  if (whole.mesh.kind != SweepKind::revolve || i == 1) return;
  const Block& b = whole.mesh.blocks[block];
  for (int j = 0; j < line.count; ++j) {
    const Vec3 arm = swept_point(whole.mesh.kind, {}, b.section.nodes[node], b.stations.at[j]);
    part_->arm[line.part + j] = i == 0 ? arm.x : arm.z;
  }
}

void LocalSteps::set_step(double step, double body_step, double damping) {
  step_ = step;
  int p = 1;
  while (Stages(p, damping).reach() < 4 * std::pow(kMargin * step / body_step, 2)) ++p;
  stages_ = Stages(p, damping);
}

long LocalSteps::fine_elements() const { return part_ ? part_->body.mesh.elements() : 0; }

template <class Force>
void LocalSteps::run_stages(Force&& added_force) {
  Part& p = *part_;
  const auto lines = static_cast<std::ptrdiff_t>(p.lines.size());
  const double d2 = step_ * step_, first = d2 / (stages_.omega * stages_.delta);
  for_each(lines, [&](std::ptrdiff_t n) {
    const Copy& l = p.lines[n];
    for (std::ptrdiff_t i = l.part; i < l.part + l.count; ++i) {
      p.before[i] = 0;
      p.now[i] = first * p.acceleration[i];
    }
  });
  for (int k = 1; k < stages_.count; ++k) {
    for_each(lines, [&](std::ptrdiff_t n) {
      const Copy& l = p.lines[n];
      for (std::ptrdiff_t i = l.part; i < l.part + l.count; ++i) p.stretched[i] = l.fine ? p.now[i] : 0.0;
    });
    p.body.ties.apply_homogeneous(p.stretched);
    added_force(p.force);
    p.body.ties.apply_transpose(p.force);
    const double b = stages_.b[k], c = 2 * d2 / stages_.omega * stages_.c[k];
    for_each(lines, [&](std::ptrdiff_t n) {
      const Copy& l = p.lines[n];
      for (std::ptrdiff_t i = l.part; i < l.part + l.count; ++i) {
        const double next =
            (1 + b) * p.now[i] - b * p.before[i] + c * (p.acceleration[i] - p.inverse_mass[i] * p.force[i]);
        p.before[i] = p.now[i];
        p.now[i] = next;
      }
    });
  }
}

template <class Force>
void LocalSteps::refine_with(const Field& u, const FrozenAcceleration& frozen, Field& f, Force&& force) {
  if (empty() || stages_.count == 1) return;
  Part& p = *part_;
  const auto lines = static_cast<std::ptrdiff_t>(p.lines.size());
  const double uniform[3] = {frozen.uniform.x, frozen.uniform.y, frozen.uniform.z};
  const auto body_acceleration = [&](std::ptrdiff_t n, std::ptrdiff_t i) {
    return uniform[n % 3] + frozen.centrifugal * p.arm[i];
  };
  for_each(lines, [&](std::ptrdiff_t n) {
    const Copy& l = p.lines[n];
    for (int j = 0; j < l.count; ++j) {
      p.start[l.part + j] = u[l.body + j];
      p.acceleration[l.part + j] =
          l.free ? body_acceleration(n, l.part + j) - p.inverse_mass[l.part + j] * f[l.body + j] : 0.0;
    }
  });
  force(p.start, p.frozen);
  run_stages([&](Field& added) {
    for_each(lines, [&](std::ptrdiff_t n) {
      const Copy& l = p.lines[n];
      for (std::ptrdiff_t i = l.part; i < l.part + l.count; ++i) p.moved[i] = p.start[i] + p.stretched[i];
    });
    force(p.moved, added);
    for_each(lines, [&](std::ptrdiff_t n) {
      const Copy& l = p.lines[n];
      for (std::ptrdiff_t i = l.part; i < l.part + l.count; ++i) added[i] -= p.frozen[i];
    });
  });
  const double back = 2 / (step_ * step_);
  for_each(lines, [&](std::ptrdiff_t n) {
    const Copy& l = p.lines[n];
    if (!l.free) return;
    for (int j = 0; j < l.count; ++j)
      f[l.body + j] = (body_acceleration(n, l.part + j) - back * p.now[l.part + j]) / p.inverse_mass[l.part + j];
  });
}

void LocalSteps::add_forces(const std::vector<NodalForce>& forces, Field& f) {
  if (empty() || stages_.count == 1) {
    for (const NodalForce& a : forces) f[a.index] -= a.value;
    return;
  }
  Part& p = *part_;
  std::fill(p.acceleration.begin(), p.acceleration.end(), 0.0);
  for (const NodalForce& a : forces) {
    const auto after = std::upper_bound(p.lines.begin(), p.lines.end(), a.index,
                                        [](std::ptrdiff_t index, const Copy& l) { return index < l.body; });
    const bool inside = after != p.lines.begin() && a.index < std::prev(after)->body + std::prev(after)->count;
    if (!inside) {
      f[a.index] -= a.value;
      continue;
    }
    const std::ptrdiff_t i = std::prev(after)->part + (a.index - std::prev(after)->body);
    p.acceleration[i] += p.inverse_mass[i] * a.value;
  }
  run_stages([&](Field& added) { p.traversal.linear_force(p.stretched, added); });
  const double back = 2 / (step_ * step_);
  for_each(static_cast<std::ptrdiff_t>(p.lines.size()), [&](std::ptrdiff_t n) {
    const Copy& l = p.lines[n];
    if (!l.free) return;
    for (int j = 0; j < l.count; ++j) f[l.body + j] -= back * p.now[l.part + j] / p.inverse_mass[l.part + j];
  });
}

void LocalSteps::refine(const Field& u, double psi, const FrozenAcceleration& frozen, Field& f) {
  refine_with(u, frozen, f, [&](Field& x, Field& out) { part_->traversal.internal_force(x, psi, out); });
}

void LocalSteps::refine_linear(const Field& u, Field& f) {
  refine_with(u, {}, f, [&](Field& x, Field& out) { part_->traversal.linear_force(x, out); });
}

SurfaceResponse surface_response(const Body& body, const ContactSurface& surface, LocalSteps& steps) {
  const ContactBand& band = body.mesh.contact;
  bool any = false;
  for (int column = 0; column < surface.columns; ++column) any = any || steps.acts_on(band.block, column);
  if (!any) return {};
  const std::vector<double>& at = surface.stations.at;
  const int first = static_cast<int>(std::lower_bound(at.begin(), at.end(), band.fine_begin) - at.begin()),
            last = static_cast<int>(std::upper_bound(at.begin(), at.end(), band.fine_end) - at.begin()) - 1;
  const int reach = std::min(steps.stages() - 1, (last - first) / 2), apart = 2 * reach + 1,
            at_once = (last - first + 1) / apart;  // impulses that do not feel one another
  SurfaceResponse out(surface.columns, reach);
  struct Push {
    int column, station;
    Vec3 axis[3];  // of the station in the model
  };
  for (int begin = 0; begin < surface.columns; begin += at_once) {
    std::vector<Push> pushes;
    for (int column = begin; column < std::min(begin + at_once, surface.columns); ++column) {
      const int station = first + reach + (column - begin) * apart;
      const double angle = surface.kind == SweepKind::revolve ? at[station] : 0, c = std::cos(angle),
                   s = std::sin(angle);
      pushes.push_back({column, station, {{c, 0, s}, {0, 1, 0}, {-s, 0, c}}});
    }
    for (int i = 0; i < 3; ++i) {
      std::vector<NodalForce> forces;
      for (const Push& p : pushes)
        for (const auto& [component, value] :
             {std::pair{0, p.axis[i].x}, std::pair{1, p.axis[i].y}, std::pair{2, p.axis[i].z}})
          forces.push_back({surface.index(p.column, p.station) + component * surface.stride, value});
      Field f = body.layout.field();
      steps.add_forces(forces, f);
      for (const Push& p : pushes)
        for (int to = 0; to < surface.columns; ++to)
          for (int distance = -reach; distance <= reach; ++distance) {
            const std::ptrdiff_t n = surface.index(to, p.station + distance);
            const Vec3 velocity = -body.inverse_mass[n] * vector_at(f, n, surface.stride);
            for (int k = 0; k < 3; ++k) out.entry(p.column, to, distance, k, i) = dot(velocity, p.axis[k]);
          }
    }
  }
  return out;
}

}  // namespace railstrata
