#pragma once
// A half-space of elastic layers, bonded to each other or joined by springs.
//
// In the Fourier domain every layer carries two decaying and two growing waves in depth; the growing ones are measured
// from the layer's bottom, so that no exponential exceeds one, and are found from the interface below as reflections of
// the decaying ones (a recursion from the substrate up). Any thickness, any modulus ratio, also Poisson's ratio 1/2.
// [ChenEngel1972]
#include <vector>

#include "halfspace/boussinesq_cerruti.hpp"

namespace railstrata {

/// An interface as a bed of springs: the jump of displacement, lower minus upper side, over the traction across it,
/// m/Pa. Faces stay together under tension too. 0: bonded; shear infinite: smooth.
struct Bond {
  double normal = 0, shear = 0;
  bool gives() const { return normal > 0 || shear > 0; }
  friend bool operator==(const Bond&, const Bond&) = default;
};

struct HalfSpaceLayer {
  double thickness = 0;  ///< m
  HalfSpaceMaterial material;
  bool continues = false;  ///< one cut of a graded layer that goes on below: its bottom is no interface
  double young_slope = 0,
         poisson_slope = 0;  ///< of the graded material within the cut, 1/m of depth; `material` is its mean
  Bond bond = {};            ///< of its bottom
  /// The graded material at a depth below the cut's top.
  HalfSpaceMaterial local(double depth) const {
    const double from_middle = depth - 0.5 * thickness;
    return {material.young + young_slope * from_middle, material.poisson + poisson_slope * from_middle};
  }
};

/// Layers from the surface down on a homogeneous substrate. No layers: homogeneous.
struct LayeredHalfSpace {
  std::vector<HalfSpaceLayer> layers;
  HalfSpaceMaterial substrate;
};

/// Length over which the layers above an interface that gives spread a pressure by bending, (D c_n)^(1/4), m: the
/// longest; 0 without springs.
double bending_length(const LayeredHalfSpace& body);

/// An interface belongs to the layer above.
HalfSpaceMaterial material_at(const LayeredHalfSpace& body, double depth);

/// The layers as they were laid, from the surface down: cuts of a graded one joined. Depths in m.
struct LayerExtent {
  double top = 0, bottom = 0;
};
std::vector<LayerExtent> layer_extents(const LayeredHalfSpace& body);

/// The four surface compliances at wave number k > 0 [1/m], times k [1/Pa] (boussinesq_cerruti.hpp).
CompliancePoint layered_compliance_at(const LayeredHalfSpace& body, double k);

/// The surface compliance as the top material's closed form plus images at depths spread geometrically over the scales
/// of the stack, fitted to layered_compliance_at. `tolerance`: largest deviation of zz, rr, tt relative to themselves
/// and of rz relative to sqrt(zz rr), at any wave number; throws NumericalError if it cannot be met. On interfaces that
/// give it is met where the springs are at least k_n h = 0.1 E; a layer that bends on softer ones is thousands of
/// times softer than its material, and a hundred times the tolerance is allowed for rounding. A smooth layer is held by
/// springs over which it stretches within 1 m: a layer without end would hold no tangential force.
SurfaceCompliance layered_compliance(const LayeredHalfSpace& body, double tolerance = 1e-6);

/// A modulus that varies with depth, given as a table with increasing depths from 0 (linear between, the substrate
/// below the last).
struct GradedPoint {
  double depth = 0;
  HalfSpaceMaterial material;
};
/// Cuts the table into layers of constant modulus (its mean over the layer) so that within each the modulus changes by
/// at most the factor 1 + tolerance (Poisson's ratio by about the tolerance). Displacements, strains in plan and
/// tractions that vary slowly over a layer err with the square of the tolerance, and so do all stresses that are taken
/// with the local modulus. All but the last layer continue below. Throws CaseError for fewer than two rows, a first
/// depth other than 0 and depths that do not increase.
std::vector<HalfSpaceLayer> cut_into_layers(const std::vector<GradedPoint>& table, double tolerance = 0.02);

}  // namespace railstrata
