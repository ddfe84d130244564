#pragma once
// The handle of a wheelset.
#include <array>
#include <memory>
#include <utility>

#include "capi/contact.hpp"
#include "geometry/wheelset.hpp"

namespace railstrata::capi {

/// How the vertical force of a wheel grows with its approach, Q = scale a^power: Hertz's 1.5 to begin with.
struct Stiffening {
  double scale = 0, power = 1.5;
  double approach = 0, force = 0;  ///< that it goes through
  double force_at(double a) const;
  double approach_at(double q) const;
  double slope() const { return approach > 0 ? power * force / approach : 0; }  ///< there
  void add(double a, double q);
};

/// Where the next solution starts from.
struct WheelsetStart {
  double roll = 0;
  std::array<Stiffening, 2> stiffening;
  std::array<NextStart, 2> contacts;
};

/// One wheel as the left one of its motion.
struct Wheel {
  std::unique_ptr<rs_contact, void (*)(rs_contact*)> contact;
  TrackGeometry at_rest;
  WheelsetMotion motion;
  RailMotion rail;
  rs_forces forces{};
  double approach = 0;  ///< m, of the last solution
  Vec3 force, moment;   ///< N, N m about the wheelset's centre
  const RigidContact& touching() const { return contact->placement.contact; }
  const TrackGeometry& track() const { return contact->placement.track; }
};

}  // namespace railstrata::capi

struct rs_wheelset {
  rs_wheelset(railstrata::capi::Wheel left, railstrata::capi::Wheel right)
      : wheels{std::move(left), std::move(right)} {}
  std::array<railstrata::capi::Wheel, 2> wheels;
  std::array<railstrata::capi::Stiffening, 2> stiffening;
  double roll = 0;  ///< rad, of the last solution
  int solutions = 0;
  railstrata::capi::WheelsetStart kept;
};
