#pragma once
// Mesh data of the elements (element/swept_hex.hpp, element/plastic_hex.hpp), computed once before the run.
#include <array>

#include "core/vec.hpp"
#include "element/plastic_hex.hpp"
#include "material/elastic.hpp"
#include "mesh/swept.hpp"

namespace railstrata {

using HourglassStiffness = std::array<double, kHourglassEntries>;
using QuadReference = HexReference<double>;

/// The two numbers by which a station spacing scales the reference shape.
struct SweepScale {
  double sigma, c;
};
SweepScale sweep_scale(SweepKind kind, double spacing);
/// The same as the element class reads it.
StationScale<double> station_scale(SweepScale scale);

enum class ElementKind { full, one_point };

/// Corner coordinates of the element in its own frame, 0–3 at -a, 4–7 at +a.
std::array<Vec3, 8> local_corners(SweepKind kind, const std::array<Vec2, 4>& quad, SweepScale scale);

QuadReference quad_reference(SweepKind kind, const std::array<Vec2, 4>& quad, const Elastic& material);
/// Rounded to single precision.
HexReference<float> rounded(const QuadReference& reference);

HourglassStiffness hourglass_stiffness(SweepKind kind, const std::array<Vec2, 4>& quad, SweepScale scale,
                                       const Elastic& material, ElementKind element, double kappa);

/// Row-sum lumped masses of the eight corners, kg; corner k at -a and at +a have the same.
std::array<double, 4> corner_masses(SweepKind kind, const std::array<Vec2, 4>& quad, SweepScale scale, double density);

/// 2 / omega_max of the free element with lumped mass: a lower bound of the whole mesh's stable step
/// [Hughes2000 ch. 9].
double element_stable_step(SweepKind kind, const std::array<Vec2, 4>& quad, SweepScale scale, const Elastic& material,
                           const HourglassStiffness& hourglass);

/// Of elements that yield.
GaussShape<double> gauss_shape(SweepKind kind, const std::array<Vec2, 4>& quad);

/// For one station spacing, as the hourglass stiffness.
IncompatibleModes<double> incompatible_modes(SweepKind kind, const std::array<Vec2, 4>& quad, SweepScale scale,
                                             const Elastic& material);

}  // namespace railstrata
