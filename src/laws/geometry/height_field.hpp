#pragma once
// Heights of the running surfaces of rail and wheel (geometry/irregularity.hpp), as a field of the way.
#include <vector>

#include "geometry/irregularity.hpp"

namespace railstrata {

/// The sum of a body's irregularities.
class HeightField {
 public:
  HeightField() = default;
  HeightField(const std::vector<Irregularity>& all, BodyId on, double wheel_radius);

  bool none() const { return parts_.empty(); }
  SurfaceHeight at(double x, double y) const;

 private:
  struct Part {
    Irregularity is;
    double round = 0;  ///< m, of the wheel's circumference; 0: on the rail
    Heights height;
  };
  std::vector<Part> parts_;
};

Extent extent_of(const Irregularity& is);
/// m: of the shortest wave or the whole of a single shape; infinite for points.
double shortest_wave(const Irregularity& is, double wheel_radius);
/// The largest |dz/dx|.
double steepest_slope(const Irregularity& is, double wheel_radius);
/// m, how much farther from the axle a wheel may touch because of heights: where their slopes are its own, at most half
/// the length of each, of a step where it would touch a sharp one.
double contact_reach(const std::vector<Irregularity>& irregularities, double wheel_radius);

}  // namespace railstrata
