#pragma once
// geometry.json: profiles in their places, contact point, layers and Hertz's estimate, so that a result folder can be
// drawn without its profile files.
#include <filesystem>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "model/model.hpp"
#include "record/vtk.hpp"

namespace railstrata {

/// One of several contacts of a wheel and its normal force, N.
struct LoadedContact {
  RigidContact contact;
  double load = 0;
};

/// Numbers of wheelset and track with where each comes from, to be shown.
nlohmann::ordered_json track_json(const GeometrySpec& geometry);

/// SI units, model frame. Profiles and the lower borders of the layers are lists of points [y, z] half a millimetre
/// apart, at most 80 mm to either side of the contact. "hertz" holds the ellipse of the curvatures at the rigid contact
/// point under the whole load, without layers. Of several `patches`, "patches" lists each with its own ellipse.
nlohmann::ordered_json geometry_json(const CaseSpec& spec, const Placement& placement,
                                     const std::vector<LoadedContact>& patches = {});
void write_geometry(const std::filesystem::path& file, const CaseSpec& spec, const Placement& placement,
                    const std::vector<LoadedContact>& patches = {});

// ---- running surfaces of wheel and rail where they stand, for pictures around the results
/// The rail's profile over 200 mm below the wheel, and the wheel's turned all the way round its axle; undeformed, model
/// frame, wheel's axle at wheel_x [m].
VtkQuads rail_surface(const Placement& placement, double wheel_x);
VtkQuads wheel_surface(const Placement& placement, double wheel_x);

/// rail_surface.vtp and wheel_surface.vtp.
void write_placed_surfaces(const std::filesystem::path& folder, const Placement& placement, double wheel_x);

}  // namespace railstrata
