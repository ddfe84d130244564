#pragma once
// Derivatives of a wheelset's forces by its motions and those of its rails.
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "ask/wheelset.hpp"

namespace railstrata {

/// A number of WheelsetState: a row of kWheelsetState, of pairs that of a side.
struct WheelsetInput {
  std::size_t row = 0, side = kLeft;
};

/// Per unit of an input, in the track's axes; meanings are those of rs_wheelset_derivatives (railstrata.h).
struct WheelsetSlopes {
  double z = 0, roll = 0;
  Vec3 force, moment;
  std::array<Wrench, 2> wheels;
};

/// In the order of rs_wheelset_derivatives, before those of the wheels.
inline constexpr std::array<Named<WheelsetSlopes, double, Vec3>, 4> kWheelsetSlopes{
    {{"z", "m", &WheelsetSlopes::z},
     {"roll", "rad", &WheelsetSlopes::roll},
     {"force", "N", &WheelsetSlopes::force},
     {"moment", "N m", &WheelsetSlopes::moment}}};

/// "y", of pairs "rail_y[0]" and "rail_y[1]". Throws CaseError.
WheelsetInput wheelset_input(std::string_view name);

/// At the last solution of the wheelset. Throws CaseError: there is none, an input that is a result in it; NoAnswer and
/// NumericalError as solve.
std::vector<WheelsetSlopes> slopes(Wheelset& set, const std::vector<WheelsetInput>& inputs);

}  // namespace railstrata
