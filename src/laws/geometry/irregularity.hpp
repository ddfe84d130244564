#pragma once
// What is not the profile carried along: a height of the running surface, as a case has it; what its numbers mean is in
// geometry/height_field.hpp.
#include <optional>
#include <string>
#include <vector>

#include "core/body_id.hpp"

namespace railstrata {

enum class IrregularityKind { indentation, corrugation, dip, step, flat, out_of_round, roughness, file };
enum class RampShape { parabola, line };

/// One of them, as a case has it; lengths in metres.
struct Irregularity {
  BodyId on = BodyId::rail;
  IrregularityKind kind = IrregularityKind::indentation;
  std::optional<double> at, from, to;
  std::optional<double> length, wavelength, depth, width;
  double offset = 0;
  std::optional<double> height;  ///< of a step
  int order = 1;                 ///< n
  std::optional<double> angle;   ///< a, rad: of both ramps together
  double ramp = 1;               ///< r
  RampShape shape = RampShape::parabola;
  std::optional<double> rms, shortest, longest;
  double exponent = 2;  ///< e
  int seed = 1;
  std::string file;             ///< empty once it is read into x, y and z
  double smoothing = 0;         ///< of x, y, z: length of the mean with cosine weights along x; 0: as they are
  std::vector<double> x, y, z;  ///< points of a file; y empty: the same across, else every x at every y
};

}  // namespace railstrata
