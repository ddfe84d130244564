#pragma once
// Tables that the elements of a block read while forces are computed: by quadrilateral, by station, and the hourglass
// stiffness by both.
//
// Elements along the sweep have their own spacing and share the hourglass stiffness of their group: where the mesh is
// graded that of its shortest element (a stiffer one would shorten the stable step).
#include <array>
#include <vector>

#include "core/array.hpp"
#include "element/reference.hpp"
#include "mesh/layout.hpp"

namespace railstrata {

/// Arithmetic of the elements while rolling; nodal values are kept in double precision. `single` wants displacements
/// that are small against the body: relative to a frame that moves with it.
enum class Precision { double_precision, single_precision };

struct ElementOptions {
  ElementKind element = ElementKind::full;
  double hourglass_coefficient = 0.05;
  Precision precision = Precision::double_precision;
};

inline constexpr int kHourglassGroup = 8;  ///< elements that share one hourglass stiffness; whole packs of doubles

/// Tables in the number type of the arithmetic. Lines by station are padded with zeros to whole packs.
template <class Real>
struct ElementTable {
  using Line = std::vector<Real, CacheLineAllocator<Real>>;
  std::vector<HexReference<Real>> quads;
  std::vector<std::array<Real, kHourglassEntries>> hourglass;  ///< [class * quads + quad]; zero for the padding
  Line inv_sigma, inv_c, v1, v2, v3;                           ///< StationScale by element
  Line sigma, c;                                               ///< the same

  /// read(pointer): a number or a pack.
  template <class T, class Read>
  StationScale<T> scale(int e, Read&& read) const {
    return {read(&inv_sigma[e]), read(&inv_c[e]), read(&v1[e]), read(&v2[e]),
            read(&v3[e]),        read(&sigma[e]), read(&c[e])};
  }
};

struct SpacingClass {
  double spacing;
  int hourglass;
  friend bool operator==(const SpacingClass&, const SpacingClass&) = default;
};

struct BlockElements {
  ElementTable<double> table;
  ElementTable<float> single;  ///< empty in double precision
  template <class Real>
  const ElementTable<Real>& of() const {
    if constexpr (std::is_same_v<Real, float>)
      return single;
    else
      return table;
  }
  std::vector<int> hourglass_class;   ///< per group of elements
  std::vector<SpacingClass> classes;  ///< all that occur
  std::vector<int> element_class;     ///< per element, index into classes
  Field theta, cos_q, sin_q;          ///< angle of the element centres; Q of the element class, zero if extruded
};

/// Corners of a quadrilateral, section coordinates.
std::array<Vec2, 4> quad_corners(const Section& section, int quad);

BlockElements block_elements(SweepKind kind, const Block& block, const BlockLayout& layout,
                             const std::vector<Elastic>& materials, const ElementOptions& options);

}  // namespace railstrata
