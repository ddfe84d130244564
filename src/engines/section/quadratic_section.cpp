#include "section/quadratic_section.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>

namespace railstrata {

namespace {

struct Side {
  int from = 0, to = 0, middle = 0, block = 0, elements = 0;
};

/// Where a hanging node stands on a side: from 0 at its beginning to 1.
struct Hold {
  const Side* side = nullptr;
  double at = 0;
};

class MeshMaker {
 public:
  explicit MeshMaker(const SweptBody& body) : body_(body) {
    for (std::size_t b = 0; b < body.blocks.size(); ++b) add_block(static_cast<int>(b));
    held_.assign(mesh_.nodes.size(), 0);
    for (const SectionNode& n : body.prescribed) held_[global(n.block, n.node)] = 1;
    for (const auto& [ends, side] : sides_)
      if (side.elements == 1 && held_[side.from] && held_[side.to]) held_[side.middle] = 1;
  }

  QuadraticSection make() {
    carriers_.assign(mesh_.nodes.size(), {});
    std::vector<int> master(mesh_.nodes.size(), -1);
    for (const Tie& tie : body_.ties) master[global(tie.slave_block, tie.slave_node)] = tie.master_block;
    for (const auto& [ends, side] : sides_) {
      if (side.elements != 1 || master[side.from] < 0 || master[side.to] < 0) continue;
      hang(side.middle, {master[side.from], master[side.to]});
    }
    for (std::size_t n = 0; n < master.size(); ++n)
      if (master[n] >= 0) hang(static_cast<int>(n), {master[n], master[n]});
    number();
    settle();
    add_surface();
    add_base();
    return std::move(mesh_);
  }

 private:
  int global(int block, int node) const { return first_[block] + node; }

  void add_block(int block) {
    const Section& section = body_.blocks[block].section;
    first_.push_back(static_cast<int>(mesh_.nodes.size()));
    mesh_.nodes.insert(mesh_.nodes.end(), section.nodes.begin(), section.nodes.end());
    for (std::size_t q = 0; q < section.quads.size(); ++q) {
      std::array<int, 8> element{};
      for (std::size_t i = 0; i < 4; ++i) element[i] = global(block, section.quads[q][i]);
      for (std::size_t i = 0; i < 4; ++i) element[4 + i] = middle_of(element[i], element[(i + 1) % 4], block);
      mesh_.elements.push_back(element);
      mesh_.material.push_back(section.quad_material[q]);
    }
  }

  int middle_of(int a, int b, int block) {
    const auto [at, is_new] = sides_.try_emplace(std::minmax(a, b));
    Side& side = at->second;
    if (is_new) {
      side = {a, b, static_cast<int>(mesh_.nodes.size()), block, 0};
      mesh_.nodes.push_back(0.5 * (mesh_.nodes[a] + mesh_.nodes[b]));
    }
    ++side.elements;
    return side.middle;
  }

  /// Onto the nearest outer side of two blocks.
  void hang(int node, std::array<int, 2> blocks) {
    Hold best;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [ends, side] : sides_) {
      if (side.elements != 1 || (side.block != blocks[0] && side.block != blocks[1]) || side.middle == node) continue;
      if (side.from == node || side.to == node) continue;
      const Vec2 a = mesh_.nodes[side.from], along = mesh_.nodes[side.to] - a, to = mesh_.nodes[node] - a;
      const double at = std::clamp(dot(to, along) / dot(along, along), 0.0, 1.0), distance = norm(to - at * along);
      if (distance < nearest - 1e-12) {
        nearest = distance;
        best = {&side, at};
      }
    }
    assert(best.side);
    const std::array<double, 3> shape = shape_on_side(best.at);
    const std::array<int, 3> nodes{best.side->from, best.side->middle, best.side->to};
    NodeShares& on = carriers_[node];
    for (std::size_t i = 0; i < 3; ++i)
      if (std::abs(shape[i]) > 1e-12) on.emplace_back(nodes[i], shape[i]);
  }

  /// Carriers may hang themselves.
  void add_shares(int node, double share, std::map<int, double>& to) const {
    if (carriers_[node].empty()) {
      if (!held_[node]) to[node] += share;
      return;
    }
    for (const auto& [carrier, part] : carriers_[node]) add_shares(carrier, share * part, to);
  }

  void number() {
    std::vector<int> index(mesh_.nodes.size(), -1);
    for (std::size_t n = 0; n < index.size(); ++n)
      if (carriers_[n].empty() && !held_[n]) index[n] = mesh_.free_nodes++;
    for (std::size_t n = 0; n < index.size(); ++n) {
      std::map<int, double> sum;
      add_shares(static_cast<int>(n), 1, sum);
      NodeShares& shares = mesh_.shares.emplace_back();
      for (const auto& [node, share] : sum) shares.emplace_back(index[node], share);
    }
  }

  /// Hanging nodes stand on the sides that carry them, and middles between their ends: beside them a rotation would
  /// strain the elements.
  void settle() {
    std::vector<const Side*> of_middle(mesh_.nodes.size(), nullptr);
    for (const auto& [ends, side] : sides_) of_middle[side.middle] = &side;
    const std::vector<Vec2> before = mesh_.nodes;
    const auto place = [&](const auto& self, int node) -> Vec2 {
      Vec2 sum{};
      for (const auto& [carrier, share] : carriers_[node]) sum = sum + share * self(self, carrier);
      if (!carriers_[node].empty()) return sum;
      const Side* side = of_middle[node];
      return side ? 0.5 * (self(self, side->from) + self(self, side->to)) : before[node];
    };
    for (std::size_t n = 0; n < before.size(); ++n) mesh_.nodes[n] = place(place, static_cast<int>(n));
  }

  void add_surface() {
    const ContactBand& band = body_.contact;
    for (int c = 0; c <= band.columns; ++c) {
      const int corner = global(band.block, c);
      if (c > 0) {
        mesh_.surface.push_back(sides_.at(std::minmax(corner - 1, corner)).middle);
        mesh_.s.push_back(0.5 * (band.s[c - 1] + band.s[c]));
      }
      mesh_.surface.push_back(corner);
      mesh_.s.push_back(band.s[c]);
    }
  }

  void add_base() {
    std::vector<char> rests(mesh_.nodes.size(), 0);
    for (const SectionNode& n : body_.on_pads) rests[global(n.block, n.node)] = 1;
    for (const auto& [ends, side] : sides_)
      if (side.elements == 1 && rests[side.from] && rests[side.to])
        mesh_.on_pads.push_back({side.from, side.middle, side.to});
  }

  const SweptBody& body_;
  QuadraticSection mesh_;
  std::vector<int> first_;  // nodes of the blocks
  std::map<std::pair<int, int>, Side> sides_;
  std::vector<char> held_;
  std::vector<NodeShares> carriers_;
};

}  // namespace

QuadraticSection quadratic_section(const SweptBody& body) { return MeshMaker(body).make(); }

}  // namespace railstrata
