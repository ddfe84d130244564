#include "mesh/layer_stacks.hpp"

#include <algorithm>
#include <numbers>

namespace railstrata {
namespace {

constexpr double kSameDepth = 1e-9;  // m

/// Which layers there are at some place.
using Present = std::vector<bool>;

bool any_ends(const std::vector<LayerMesh>& layers) {
  return std::any_of(layers.begin(), layers.end(), [](const LayerMesh& l) { return l.ends(); });
}

Present present_at(const std::vector<LayerMesh>& layers, double x) {
  Present out;
  for (const LayerMesh& l : layers) out.push_back(l.from <= x && x < l.to);
  return out;
}

/// Every stack that occurs.
std::vector<Present> all_stacks(const std::vector<LayerMesh>& layers) {
  std::vector<double> ends;
  for (const LayerMesh& l : layers)
    for (double x : {l.from, l.to})
      if (std::isfinite(x)) ends.push_back(x);
  std::sort(ends.begin(), ends.end());
  std::vector<Present> out{present_at(layers, ends.front() - 1)};
  for (double x : ends) out.push_back(present_at(layers, x));
  return out;
}

struct Interval {
  double top, bottom;
};
/// Depths of the layers of a stack; of one that is not there an empty interval.
std::vector<Interval> depths_of(const std::vector<LayerMesh>& layers, const Present& present) {
  const std::vector<double> bottoms = layer_bottoms(layers);
  std::vector<Interval> out;
  double top = 0;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const double bottom = present[k] ? bottoms[k] : top;
    out.push_back({top, bottom});
    top = bottom;
  }
  return out;
}

/// Depths at which any stack has an interface, from 0.
std::vector<double> slab_ends(const std::vector<LayerMesh>& layers) {
  std::vector<double> all{0.0};
  for (const Present& stack : all_stacks(layers))
    for (const Interval& layer : depths_of(layers, stack)) all.push_back(layer.bottom);
  std::sort(all.begin(), all.end());
  const auto same = [](double a, double b) { return b - a < kSameDepth; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

/// Elements that the layers ask of a slab: the most of any that covers it; 0: chosen.
int elements_of(const std::vector<LayerMesh>& layers, const Interval& slab) {
  int most = 0;
  for (const Present& stack : all_stacks(layers)) {
    const std::vector<Interval> depths = depths_of(layers, stack);
    for (std::size_t k = 0; k < layers.size(); ++k) {
      if (depths[k].top > slab.top + kSameDepth || depths[k].bottom < slab.bottom - kSameDepth) continue;
      const double share = (slab.bottom - slab.top) / layers[k].thickness;
      most = std::max(most, static_cast<int>(std::ceil(layers[k].elements * share - 1e-6)));
    }
  }
  return most;
}

/// Material of every slab in a stack: 0 the matrix, k the k-th layer.
std::vector<int> materials_of(const std::vector<LayerMesh>& layers, const std::vector<double>& ends,
                              const Present& stack) {
  const std::vector<Interval> depths = depths_of(layers, stack);
  std::vector<int> out{0};  // of what is no slab
  for (std::size_t s = 0; s + 1 < ends.size(); ++s) {
    const double middle = 0.5 * (ends[s] + ends[s + 1]);
    const auto in = std::find_if(depths.begin(), depths.end(),
                                 [&](const Interval& d) { return d.top < middle && middle < d.bottom; });
    out.push_back(in == depths.end() ? 0 : static_cast<int>(in - depths.begin()) + 1);
  }
  return out;
}

/// The stack of an element; a ring has the same one a turn before and after.
Present stack_of(const std::vector<LayerMesh>& layers, const Stations& stations, int element, double metres) {
  const double centre = stations.centre(element), turn = stations.closed ? 2 * std::numbers::pi : 0;
  Present out = present_at(layers, metres * centre);
  for (int way : {-1, 1}) {
    const Present there = present_at(layers, metres * (centre + way * turn));
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = out[k] || there[k];
  }
  return out;
}

void set_block(Block& block, const std::vector<LayerMesh>& layers, const std::vector<double>& ends, double metres) {
  std::vector<Present> known;
  std::vector<int> of_element;
  for (int e = 0; e < block.stations.elements(); ++e) {
    const Present stack = stack_of(layers, block.stations, e, metres);
    const auto at = std::find(known.begin(), known.end(), stack);
    of_element.push_back(static_cast<int>(at - known.begin()));
    if (at == known.end()) known.push_back(stack);
  }
  std::vector<std::vector<int>> sets;
  for (const Present& stack : known) {
    const std::vector<int> material = materials_of(layers, ends, stack);
    sets.emplace_back();
    for (int slab : block.section.quad_material) sets.back().push_back(material[static_cast<std::size_t>(slab)]);
  }
  block.section.quad_material = sets.front();
  const bool alike = std::all_of(sets.begin(), sets.end(), [&](const auto& s) { return s == sets.front(); });
  if (!alike) block.along = {std::move(sets), std::move(of_element)};
}

}  // namespace

std::vector<double> layer_bottoms(const std::vector<LayerMesh>& layers) {
  std::vector<double> out;
  for (const LayerMesh& layer : layers) {
    double top = 0;
    for (std::size_t i = 0; i < out.size(); ++i)
      if (layers[i].from < layer.to && layer.from < layers[i].to) top = std::max(top, out[i]);
    out.push_back(top + layer.thickness);
  }
  return out;
}

std::vector<LayerMesh> slabs_of(const std::vector<LayerMesh>& layers) {
  if (!any_ends(layers)) return layers;
  const std::vector<double> ends = slab_ends(layers);
  std::vector<LayerMesh> out;
  for (std::size_t s = 0; s + 1 < ends.size(); ++s) {
    LayerMesh slab;
    slab.name = "slab";
    slab.thickness = ends[s + 1] - ends[s];
    slab.width = layers.front().width;
    slab.elements = elements_of(layers, {ends[s], ends[s + 1]});
    out.push_back(slab);
  }
  return out;
}

void set_stacks(SweptBody& body, const std::vector<LayerMesh>& layers, double metres) {
  if (!any_ends(layers)) return;
  const std::vector<double> ends = slab_ends(layers);
  for (Block& block : body.blocks) set_block(block, layers, ends, metres);
}

}  // namespace railstrata
