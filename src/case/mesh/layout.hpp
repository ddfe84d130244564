#pragma once
// Where the values of a nodal vector field stand in memory: for every block [section node][component][station],
// stations contiguous and padded to whole packs, so that lines of elements load their corners as plain vectors. A
// closed ring keeps a ghost of station 0 behind its last station. Padding is zero.
#include "core/array.hpp"
#include "mesh/swept.hpp"

namespace railstrata {

struct BlockLayout {
  std::ptrdiff_t offset = 0;
  int stride = 0;    ///< between components; a node takes 3 strides
  int nodes = 0;     ///< section nodes
  int stations = 0;  ///< without ghost
  int elements = 0;  ///< along the sweep
  bool closed = false;
  std::ptrdiff_t line(int node, int component) const {
    return offset + (static_cast<std::ptrdiff_t>(node) * 3 + component) * stride;
  }
};

struct BodyLayout {
  std::vector<BlockLayout> blocks;
  std::ptrdiff_t size = 0;
  Field field() const { return Field(static_cast<std::size_t>(size), 0.0); }
};

/// x, y and z of a node, from the index of its component x; stride: BlockLayout::stride.
inline Vec3 vector_at(const Field& f, std::ptrdiff_t x, int stride) { return {f[x], f[x + stride], f[x + 2 * stride]}; }
inline void add_vector(Field& f, std::ptrdiff_t x, int stride, Vec3 v) {
  f[x] += v.x;
  f[x + stride] += v.y;
  f[x + 2 * stride] += v.z;
}

BodyLayout layout_of(const SweptBody& body);

}  // namespace railstrata
