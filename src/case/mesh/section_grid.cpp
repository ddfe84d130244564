#include "mesh/section_grid.hpp"

#include <algorithm>
#include <cassert>

namespace railstrata {

namespace {

std::vector<double> arc_fractions(const Section& section, const NodeLine& line) {
  std::vector<double> out{0.0};
  for (std::size_t i = 1; i < line.size(); ++i)
    out.push_back(out.back() + norm(section.nodes[line[i]] - section.nodes[line[i - 1]]));
  for (double& f : out) f /= out.back() > 0 ? out.back() : 1.0;
  return out;
}

double signed_area(const Section& section, const NodeLine& south, const NodeLine& north) {
  const Vec2 a = section.nodes[south.front()], b = section.nodes[south.back()], c = section.nodes[north.back()],
             d = section.nodes[north.front()];
  return cross(c - a, d - b);
}

}  // namespace

NodeLine add_nodes(Section& section, const std::vector<Vec2>& points) {
  NodeLine line;
  for (Vec2 p : points) {
    line.push_back(static_cast<int>(section.nodes.size()));
    section.nodes.push_back(p);
  }
  return line;
}

std::vector<NodeLine> add_patch(Section& section, const NodeLine& south, const NodeLine& north, const NodeLine& west,
                                const NodeLine& east) {
  assert(south.size() == north.size() && west.size() == east.size());
  assert(south.front() == west.front() && south.back() == east.front() && north.front() == west.back() &&
         north.back() == east.back());
  const std::size_t n = south.size() - 1, m = west.size() - 1;
  const auto fs = arc_fractions(section, south), fn = arc_fractions(section, north), fw = arc_fractions(section, west),
             fe = arc_fractions(section, east);
  const auto at = [&](int node) { return section.nodes[node]; };
  const Vec2 sw = at(south.front()), se = at(south.back()), nw = at(north.front()), ne = at(north.back());

  std::vector<NodeLine> rows(m + 1, NodeLine(n + 1));
  rows[0] = south;
  rows[m] = north;
  for (std::size_t j = 1; j < m; ++j) {
    rows[j][0] = west[j];
    rows[j][n] = east[j];
    for (std::size_t i = 1; i < n; ++i) {
      // parameters of the crossing of the straight lines that join opposite fractions
      const double du = fn[i] - fs[i], dv = fe[j] - fw[j];
      const double u = (fs[i] + fw[j] * du) / (1 - du * dv), v = fw[j] + u * dv;
      const Vec2 p = (1 - v) * at(south[i]) + v * at(north[i]) + (1 - u) * at(west[j]) + u * at(east[j]) -
                     ((1 - u) * (1 - v) * sw + u * (1 - v) * se + (1 - u) * v * nw + u * v * ne);
      rows[j][i] = static_cast<int>(section.nodes.size());
      section.nodes.push_back(p);
    }
  }

  const bool flip = signed_area(section, south, north) < 0;
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      std::array<int, 4> quad{rows[j][i], rows[j][i + 1], rows[j + 1][i + 1], rows[j + 1][i]};
      if (flip) std::reverse(quad.begin(), quad.end());
      section.quads.push_back(quad);
      section.quad_material.push_back(0);
    }
  return rows;
}

NodeLine add_straight(Section& section, int from, int to, const std::vector<double>& fractions) {
  const Vec2 a = section.nodes[from], b = section.nodes[to];
  NodeLine line{from};
  for (double f : fractions) line.push_back(add_nodes(section, {a + f * (b - a)}).front());
  line.push_back(to);
  return line;
}

NodeLine add_straight(Section& section, int from, int to, int intervals) {
  std::vector<double> fractions;
  for (int i = 1; i < intervals; ++i) fractions.push_back(static_cast<double>(i) / intervals);
  return add_straight(section, from, to, fractions);
}

double polyline_length(const std::vector<Vec2>& polyline) {
  double length = 0;
  for (std::size_t i = 1; i < polyline.size(); ++i) length += norm(polyline[i] - polyline[i - 1]);
  return length;
}

std::vector<Vec2> resampled(const std::vector<Vec2>& polyline, int intervals) {
  assert(polyline.size() >= 2 && intervals > 0);
  const double length = polyline_length(polyline);
  std::vector<Vec2> out{polyline.front()};
  double walked = 0;
  std::size_t k = 1;
  for (int i = 1; i < intervals; ++i) {
    const double wanted = length * i / intervals;
    while (walked + norm(polyline[k] - polyline[k - 1]) < wanted) {
      walked += norm(polyline[k] - polyline[k - 1]);
      ++k;
    }
    out.push_back(polyline[k - 1] +
                  ((wanted - walked) / norm(polyline[k] - polyline[k - 1])) * (polyline[k] - polyline[k - 1]));
  }
  out.push_back(polyline.back());
  return out;
}

NodeLine reversed(NodeLine line) {
  std::reverse(line.begin(), line.end());
  return line;
}

NodeLine joined(NodeLine a, const NodeLine& b) {
  assert(a.back() == b.front());
  a.insert(a.end(), b.begin() + 1, b.end());
  return a;
}

void tie_to_line(SweptBody& body, int slave_block, const NodeLine& slaves, int master_block, const NodeLine& masters) {
  const auto& from = body.blocks[slave_block].section.nodes;
  const auto& onto = body.blocks[master_block].section.nodes;
  for (int slave : slaves) {
    Tie best{slave_block, slave, master_block, masters.front(), masters.front(), 0.0};
    double best_distance = 1e300;
    for (std::size_t k = 0; k + 1 < masters.size(); ++k) {
      const Vec2 a = onto[masters[k]], ab = onto[masters[k + 1]] - a, ap = from[slave] - a;
      double w = std::clamp(dot(ap, ab) / dot(ab, ab), 0.0, 1.0);
      if (w < 1e-6) w = 0;
      if (w > 1 - 1e-6) w = 1;
      const double distance = norm(ap - w * ab);
      if (distance >= best_distance) continue;
      best_distance = distance;
      best.master_node0 = masters[k];
      best.master_node1 = masters[k + 1];
      best.weight1 = w;
    }
    body.ties.push_back(best);
  }
}

}  // namespace railstrata
