#pragma once
// Where the wheel stands on the rail: track gauge, cant, lateral shift, and the rigid first contact point.
//
// Model frame: x rolling direction, y lateral, positive to the field side (a left-hand wheel, so that x, y, z is
// right-handed), z up. Its origin is the crown point of the (canted) rail in the plane of the wheel's start.
#include <limits>
#include <memory>
#include <vector>

#include "core/rotation.hpp"
#include "geometry/profile.hpp"

namespace railstrata {

/// Inputs of the placement. All lengths in metres.
struct TrackGeometry {
  double gauge = 1.435;                ///< between the gauge faces
  double gauge_depth = 0.016;          ///< below the top of the canted rail, where the gauge is measured
  double back_to_back = 1.353;         ///< between the wheels' inner faces
  double flange_back_to_tape = 0.070;  ///< from the flange back to the tape circle
  double cant = 1.0 / 40.0;            ///< tangent of the rail's inclination towards the track centre
  double lateral_shift = 0.0;          ///< of the wheel to the field side
  double wheel_radius = 0.430;         ///< nominal, at the tape circle
  double yaw = 0.0;   ///< tangent of the angle by which the wheel's rolling direction is turned to the field side
  double roll = 0.0;  ///< tangent of the angle by which the wheel is turned about x, positive with its field side up
  double rail_radius = kStraight;  ///< of the rail along x at its profile's origin, < 0: hollow
  static constexpr double kStraight = std::numeric_limits<double>::infinity();
};

/// The vertical gap along the rail [m], over arc lengths where it faces the wheel; of a tape circle at the height 0.
/// x: where the wheel is lowest, from the middle of the tape circle along the rail.
struct GapSamples {
  std::vector<double> s, gap, x;
  void add(double at, double gap_there, double x_there) {
    s.push_back(at);
    gap.push_back(gap_there);
    x.push_back(x_there);
  }
};

/// The wheel just touching the rail.
struct RigidContact {
  double wheel_offset_y = 0;  ///< y of the tape circle in the model frame
  double wheel_offset_z = 0;  ///< height of the tape-circle tread point (profile origin) in the model frame, at contact
  double axle_height = 0;     ///< z of the axle = wheel_offset_z + wheel_radius
  double rail_s = 0, wheel_s = 0;  ///< arc lengths of the contact point on both profiles
  Vec2 point;                      ///< contact point, model frame
  double x = 0;      ///< of the contact point, from the middle of the tape circle along the rail; 0 without yaw
  double yaw = 0;    ///< rad, positive towards the field side
  double roll = 0;   ///< rad, positive with the field side up
  double angle = 0;  ///< contact angle [rad]: inclination of the common tangent to the y axis, positive when rising to
                     ///< the field side
  double rolling_radius = 0;  ///< distance of the contact point from the axle; of a yawed wheel its depth below it
  double curvature_wheel_lateral = 0,
         curvature_rail_lateral = 0;  ///< of the profiles at the contact, 1/m, convex positive
  double curvature_rolling = 0;  ///< of wheel and rail together across them, cos(angle) (1/rolling_radius + rail_turn)
                                 ///< [1/m]
  double rail_turn = 0;  ///< 1/m, over the depth of the rail's axle below the contact point; < 0: above; 0: straight
  bool settled = false;  ///< the place and plane of a patch, which later ones keep
  std::shared_ptr<const GapSamples> searched;  ///< what place_wheel looked at for it; null: of other contacts
};

/// Spin of the wheel on its contact angle delta less its roll phi, -sin(delta - phi)/r [1/m]; of a rail that turns too
/// its own beside it, -sin(delta)/R.
double wheel_spin(const RigidContact& contact);

/// Of a rail with a radius R along rolling (< 0: hollow) at x from its axle: the depth of the axle below the surface,
/// sqrt(R² - x²) with R's sign, and by how much the surface lies below that at x = 0 [m]; of a straight rail 0.
double axle_depth(double rail_radius, double x);
double rail_drop(double rail_radius, double x);

/// Lateral creepage in the contact plane of a wheel with the yaw psi: -tan(psi)/cos(delta), for its surface cannot move
/// into the rail, turning or not; with a roll as turned_wheel.hpp has it. Like all creepages here without products of
/// creepages.
double yaw_creepage(const RigidContact& contact);

/// By the angle whose tangent is given: a cant of 1:40 is 0.025.
Rotation<double> rotation_of_tangent(double tangent);

/// Rail profile frame -> model frame (rotation by atan(cant)) and back.
Vec2 rail_to_model(const TrackGeometry& track, Vec2 rail_point);
Vec2 model_to_rail(const TrackGeometry& track, Vec2 model_point);

/// y of the gauge face in the model frame: where the rail, canted, passes the gauge depth below its highest point, on
/// the gauge side. Throws CaseError if its profile ends above that.
double gauge_face_y(const Profile& rail, const TrackGeometry& track);

/// A place on the rail that a search keeps to: of gaps that are equal within so much the nearest one is taken. A wheel
/// that may touch in two places then does not change between them while its load or roll is sought.
struct HeldPlace {
  double rail_s = 0, within = 0;  ///< m; within 0: none is held
};

/// A contact on nearly the same track, from which a search takes all gaps that its wheel does not reach under a descent
/// [m], for differences over small steps.
struct KnownPlace {
  const RigidContact* contact = nullptr;
  double descent = 0;
};

/// Lowers the wheel vertically until it touches: the smallest vertical gap over the rail's whole running surface, found
/// to 1e-9 m where the contact is a single point; of equal gaps (within 1e-12 m) the one nearest the tape circle. The
/// wheel is turned by the yaw psi about the vertical through the middle of its tape circle; the contact, at the angle
/// delta, then lies before the axle by about r tan(delta) tan(psi), on a rail of the radius R along rolling by 1/(1 +
/// r/R) of that. A roll comes first (turned_wheel.hpp), on a straight rail alone. The tape circle stands at
/// back_to_back / 2 + flange_back_to_tape from the track's centre, the gauge face (gauge_depth below the highest point
/// of the canted rail) at gauge / 2, and lateral_shift moves the wheel from there. A plane or arc (Profile::primitive)
/// has neither flange nor gauge face: with one in the pair the tape circle stands over the rail's axis, moved by
/// lateral_shift. Throws CaseError if the wheel misses the rail, touches at the end of a profile, or the rail's profile
/// ends above the gauge depth.
RigidContact place_wheel(const Profile& wheel, const Profile& rail, const TrackGeometry& track,
                         const HeldPlace& held = {}, const KnownPlace& known = {});

/// Where the wheel touches if it is lowered further, through the rail: the lowest places of the vertical gap besides
/// `first` (of place_wheel) whose gap is at most `descent` [m], nearest first. Each is a contact of the lowered wheel:
/// its axle stands lower than that of `first` by the gap there. Places between which the gap rises by less than a
/// micrometre are one.
std::vector<RigidContact> further_contacts(const Profile& wheel, const Profile& rail, const TrackGeometry& track,
                                           const RigidContact& first, double descent);

/// A stretch of the rail's profile, by arc lengths [m].
struct RailStretch {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
};

/// The place and plane of what a wheel, lowered to the height `offset_z` [m] of its tape circle, overlaps of a stretch
/// of the rail: means of the rail's arc length, of x and of the rail's inclination with the weight depth^2.5, the
/// squared depth summed along rolling too, as CONTACT weighs an overlap. The wheel's inclination has the same mean, for
/// the overlap ends where its depth is 0. Rolling radius and point are those of the middle between the two surfaces
/// there, of the wheel that just touches; height and curvatures are those of `first`, the contact of the stretch that
/// touches first. Continuous over the placement and the height: what begins to overlap has no weight. `first` itself
/// where nothing overlaps and where the means differ from it by less than 1e-8 m and 1e-7 rad.
RigidContact overlap_place(const Profile& wheel, const Profile& rail, const TrackGeometry& track,
                           const RigidContact& first, const RailStretch& stretch, double offset_z);

/// The largest vertical gap between two contacts: where the surface of the one ends and that of the other begins. gap
/// [m] is that of a wheel with its tape circle at the height 0.
struct Ridge {
  double rail_s = 0, gap = 0;
};
Ridge ridge_between(const Profile& wheel, const Profile& rail, const TrackGeometry& track, const RigidContact& a,
                    const RigidContact& b);

}  // namespace railstrata
