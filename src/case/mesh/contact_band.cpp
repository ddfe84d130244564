#include "mesh/contact_band.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "core/faults.hpp"
#include "mesh/grading.hpp"

namespace railstrata {

int layer_rows(const LayerMesh& layer, double h) {
  if (layer.elements > 0) return layer.elements;
  const int by_height = static_cast<int>(std::ceil(layer.thickness / std::min(1e-3, h) - 1e-9));
  return std::max(layer.thickness > 3e-3 - 1e-9 ? 3 : 2, by_height);
}

namespace {

constexpr double kDepthRoundOff = 1e-9;  // m

/// n rows below one of height `above`, each `ratio` times its neighbour until h is reached.
std::vector<double> growing_heights(double above, double h, double ratio, int n) {
  std::vector<double> heights;
  double height = above;
  for (int i = 0; i < n; ++i) {
    height = above < h ? std::min(height * ratio, h) : std::max(height / ratio, h);
    heights.push_back(height);
  }
  return heights;
}

/// Heights that fill `rest` below a row of height `above`: towards h by a ratio of at most two, then h.
std::vector<double> matrix_heights(double rest, double above, double h) {
  if (std::abs(above - h) < 1e-9 * h) {
    const int n = std::max(1, static_cast<int>(std::lround(rest / h)));
    return std::vector<double>(n, rest / n);
  }
  const auto sum = [&](double ratio, int n) {
    const std::vector<double> heights = growing_heights(above, h, ratio, n);
    return std::accumulate(heights.begin(), heights.end(), 0.0);
  };
  int n = 1;
  if (above < h)
    while (sum(2, n) < rest) ++n;
  else
    while (sum(2, n + 1) <= rest) ++n;
  double low = 1, high = 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((sum(middle, n) > rest) == (above < h) ? high : low) = middle;
  }
  return growing_heights(above, h, 0.5 * (low + high), n);
}

bool any_varies(const std::vector<LayerMesh>& layers) {
  return std::any_of(layers.begin(), layers.end(), [](const LayerMesh& l) { return !l.across.empty(); });
}

/// How thick the rows of a layer are together at y.
double height_of_rows(const LayerMesh& layer, double y) {
  constexpr double kThinnest = 1.0 / 20;  // of the largest thickness: rows stay where the layer is not
  if (layer.across.empty() || !layer.rows_follow) return layer.thickness;
  return std::max(over_table(layer.across, y), kThinnest * layer.thickness);
}

/// Outward direction of the column at s: the surface's normal, blended across the kinks nearby.
Vec2 column_direction(const Profile& profile, double s, Vec2 normal) {
  constexpr double kKink = 1e-3;  // rad
  const auto& knots = profile.knots();
  Vec2 direction = normal;
  for (auto k = std::upper_bound(knots.begin(), knots.end(), s - kKinkHalfWidth);
       k != knots.end() && *k < s + kKinkHalfWidth; ++k) {
    if (k == knots.begin() || k + 1 == knots.end()) continue;
    const Vec2 before = profile.at(*k - 1e-9).outward, after = profile.at(*k).outward;
    if (norm(after - before) < kKink) continue;
    const double weight = 0.5 * (1 - std::abs(s - *k) / kKinkHalfWidth);
    direction = direction + weight * (s < *k ? after - before : before - after);
  }
  return (1 / norm(direction)) * direction;
}

double inclination(const Profile& profile, double s) {
  const Vec2 t = profile.at(s).tangent;
  return std::atan2(std::abs(t.z), t.y);
}

}  // namespace

BandRows band_rows(const std::vector<LayerMesh>& layers, double h, double fine_depth, double limit,
                   const char* carrier) {
  BandRows rows{{0.0}, {}};
  double above = h;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const int n = layer_rows(layers[k], h);
    const double top = rows.depth.back();
    above = layers[k].thickness / n;
    for (int i = 1; i <= n; ++i) rows.depth.push_back(top + layers[k].thickness * i / n);
    rows.material.insert(rows.material.end(), n, static_cast<int>(k) + 1);
  }
  const double layered = rows.depth.back();
  if (layered > limit + 1e-9)
    throw CaseError(fmt::format("layer thicker than the {}: {:g} mm of layers, the {} carries {:.2f} mm", carrier,
                                1e3 * layered, carrier, 1e3 * limit),
                    "make the layers thinner");

  const bool vary = any_varies(layers);
  const double bottom = std::min(limit, std::max(fine_depth, layers.empty() ? h : layered + std::max(2 * h, above)));
  if (bottom - layered < 0.25 * above && vary)
    throw CaseError(fmt::format("layer too thick to vary across: the {} carries {:.2f} mm", carrier, 1e3 * limit),
                    "make the layers thinner");
  if (bottom - layered < 0.25 * above) return rows;
  for (double height : matrix_heights(bottom - layered, above, h)) {
    rows.depth.push_back(rows.depth.back() + height);
    rows.material.push_back(0);
  }
  rows.depth.back() = bottom;
  return rows;
}

