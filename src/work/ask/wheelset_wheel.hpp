#pragma once
// One wheel of a wheelset, as the left one of its motion, which rolls on.
#include "ask/wheelset.hpp"

namespace railstrata {

/// Takes motions and rates of a state, under a roll; the contact stays where it is.
void turn(Wheel& wheel, std::size_t side, const WheelsetState& state, double roll);
/// Looks where the wheel touches in a state, under a roll, and leaves it in its contact. Throws NoAnswer.
void place(Wheel& wheel, std::size_t side, const WheelsetState& state, double roll, const HeldPlace& held,
           const KnownPlace& known = {});

/// Descent of the wheel at the height z of the wheelset, m.
double descent_at(const Wheel& wheel, double z);

/// The state of its contact where it is lowered by `descent` [m] below where it touches.
State state_under(Wheel& wheel, double descent);

/// Solves it so. keep_cells: as of a state. Throws as Contact::solve.
void press(Wheel& wheel, double descent, bool extrapolate, bool keep_cells = false);

}  // namespace railstrata
