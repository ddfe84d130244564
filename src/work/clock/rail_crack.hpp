#pragma once
// The crack that follows the first failure of a rail's metal: growth by the traffic as it comes, less what wear and
// grinding take off its mouth.
//
// It breaks the surface where the metal failed first, at crack.angle, and goes down in the direction in which it grows
// fastest. Each load's growth is that of its stresses on the profile of the day (fatigue/crack_summary.hpp), with the
// residual stress that its process and the passes have left; loads of all kinds add up by their numbers. While the
// metal there has failed it is never shallower than crack.depth: a crack that wears away begins again. With crack.place
// it is there from the beginning, and no metal needs to fail. Growth ends at crack.allowable.
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "clock/gathered_damage.hpp"
#include "clock/worn_profile.hpp"
#include "collective/collective.hpp"
#include "fatigue/crack_summary.hpp"
#include "passes/metal.hpp"
#include "spec/crack_spec.hpp"

namespace railstrata {

struct ClockMoment;  // clock/clock.hpp

struct RailCrack {
  static constexpr double kNot = std::numeric_limits<double>::infinity();
  double s = 0, tip = 0;  ///< m, of the unworn rail: its place across, and how deep its end lies
  double azimuth = std::numeric_limits<double>::quiet_NaN();  ///< rad; NaN: it has not chosen yet
  double begun = kNot, detectable = kNot, allowable = kNot;   ///< kg, gross traffic by which it was so deep
  bool there() const { return begun < kNot; }
};

/// A patch of a kind of wheels that rolls over the crack, or near it.
struct CrackLoad {
  double share = 0;  ///< of all wheels
  LayeredHalfSpace rail;
  PlaneOfRolling plane;
};

/// What a crack lies in.
struct CrackedRail {
  const RailCrack& crack;
  const WornProfile& surface;
  const Metal& metal;
};
/// The patches of solved rows that roll over the crack or near it, with the residual stress of their process and of the
/// passes; none once it is as deep as is allowed. wheels: of all rows.
std::vector<CrackLoad> crack_loads(const CrackSpec& crack, const std::vector<CollectiveRow>& rows, double wheels,
                                   const CrackedRail& rail);

/// Begins where the metal has failed first by strain; kilograms: of a wheel.
void begin_crack(const CrackSpec& crack, const Gathered& damage, const WornProfile& surface, double kilograms,
                 RailCrack& rail);

/// Growth of the crack by the loads of a day.
class CrackGrowth {
 public:
  CrackGrowth(const CrackSpec& crack, std::vector<CrackLoad> loads) : crack_(crack), loads_(std::move(loads)) {}
  /// m of depth, by one wheel of the mixture; linear between depths that grow by kApart.
  double rate(double depth);
  void turn(double azimuth);

 private:
  static constexpr double kApart = 1.2;
  double at_step(int step);
  CrackSpec crack_;
  std::vector<CrackLoad> loads_;
  std::map<int, double> known_;
};

/// The crack after so many wheels, while the surface at its place sinks from one depth to the other [m of the unworn
/// rail]. from: kg of gross traffic before, each: kg of a wheel.
struct CrackStep {
  double wheels = 0, before = 0, after = 0;
  double from = 0, each = 0;
};
void grow(const CrackSpec& crack, CrackGrowth& growth, const CrackStep& step, RailCrack& rail);

/// Gives a crack without a direction that of the case, or the one in which it grows fastest.
void take_direction(const CrackSpec& crack, CrackGrowth& growth, RailCrack& rail);

/// What the crack did, for people; empty: there is none.
std::string crack_note(const CrackSpec& crack, const RailCrack& rail, const std::vector<ClockMoment>& history);

}  // namespace railstrata
