#pragma once
// Tables that the elements of a block read while forces are computed: by quadrilateral, by station, and the hourglass
// stiffness by both.
//
// Where the materials of a section change along the sweep, references and hourglass stiffnesses stand there once for
// every set of materials (MaterialSets of the block), one set after the other.
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
  Precision precision = Precision::double_precision;
};

inline constexpr double kHourglassCoefficient = 0.05;  ///< kappa of one_point (element/swept_hex.hpp)
inline constexpr int kHourglassGroup = 8;  ///< elements that share one hourglass stiffness; whole packs of doubles

/// Tables in the number type of the arithmetic. Lines by station are padded with zeros to whole packs.
template <class Real>
struct ElementTable {
  using Line = std::vector<Real, CacheLineAllocator<Real>>;
  std::vector<HexReference<Real>> quads;                       ///< [set * quads + quad]
  std::vector<std::array<Real, kHourglassEntries>> hourglass;  ///< [(set * classes + class) * quads + quad]
  Line inv_sigma, inv_c, sigma_c, sigma, c;                    ///< StationScale by element
  static constexpr std::array<Line ElementTable::*, 5> kLines{
      &ElementTable::inv_sigma, &ElementTable::inv_c, &ElementTable::sigma_c, &ElementTable::sigma, &ElementTable::c};

  /// read(pointer): a number or a pack.
  template <class T, class Read>
  StationScale<T> scale(int e, Read&& read) const {
    return {read(&inv_sigma[e]), read(&inv_c[e]), read(&sigma_c[e]), read(&sigma[e]), read(&c[e])};
  }
};

struct SpacingClass {
  double spacing;
  int hourglass;
  int set = 0;  ///< of materials
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
  int quads = 0, hourglass_classes = 0;  ///< in each set of materials
  std::vector<int> set;                  ///< of materials, per element and to the end of the padding; empty: one set
  std::vector<char> varies;              ///< per quadrilateral: not the same material in all sets; empty: one set
  std::vector<int> hourglass_class;      ///< per group of elements
  std::vector<SpacingClass> classes;     ///< all that occur
  std::vector<int> element_class;        ///< per element, index into classes
  Field theta, cos_q, sin_q;             ///< angle of the element centres; Q of the element class, zero if extruded

  bool varies_at(int quad) const { return !varies.empty() && varies[static_cast<std::size_t>(quad)]; }
  int set_at(int element) const { return set.empty() ? 0 : set[static_cast<std::size_t>(element)]; }
  std::size_t reference(int at_set, int quad) const { return static_cast<std::size_t>(at_set) * quads + quad; }
  std::size_t hourglass(int at_set, int cls, int quad) const {
    return (static_cast<std::size_t>(at_set) * hourglass_classes + cls) * quads + quad;
  }
  std::size_t hourglass(const SpacingClass& c, int quad) const { return hourglass(c.set, c.hourglass, quad); }
};

/// Corners of a quadrilateral, section coordinates.
std::array<Vec2, 4> quad_corners(const Section& section, int quad);

BlockElements block_elements(SweepKind kind, const Block& block, const BlockLayout& layout,
                             const std::vector<Elastic>& materials, const ElementOptions& options);

}  // namespace railstrata
