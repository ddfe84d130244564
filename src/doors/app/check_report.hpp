#pragma once
// What `check` reports about a case, as text and as JSON.
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "judge/plausibility.hpp"
#include "reader/case_file.hpp"
#include "runs/run_estimate.hpp"

namespace railstrata {

/// Title, contact point, loads and layers.
void print_case(const LoadedCase& loaded, const Placement& placement);

/// Mesh, step, memory and time, and what the estimate has of other machines.
void print_estimate(const Model& m, const RunEstimate& e);

/// The meshes as an aligned table, a row for each block of both bodies.
std::string mesh_table(const Model& model);

/// A VTU file with materials, blocks and scaled Jacobians.
void write_mesh(const std::filesystem::path& file, const SweptBody& body);

/// Warnings of the last position, which the result belongs to.
std::vector<Warning> warnings_of(const Model& m, const RunEstimate& e);

nlohmann::ordered_json placement_json(const CaseSpec& spec, const Placement& placement);

/// machines: with the estimates for other machines.
nlohmann::ordered_json run_json(const Model& m, const RunEstimate& e, bool machines);

// Both wheels of an axle from one shift and yaw: the case's wheel, and the other one on the rail beside it.

/// The other wheel has the same profile on the same rail, mirrored: shift, yaw and roll change their signs. Creepages
/// are those of an axle that rolls without a couple, in the curve of geometry.curve_radius R (centre on this wheel's
/// field side), with e half the distance of the tape circles and r_m the mean of the rolling radii:
///   xi = 1 -+ e/R - r/r_m (- this wheel),   eta of the yaw,   spin = -sin(delta)/r +- cos(delta)/R.
struct AxleWheel {
  RigidContact contact;
  double creepage_x = 0, creepage_y = 0, spin = 0;  ///< spin in 1/m
};
struct AxleOnTrack {
  AxleWheel here, other;
  double radius_difference = 0,
         wanted_difference = 0;  ///< m, r of the other less here; what rolls the curve, 2 e r_m/R
};
AxleOnTrack axle_of(const CaseSpec& spec, const Placement& placement);

}  // namespace railstrata
