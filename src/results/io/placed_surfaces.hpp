#pragma once
// Running surfaces of wheel and rail where they stand, for pictures around the results.
#include <filesystem>

#include "model/model.hpp"
#include "record/vtk.hpp"

namespace railstrata {

/// The rail's profile over 200 mm below the wheel, and the wheel's turned all the way round its axle; undeformed, model
/// frame, wheel's axle at wheel_x [m].
VtkQuads rail_surface(const Placement& placement, double wheel_x);
VtkQuads wheel_surface(const Placement& placement, double wheel_x);

/// rail_surface.vtp and wheel_surface.vtp.
void write_placed_surfaces(const std::filesystem::path& folder, const Placement& placement, double wheel_x);

}  // namespace railstrata
