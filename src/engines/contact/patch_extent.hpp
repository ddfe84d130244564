#pragma once
// How far a patch reaches, and in how many parts: from the pressures of a field of either engine.
#include <vector>

#include "contact/contact_field.hpp"

namespace railstrata {

/// Share of the largest pressure: areas and ratios of finite elements leave out points with less.
inline constexpr double kPressureNoise = 0.025;

/// A row of points from the first to the last in contact, between the edges where p² extrapolates to zero, as Hertz's
/// pressure does; gaps between them included. Of five and more values at points (ContactField::at_points) an edge is
/// where Hertz's pressure has the force of the two outermost: they are means over elements that reach beyond the edge.
struct Chord {
  double begin = 0, end = 0;  ///< m
  bool any = false;
  double length() const { return end - begin; }
};

/// Where a quantity of points t_in, t_last vanishes beyond its last value, t_out at most: its square is linear near the
/// edge of a smooth contact.
double vanishing_place(double t_in, double p_in, double t_last, double p_last, double t_out);

/// Along x, of a column.
Chord chord_along(const ContactField& field, int column);

struct PatchExtent {
  double length = 0, width = 0;  ///< m, of the longest chords along x and across
  std::vector<Chord> along;      ///< of every column
  Chord widest;                  ///< across
  int first = -1, last = -1;     ///< outermost columns in contact; -1: none
};
PatchExtent patch_extent(const ContactField& field);

/// A patch on a wheel's way over heights of rail or wheel.
struct PatchOnWay {
  double length = 0, width = 0;  ///< m, as of PatchExtent
  double p_max_x = 0;            ///< m, along the rail from where the wheel began
  double patches = 0;            ///< connected regions
  double height = 0;             ///< m, of rail and wheel together below the axle
  double lowering = 0;           ///< m, of the axle below where the wheel would touch the smooth rail without load
};

/// For every point, columns next to each other, the number of its connected region from 0 on, or kNone: p is not above
/// `least`. Points touch at corners too.
struct ConnectedRegions {
  static constexpr int kNone = -1;
  std::vector<int> of;
  int count = 0;
};
ConnectedRegions connected_regions(int columns, const std::vector<double>& p, double least);

/// Connected regions of points in contact: a wheel that bridges a hollow has two.
int contact_regions(const ContactField& field);

}  // namespace railstrata
