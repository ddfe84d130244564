#pragma once
// What is not the profile carried along: heights of the running surfaces of rail and wheel, as a field of the way.
//
// z(x, y) is a height along the surface's normal, positive out of the body; x the way from the first contact (of the
// wheel the arc of its circumference, which comes again after a turn), y the distance to the field side from there.
// Each shape is z(x, y) = h(x - at) c(y - offset), c = (1 + cos(2 pi y/width))/2 within the width and 0 beyond, 1
// without a width. With the length L, the depth d (peak to valley) and the wavelength l:
//   indentation   h = -d/2 (1 + cos(2 pi x/L)) within L/2
//   corrugation   h = d/2 cos(2 pi x/l), eased in and out over one wave within from and to
//   dip           h = -(a r/4) (1 - |x|/r)^2, parabola, or -(a r/2) (1 - |x|/r), line: ramps r that meet at the angle a
//   step          h = s/2 (1 + sin(pi x/L)) within L/2, 0 before and s behind: the next rail lies higher or lower
//   flat          the chord h = -((L/2)^2 - x^2)/(2 R) within L/2; with a depth the indentation's shape, worn round
//   out_of_round  h = d/2 cos(n x/R)
//   roughness     a sum of cosines of the density S(k) ~ k^-e between the wave numbers 1/longest and 1/shortest, whose
//                 root mean square is given, of random phases; eased over the longest wave within from and to
//   file          heights at points, in x by cubics through them (slopes of their neighbours), in y linear; beyond the
//                 first and the last of them their heights go on
#include <vector>

#include "geometry/irregularity.hpp"

namespace railstrata {

struct SurfaceHeight {
  double z = 0;      ///< m
  double along = 0;  ///< dz/dx
};

/// The sum of a body's irregularities.
class HeightField {
 public:
  HeightField() = default;
  HeightField(const std::vector<Irregularity>& all, BodyId on, double wheel_radius);

  bool none() const { return parts_.empty(); }
  SurfaceHeight at(double x, double y) const;

 private:
  struct Wave {
    double number, amplitude, phase;  ///< rad/m, m, rad
  };
  /// Heights along one line of a file.
  struct Line {
    double y = 0;
    std::vector<double> x, z, slope;
    SurfaceHeight at(double x) const;
  };
  struct Part {
    Irregularity is;
    double wheel_radius = 0;
    std::vector<Wave> waves;  // of roughness
    std::vector<Line> lines;  // of a file
    SurfaceHeight along(double x, double y) const;
    SurfaceHeight of_lines(double x, double y) const;
  };
  std::vector<Part> parts_;
};

/// Where along the body a shape is, m; infinite where it has no ends.
struct Extent {
  double from, to;
};
Extent extent_of(const Irregularity& is);
/// m: of the shortest wave or the whole of a single shape (a step is half a wave); infinite for a file.
double shortest_wave(const Irregularity& is, double wheel_radius);
/// The largest |dz/dx|.
double steepest_slope(const Irregularity& is, double wheel_radius);
/// m, how much farther from the axle a wheel may touch because of heights: where their slopes are its own, at most half
/// the length of each, of a step where it would touch a sharp one.
double contact_reach(const std::vector<Irregularity>& irregularities, double wheel_radius);

}  // namespace railstrata
