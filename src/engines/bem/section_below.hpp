#pragma once
// What the section of a body changes in the states below its contact.
//
// S(k) gives the states of the real section by waves of line loads on stations of its surface, less those of a large
// block with the same layers on the same elements, whose local error falls out with it; where a layer ends or varies
// nearby, less those of a block of one material, with the strains of the material at each place. Under the tractions τ,
//   s(x) = 1/pi Re ∫ S(k) τ(k) e^{ikx} dk,   τ(k) = sum over the cells of force e^{-ikx}.
// Depths count along the surface's normal, below the last row of elements the state of that row stands.
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "bem/section_remainder.hpp"
#include "bem/subsurface.hpp"
#include "core/lagrange.hpp"

namespace railstrata {

/// A body in its contact plane and what acts on it, in its own axes.
struct LoadedSection {
  std::vector<InteriorShare> kept;
  SectionPlane plane;
  PatchGrid grid;
  PlaneLoads loads;
};

class SectionBelow {
 public:
  /// grid: where states are asked for.
  SectionBelow(std::shared_ptr<const LoadedSection> section, const PatchGrid& grid);
  /// The same for states on another grid.
  std::unique_ptr<SectionBelow> on(const PatchGrid& grid) const;
  void add(StatePlane& plane) const;
  /// The layers are in it: what it is added to is the substrate's half-space.
  bool in_full() const { return section_->kept.front().difference->block_young > 0; }
  /// Of a section in full: the element at a place of the plane, m. below_interface: where the depth is one of them.
  const BandElement& element_at(double y, double depth, bool below_interface) const;
  /// m, the lowest side of a layer's elements.
  double bottom_of(int layer) const;

 private:
  struct Part {
    const SectionInterior* of;
    std::vector<double> y;       // m in the plane, of the columns
    Eigen::MatrixXd real, imag;  // as SectionInterior's rows; by wave
  };
  LagrangeStencil columns_at(const Part& part, double y, double depth) const;
  void add_part(const InteriorShare& kept);
  std::shared_ptr<const LoadedSection> section_;
  PatchGrid grid_;
  std::vector<double> k_;
  std::vector<Part> parts_;
  Eigen::MatrixXd cos_, sin_;  // by wave and column of cells
};

}  // namespace railstrata