BandRows merged_rows(const BandRows& rows, double height) {
  BandRows out{{0.0}, {}};
  for (int r = 0; r < rows.count(); ++r) {
    const bool last = r + 1 == rows.count();
    if (!last && rows.material[r + 1] == rows.material[r] &&
        rows.depth[r + 2] - out.depth.back() <= height * (1 + 1e-9))
      continue;
    out.depth.push_back(rows.depth[r + 1]);
    out.material.push_back(rows.material[r]);
  }
  return out;
}

std::pair<double, double> running_range(const Profile& profile, double angle) {
  constexpr double kStep = 0.25e-3;
  const double middle = std::clamp(0.0, profile.s_min(), profile.s_max());
  double low = middle, high = middle;
  while (low - kStep > profile.s_min() && inclination(profile, low - kStep) < angle) low -= kStep;
  while (high + kStep < profile.s_max() && inclination(profile, high + kStep) < angle) high += kStep;
  const auto jumps = [&](double a, double b) {
    return std::abs(inclination(profile, a) - inclination(profile, b)) > 0.1;
  };
  if (low - kStep > profile.s_min() && jumps(low, low - kStep)) low += kKinkHalfWidth;
  if (high + kStep < profile.s_max() && jumps(high, high + kStep)) high -= kKinkHalfWidth;
  return {low, high};
}

double smallest_convex_radius(const Profile& profile, double s0, double s1) {
  constexpr double kHalf = 2e-3, kStep = 1e-3;
  double radius = 1e9;
  for (double s = s0 + kHalf; s <= s1 - kHalf; s += kStep) {
    const double turn = cross(profile.at(s + kHalf).outward, profile.at(s - kHalf).outward);
    const double convex = profile.kind() == ProfileKind::rail ? turn : -turn;
    if (convex > 0) radius = std::min(radius, 2 * kHalf / std::asin(std::min(1.0, convex)));
  }
  return radius;
}

std::vector<double> fine_columns(double contact_s, double h, double fine_width, std::pair<double, double> range,
                                 const char* body) {
  const int n = std::max(2, static_cast<int>(std::lround(fine_width / h)));
  const double width = n * h, available = range.second - range.first;
  if (width > available)
    throw CaseError(fmt::format("fine width larger than the running surface: {:g} mm on {:.1f} mm of the {}",
                                1e3 * width, 1e3 * available, body),
                    "reduce the mesh's fine_width");
  if (contact_s - range.first < 0.25 * width || range.second - contact_s < 0.25 * width)
    throw CaseError(
        fmt::format(
            "contact point too close to the end of the {}'s running surface: s = {:.2f} mm of {:.2f} … {:.2f} mm", body,
            1e3 * contact_s, 1e3 * range.first, 1e3 * range.second),
        "reduce the lateral shift or the mesh's fine_width");
  const double begin = std::clamp(contact_s - 0.5 * width, range.first, range.second - width);
  std::vector<double> s;
  for (int c = 0; c <= n; ++c) s.push_back(begin + c * h);
  return s;
}

std::vector<double> layer_edges(const Profile& profile, const std::vector<LayerMesh>& layers, const char* carrier,
                                double carrier_width) {
  std::vector<double> s;
  const double available = std::min(carrier_width, profile.y_max() - profile.y_min());
  for (const LayerMesh& layer : layers) {
    if (layer.across.empty() && layer.width > available)
      throw CaseError(fmt::format("layer width larger than the {}: {:g} mm, the {} is {:.1f} mm wide", carrier,
                                  1e3 * layer.width, carrier, 1e3 * available),
                      "reduce the layer's width");
    for (double y : {layer.low(), layer.high()})
      if (y > profile.y_min() && y < profile.y_max()) s.push_back(profile.s_at_y(y));
  }
  return s;
}

Vec2 offset_point(const Profile& profile, double s, double depth) {
  const ProfilePoint p = profile.at(std::clamp(s, profile.s_min(), profile.s_max()));
  const Vec2 direction = column_direction(profile, s, p.outward);
  return p.position - (depth / dot(direction, p.outward)) * direction;
}

