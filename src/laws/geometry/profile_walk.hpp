#pragma once
// Walks along a profile over many places: the values of Profile::at and Profile::height at each, for a tenth of the
// work. Arcs are walked by turning the arm to their centre and looked at as a whole where that is enough.
#include <cstddef>
#include <vector>

#include "geometry/profile.hpp"

namespace railstrata {

/// Positions at the arc lengths begin + k step, k = 0 … count - 1, to 1e-14 of a radius. Throws as Profile::at.
std::vector<Vec2> even_positions(const Profile& profile, double begin, double step, std::size_t count);

/// How far a curve faces a direction: the last of the places begin + k step (step < 0: towards smaller s), before the
/// curve ends, up to which all of them from k = 1 on have tangents t with t·direction > cosine. cosine: 0 or more.
double last_facing(const Profile& profile, double begin, double step, Vec2 direction, double cosine);

/// The running surface at one y: z and dz/dy.
struct SurfacePlace {
  double height, slope;
};
SurfacePlace place_on(const Profile& profile, double y);

/// Places of the running surface: fast where one y lies near the one before. Keeps the profile by reference.
class RunningSurface {
 public:
  explicit RunningSurface(const Profile& profile);
  /// y within [y_min, y_max].
  SurfacePlace place(double y);
  /// As Profile::height.
  double height(double y) { return place(y).height; }

 private:
  struct Piece {
    Vec2 begin, centre;
    double end_y, slope, radius, side;  // radius 0: a line; side: of the centre the arc lies on, 1 above
  };
  const Profile& profile_;
  std::vector<Piece> pieces_;  // of an exact curve
  std::size_t at_ = 0;
};

}  // namespace railstrata
