#pragma once
// From what a wheel has in its own axes to the axes of the track.
#include <vector>

#include "ask/wheelset.hpp"
#include "bem/rolling_derivatives.hpp"

namespace railstrata {

/// All patches of a wheel, about the centre of the wheelset, in the axes of a track on which it is the left one and
/// rolls on.
Wrench carried_by(const Wheel& wheel);

/// The same of the cells of one plane.
Wrench carried_by(const Wheel& wheel, const RigidContact& plane, const ContactField& field);
/// The six numbers of that as sums over the tractions in these cells, and the wrench that such sums are.
std::vector<TractionSum> wrench_sums(const Wheel& wheel, const RigidContact& plane, const ContactField& field);
Wrench wrench_from(const Wheel& wheel, const std::vector<double>& sums);
/// What a wheel carries so, in the axes of the track.
Wrench in_track(const Wheelset& set, std::size_t side, const Wrench& of_wheel);

/// A wheel of a solved wheelset, in the track's axes.
WheelForces forces_of(const Wheelset& set, std::size_t side);

std::string remarks_of(const Wheelset& set);

}  // namespace railstrata
