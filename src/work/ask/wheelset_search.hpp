#pragma once
// Height and roll of a wheelset under its load and roll moment: docs/vehicle.md.
#include "ask/wheelset_wheel.hpp"

namespace railstrata {

/// Looks where the wheels touch and leaves it in their contacts, whose solutions then need not look again. hold: each
/// wheel keeps to the place where it touches now, if another is lower by less than 5 um.
void place(Wheelset& set, const WheelsetState& state, double roll, bool hold = false);
/// Solves both contacts under their descents [m].
void press(Wheelset& set, const std::array<double, 2>& descents, bool extrapolate = false);
/// Of forces, as shares of the load.
double tolerance_of(const Wheelset& set);
double height_touching(const Wheel& w);
/// Whether its last solution has several patches or tried them apart.
bool at_several_places(const Wheel& w);
void begin_stiffening(Wheelset& set);
/// z where the forces that are expected of the descents bear the load.
double expected_height(const Wheelset& set, double load);

inline constexpr int kMostSolutions = 60;

/// The height under a load, with the roll that is given: that which is expected, and where this does not settle, for a
/// wheel on tread and flange is no power of its descent, between the last ones that bear too much and too little.
double sink(Wheelset& set, double load);
/// The roll at which both wheels have their descents, and the height; none was found: nothing.
std::optional<double> tilt(Wheelset& set, const WheelsetState& state, const std::array<double, 2>& descents, bool hold);
/// The height under the load and the roll moment of the state; the roll is the set's. Throws NoAnswer, NumericalError.
double lean(Wheelset& set, const WheelsetState& state);

}  // namespace railstrata
