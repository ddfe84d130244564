#pragma once
// From what a wheel has in its own axes to the axes of the track.
#include "ask/wheelset.hpp"

namespace railstrata {

/// All patches of a wheel, about the centre of the wheelset, in the axes of a track on which it is the left one and
/// rolls on.
Wrench carried_by(const Wheel& wheel);

/// The same of the cells of one plane.
Wrench carried_by(const Wheel& wheel, const RigidContact& plane, const ContactField& field);
/// What a wheel carries so, in the axes of the track.
Wrench in_track(const Wheelset& set, std::size_t side, const Wrench& of_wheel);

/// A wheel of a solved wheelset, in the track's axes.
WheelForces forces_of(const Wheelset& set, std::size_t side);

std::string remarks_of(const Wheelset& set);

}  // namespace railstrata
