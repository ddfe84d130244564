#include "mesh/split_interface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/faults.hpp"
#include "mesh/layer_stacks.hpp"

namespace railstrata {
namespace {

constexpr double kSameRow = 1e-9;  // m

/// The row of nodes at a depth; that of the band's bottom where there is none.
int row_at(const ContactBand& band, double depth) {
  const auto same = [&](double d) { return std::abs(d - depth) < kSameRow; };
  const auto at = std::find_if(band.depth.begin(), band.depth.end(), same);
  return std::min(static_cast<int>(at - band.depth.begin()), band.rows);
}

/// Columns of elements begin <= c < end of a row that lie within the layer's width.
struct Columns {
  int begin = 0, end = 0;
};
Columns columns_of(const Section& section, const ContactBand& band, int row, double width) {
  const auto inside = [&](int c) { return std::abs(centre_of(section, row * band.columns + c).y) < 0.5 * width; };
  Columns out{0, band.columns};
  while (out.begin < out.end && !inside(out.begin)) ++out.begin;
  while (out.begin < out.end && !inside(out.end - 1)) --out.end;
  return out;
}

/// The quadrilaterals of a row of elements take the copies of nodes.
void move_row(Section& section, const ContactBand& band, int row, const std::map<int, int>& copy_of) {
  for (int c = 0; c < band.columns; ++c)
    for (int& node : section.quads[static_cast<std::size_t>(row * band.columns + c)])
      if (const auto copy = copy_of.find(node); copy != copy_of.end()) node = copy->second;
}

void split_below(SweptBody& body, const LayerMesh& layer, double bottom) {
  const ContactBand& band = body.contact;
  Section& section = body.blocks[static_cast<std::size_t>(band.block)].section;
  SplitInterface out;
  out.row = row_at(band, bottom);
  if (out.row >= band.rows)
    throw CaseError(
        fmt::format("below layer \"{}\" the mesh has no fine row of elements that could be unbonded", layer.name),
        "increase mesh.fine_depth, or use a thinner layer", "mesh.fine_depth");
  const Columns columns = columns_of(section, band, out.row - 1, layer.width);
  if (columns.end - columns.begin < 2)
    throw CaseError(fmt::format("layer \"{}\" has fewer than two of the mesh's fine columns; its edges are bonded, so "
                                "nothing is left to unbond",
                                layer.name),
                    "increase mesh.fine_width, or use a smaller mesh.element_size", "mesh.fine_width");
  out.first_column = columns.begin + 1;
  out.open = layer.unbonded;
  out.friction = layer.unbonded_friction;
  std::map<int, int> copy_of;
  for (int c = out.first_column; c < columns.end; ++c) {
    const int node = out.row * (band.columns + 1) + c, copy = static_cast<int>(section.nodes.size());
    section.nodes.push_back(Vec2{section.nodes[static_cast<std::size_t>(node)]});
    out.below.push_back(copy);
    copy_of[node] = copy;
  }
  move_row(section, band, out.row, copy_of);
  body.interfaces.push_back(std::move(out));
}

}  // namespace

void split_interfaces(SweptBody& body, const std::vector<LayerMesh>& layers) {
  const std::vector<double> bottoms = layer_bottoms(layers);
  for (std::size_t k = 0; k < layers.size(); ++k)
    if (!layers[k].unbonded.empty()) split_below(body, layers[k], bottoms[k]);
}

std::vector<int> nodes_below(const SweptBody& body) {
  std::vector<int> out;
  for (const SplitInterface& interface : body.interfaces)
    out.insert(out.end(), interface.below.begin(), interface.below.end());
  return out;
}

SweptBody bonded(SweptBody body) {
  const int block = body.contact.block;
  for (const SplitInterface& interface : body.interfaces)
    each_pair(interface, body.contact, [&](int above, int below) {
      body.ties.push_back({block, below, block, above, above, 0.0});
    });
  body.interfaces.clear();
  return body;
}

}  // namespace railstrata
