#pragma once
// The stress of a history at any point: what a single track asks for where only samples are there.
#include <vector>

#include "damage/stress_history.hpp"
#include "single_track/single_track.hpp"

namespace railstrata {

/// Cubic between samples along x, y and depth (through the four next ones, fewer at an end; never across an interface,
/// which is a depth that stands in two rows). Exact for cubics; the error falls with the fourth power of the distance
/// of samples where the stress is smooth. Outside of the samples the stress of the point that the ray to `centre` (on
/// the surface) leaves them at, times (its distance / the point's)^2: as below a point force on a half-space.
class HistoryStress {
 public:
  /// `history` stays where it is. Throws std::invalid_argument for one that is empty or begins below the surface, and
  /// for a centre that is not inside.
  HistoryStress(const StressHistory& history, double centre_x, double centre_y);

  Sym3 at(Vec3 point, bool below_interface) const;
  std::vector<Sym3> operator()(const std::vector<Vec3>& points, bool below_interface) const;
  /// m, depths of the interfaces.
  std::vector<double> interfaces() const;
  /// A quantity of the rows at a depth, linear between them.
  double of_rows(const std::vector<double>& values, double depth, bool below_interface) const;

 private:
  struct Span {
    int first = 0, count = 0;  ///< rows between two interfaces
  };
  Span span_at(double depth, bool below_interface) const;
  const StressHistory* history_;
  double centre_x_, centre_y_;
  std::vector<Span> spans_;
};

/// A single track on the stresses of a history, strengths per row (Pa). The history must outlive what is returned.
SingleTrackInput single_track_input(const StressHistory& history, std::vector<double> shear_strength,
                                    double half_length, double half_width, double centre_x = 0, double centre_y = 0);

}  // namespace railstrata
