#pragma once
// The contact of RailStrata as OpenRailVehicleDynamics asks for one: of one wheel, by its place and motion.
#include <memory>
#include <string>

#include "axes.hpp"
#include "railstrata.h"

namespace railstrata_in_orvd {

struct Settings {
  std::string case_file;
  double cell = 1e-3;  ///< m, side of the cells
  double tolerance = 1e-8;
};

/// Half of a wheelset whose other wheel is lifted. Belongs to one thread at a time.
class RailWheel {
 public:
  /// Throws std::runtime_error with the library's message.
  RailWheel(const Settings& settings, orvd_contact::WheelSide side, double cant);

  /// The same answer for the same input, whatever was asked before. Throws std::runtime_error.
  orvd_contact::WheelRailContactResult evaluate(const orvd_contact::WheelRailContactInput& input);

  /// Of the last answer: with spin, and the moment of the contact about the axle's middle.
  const rs_wheel& last() const { return forces_.wheel[side_]; }
  const AxleMotion& last_motion() const { return motion_; }
  const RailAxes& last_axes() const { return axes_; }

 private:
  struct Free {
    void operator()(rs_wheelset* wheelset) const { rs_wheelset_free(wheelset); }
  };
  void measure();
  rs_wheelset_state state_of(const AxleMotion& motion) const;
  void solve(const rs_wheelset_state& state);
  rs_patch patch_forces(int patch) const;
  orvd_contact::WheelRailContactPatchResult patch_result(int patch) const;
  double left(double to_field) const { return side_ == RS_LEFT ? to_field : -to_field; }

  std::unique_ptr<rs_wheelset, Free> wheelset_;
  int side_;
  orvd_contact::WheelSide their_side_;
  double cant_;
  double radius_ = 0, arm_ = 0, rail_ = 0;  ///< m; arm and rail to the left of the middle
  rs_wheelset_forces forces_{};
  AxleMotion motion_;
  RailAxes axes_;
};

}  // namespace railstrata_in_orvd
