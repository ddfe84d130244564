#pragma once
// The model before anything moves: profiles, placement, meshes and loads built from a case.
#include <filesystem>
#include <optional>

#include "core/body_id.hpp"
#include "friction/third_body.hpp"
#include "geometry/placement.hpp"
#include "geometry/profile.hpp"
#include "halfspace/hertz.hpp"
#include "material/elastic.hpp"
#include "mesh/bodies.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {

/// The geometry of a case: cheap, and all that the half-space engine needs.
struct Placement {
  Profile wheel, rail;
  TrackGeometry track;
  RigidContact contact;
  std::vector<std::string> notes;        ///< what the profile readers detected and flipped
  std::vector<std::string> doubts = {};  ///< profile_doubts
};

/// What stands below the head of the case's rail.
RailSection section_below_head(const GeometrySpec& geometry, const Profile& rail);

/// Built-in names are tried first, then files relative to `folder`. rail: instead of the case's, if not null. Throws
/// CaseError.
Placement place(const CaseSpec& spec, const std::filesystem::path& folder, const Profile* rail = nullptr);

/// The laws of friction that a case asks for.
FallingFriction falling_friction(const CaseSpec& spec);
ThirdBody third_body(const CaseSpec& spec);
/// Friction across rolling over friction along it; 1 without friction.
double lateral_friction_share(const CaseSpec& spec);

/// E* [Pa] of wheel and rail together, below their layers.
double modulus_of(const CaseSpec& spec);

/// Hertz with the curvatures at the rigid contact point: an estimate for search distances and checks, not a result. A
/// line contact's b is half the line, its approach NaN.
HertzContact hertz_estimate(const CaseSpec& spec, const RigidContact& contact);

struct Model {
  CaseSpec spec;
  Placement placement;
  SweptBody rail = {}, wheel = {};
  std::vector<Elastic> rail_materials,
      wheel_materials;  ///< matrix, then layers from the surface down; a graded layer as its rows of elements
  std::vector<Elastic> rail_at_surface = {},
                       wheel_at_surface = {};  ///< the same as they are at the running surface: the top row
                                               ///< of a graded layer has the table's first modulus
  double load = 0;                             ///< G, N
  HertzContact hertz = {};
  /// The place that creepages, contact angle and spin are of: that of the overlap under Hertz's approach
  /// (geometry/placement.hpp).
  RigidContact reference = {};
  double x_end = 0;             ///< wheel position at which the run ends, m
  bool until_repeated = false;  ///< the run ends before, where windows of run.positions repeat
  /// m, where a run that has come to `position` is likely to end: if it ends where windows repeat, at the end of the
  /// present window, the second one at the earliest; else at x_end.
  double likely_end(double position = 0) const;
  double reach = 0;  ///< m, how much farther from the axle heights make the wheel touch
  /// Section curves of the running surfaces in section coordinates of the bodies.
  Vec2 rail_section_point(double s) const { return rail_to_model(placement.track, placement.rail.at(s).position); }
  Vec2 rail_section_normal(double s) const { return rail_to_model(placement.track, placement.rail.at(s).outward); }
  Vec2 wheel_section_point(double s) const {
    const Vec2 p = placement.wheel.at(s).position;
    return {p.y, p.z - spec.geometry.wheel_radius};
  }
  Vec2 wheel_section_normal(double s) const { return placement.wheel.at(s).outward; }
};

/// m, along the running surface, from one place of which a section is kept to the next.
inline constexpr double kSectionPlace = 4e-3;

/// The layers as thick as they are across at the contact, of sections at the nearest kept place; of a case only those
/// that are there.
std::vector<LayerSpec> layers_at_contact(const CaseSpec& spec, const Placement& placement);
CaseSpec case_at_contact(CaseSpec spec, const Placement& placement);

/// A body's mesh over a short way, for its section alone, and its materials as Model has them. Layers have as many rows
/// as the sizes ask for. contact_s: arc length of the middle of the fine columns. Throws CaseError as build_model.
struct MeshedSection {
  SweptBody body;
  std::vector<Elastic> materials;
};
MeshedSection meshed_section(const CaseSpec& spec, const Placement& placement, BodyId body, double contact_s,
                             const MeshSizes& sizes);

/// Meshes both bodies; not null: the rail has this mesh, of another model of the same rail, for wheels elsewhere across
/// it (whether the patch lies in its fine zone is for the caller: a rolling reports patch_reaches_edge_of_fine_zone).
/// Throws CaseError where the mesh cannot be made (layer thicker than the head, …).
Model build_model(const CaseSpec& spec, const std::filesystem::path& folder, const SweptBody* meshed_rail = nullptr);

}  // namespace railstrata
