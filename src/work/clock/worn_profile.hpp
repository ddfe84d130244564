#pragma once
// The surface of a rail that wears: points that began on the unworn profile and move inwards along the normal of the
// day, and how far each has moved.
#include <vector>

#include "fatigue/rail_damage.hpp"
#include "model/model.hpp"

namespace railstrata {

/// What changes of it. m
struct WornSurface {
  bool moved = false;
  std::vector<Vec2> points;            ///< frame of the unworn profile
  std::vector<double> day_s, removed;  ///< of the points
  double gauge_widening = 0;
};

class WornProfile {
 public:
  /// Points at most `cell` [m] apart.
  WornProfile(const Placement& unworn, double cell);

  const Profile& profile() const { return profile_; }
  /// m, that the gauge has become wider.
  double gauge_widening() const { return now_.gauge_widening; }
  /// m, of the points: arc length on the unworn profile and on that of the day, and the metal above them that is gone.
  const std::vector<double>& unworn_s() const { return unworn_s_; }
  const std::vector<double>& removed() const { return now_.removed; }
  const std::vector<Vec2>& points() const { return now_.points; }
  /// m, of an arc length of the unworn profile, or the other way round.
  double day_s(double unworn_s) const;
  double unworn_s_of(double day_s) const;
  /// m, at an arc length of the unworn profile.
  double removed_at(double unworn_s) const;

  /// Wears the cells of `cells` (of the profile of the day) by so much [m].
  void wear(const ProfileWear& cells, const std::vector<double>& depth);
  /// Takes so much off everywhere.
  void grind(double depth);

  const WornSurface& worn() const { return now_; }
  /// The surface of the same rail as it was before.
  void stand(WornSurface before);

 private:
  std::vector<Vec2> shape();
  void move(const std::vector<double>& depth);

  Placement unworn_;
  Profile profile_;
  std::vector<double> unworn_s_;
  WornSurface now_;
};

}  // namespace railstrata