int material_at(const BandRows& rows, int row, double y, const std::vector<LayerMesh>& layers) {
  assert(row >= 0 && row < rows.count() && rows.material[row] <= static_cast<int>(layers.size()));
  const int layer = rows.material[row];
  if (!any_varies(layers)) return layer > 0 && std::abs(y) < 0.5 * layers[layer - 1].width ? layer : 0;
  const std::vector<double> depths = depths_at(rows, y, layers);
  const double middle = 0.5 * (depths[row] + depths[row + 1]);
  double bottom = 0;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    bottom += layers[k].thickness_at(y);
    if (middle < bottom) return static_cast<int>(k) + 1;
  }
  return 0;
}

std::vector<double> depths_at(const BandRows& rows, double y, const std::vector<LayerMesh>& layers) {
  std::vector<double> out = rows.depth;
  if (!any_varies(layers)) return out;
  double top = 0, own_top = 0;
  std::size_t row = 1;
  const auto stretch = [&](double bottom, double own_bottom) {
    for (; row < out.size() && rows.depth[row] <= bottom + kDepthRoundOff; ++row)
      out[row] = own_top + (rows.depth[row] - top) * (own_bottom - own_top) / (bottom - top);
    top = bottom;
    own_top = own_bottom;
  };
  for (const LayerMesh& layer : layers) stretch(top + layer.thickness, own_top + height_of_rows(layer, y));
  stretch(rows.depth.back(), rows.depth.back());
  return out;
}

std::vector<NodeLine> add_band(Section& section, const Profile& profile, const std::vector<double>& s,
                               const BandRows& rows, const std::vector<LayerMesh>& layers) {
  assert(s.size() >= 2 && static_cast<int>(rows.depth.size()) == rows.count() + 1);
  std::vector<std::vector<double>> depths;
  for (double at : s) depths.push_back(depths_at(rows, profile.at(at).position.y, layers));
  std::vector<NodeLine> grid;
  for (std::size_t r = 0; r < rows.depth.size(); ++r) {
    std::vector<Vec2> points;
    for (std::size_t c = 0; c < s.size(); ++c) points.push_back(offset_point(profile, s[c], depths[c][r]));
    grid.push_back(add_nodes(section, points));
  }
  const bool material_below = profile.kind() == ProfileKind::rail;
  for (int r = 0; r < rows.count(); ++r)
    for (std::size_t c = 0; c + 1 < s.size(); ++c) {
      const int top0 = grid[r][c], top1 = grid[r][c + 1], deep0 = grid[r + 1][c], deep1 = grid[r + 1][c + 1];
      section.quads.push_back(material_below ? std::array{deep0, deep1, top1, top0}
                                             : std::array{top0, top1, deep1, deep0});
      section.quad_material.push_back(material_at(rows, r, profile.at(0.5 * (s[c] + s[c + 1])).position.y, layers));
    }
  return grid;
}

void seat_on_line(Section& band, const std::vector<NodeLine>& rows, const std::vector<Vec2>& line) {
  assert(rows.size() >= 2 && rows.back().size() == rows[rows.size() - 2].size());
  const NodeLine& bottom = rows.back();
  const NodeLine& above = rows[rows.size() - 2];
  for (std::size_t c = 0; c < bottom.size(); ++c) {
    Vec2& p = band.nodes[bottom[c]];
    const Vec2 column = p - band.nodes[above[c]];
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Vec2 chord = line[k + 1] - line[k], to = line[k] - p;
      const double det = cross(column, chord);
      if (std::abs(det) < 1e-3 * norm(column) * norm(chord)) continue;
      const double along_column = cross(to, chord) / det, along_chord = cross(to, column) / det;
      if (std::abs(along_column) > 0.2 || along_chord < -1e-9 || along_chord > 1 + 1e-9) continue;
      p = p + along_column * column;
      break;
    }
  }
}

std::vector<std::string> material_names(const std::vector<LayerMesh>& layers) {
  std::vector<std::string> names{"matrix"};
  for (const LayerMesh& layer : layers) names.push_back(layer.name);
  return names;
}

std::vector<int> material_layers(const std::vector<LayerMesh>& layers) {
  std::vector<int> out{0};
  int layer = 1;
  for (const LayerMesh& l : layers) {
    out.push_back(layer);
    if (!l.continues) ++layer;
  }
  return out;
}

NodeLine column_of(const std::vector<NodeLine>& rows, std::size_t column) {
  NodeLine out;
  for (const NodeLine& row : rows) out.push_back(row[column]);
  return out;
}

}  // namespace railstrata
