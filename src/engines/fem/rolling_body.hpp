#pragma once
// One of the two bodies as the steps of a rolling see it: its frame, its workspaces and the schedule of its nodes.
#include <vector>

#include "body/tile_cut.hpp"
#include "body/traversal.hpp"
#include "contact/surface.hpp"
#include "fem/node_law.hpp"
#include "fem/reference_frame.hpp"
#include "fem/rolling_state.hpp"
#include "fem/steady_start.hpp"
#include "fem/step_plan.hpp"

namespace railstrata {

/// When a body's nodes are updated: as soon as their forces are complete, or after the contact.
struct UpdateSchedule {
  NodeMask at_once;
  std::vector<SectionNode> waiting;   ///< free nodes on surface, pads and ties, or with added mass
  std::vector<SectionNode> bordered;  ///< nodes updated at once, but for the ends of open blocks
  int chains_wanted = 0;              ///< what chains were made for
  std::vector<Chain> chains;  ///< enough to keep the threads busy; where sums are wanted this rank's are single tiles,
                              ///< so that the bits do not depend on the threads. Those of other ranks: their stretches
  std::vector<int> own;       ///< those of the chains that this rank works through
  std::vector<UpdateSums> chain_sums, plane_sums;  ///< by chain; of the planes in front of them
  std::vector<UpdateSums> waiting_sums;            ///< by waiting node and tile of its block
  std::vector<std::size_t> first_waiting_sum;      ///< by waiting node
  std::vector<UpdateSums> border_sums;
  std::vector<UpdateSums> tile_sums;  ///< by tile: all nodes in its stations, but for those in border_sums
};

struct RollingBody {
  RollingBody(const Body& body, const ContactSurface& surface, MassScaling& scaling, const ReferenceFrame& frame,
              TileCut cut = {});

  const Body& body;
  const ContactSurface& surface;
  MassScaling& scaling;  ///< empty: real masses
  TileCut cut;
  ReferenceFrame frame;
  Traversal elements;
  UpdateSchedule schedule;
  TiedPart* part = nullptr;  ///< of the lines that this step has; none: whole lines
  MeanMotion mean;
  std::vector<std::vector<double>> cos_node, sin_node;  ///< of the station angles, per block; 1 and 0 if extruded
  double free_mass = 0, free_inertia = 0;               ///< kg, kg m², of the free nodes of a revolved body
  Field surface_u;          ///< m, of a revolved body: displacements in the model frame, valid on the surface lines
  Field stretch, velocity;  ///< work space of the added mass's energy

  bool turns() const { return body.mesh.kind == SweepKind::revolve; }
  /// From the axle to an undeformed node, frame components; zero if extruded.
  Vec3 arm(int block, int node, int station) const;
};

using RollingBodies = std::array<RollingBody, 2>;  ///< by BodyId

/// Chains for this step; no memory is asked for after the first of each kind.
void chain_tiles(RollingBody& body, bool sums_wanted);

/// Displacements of the running surface in the model frame.
const Field& surface_displacement(RollingBody& body, const BodyState& state);

/// Displacements of the whole body in the model frame, u = x - X.
Field model_displacement(const RollingBody& body, const BodyState& state);
/// The same of a revolved body at rest, from those in its own axes: turned by the yaw, about the vertical through the
/// axle.
Field yawed_displacement(const Body& body, const Rotation<double>& yaw_turn, const Field& u);

/// Velocities relative to the frame's travel, in this step's frame components: of the half step before, or the one
/// after the update. Only found where they differ from v and added mass asks for them.
const Field& frame_velocity(RollingBody& body, const BodyState& state, bool before);

/// v = -rate du/dt along the sweep: the pattern of deformation stands still while the body moves through it.
void start_velocities(const RollingBody& body, double rate, BodyState& state);

/// Adds the velocities of a rigid motion beyond that of the frame.
void add_rigid_motion(const RollingBody& body, const StartMotion& beyond, BodyState& state);

/// From the sums of momentum of an update.
MeanMotion mean_motion(const RollingBody& body, const UpdateSums& sums);
/// The same from the velocities as they stand.
MeanMotion mean_motion(const RollingBody& body, const BodyState& state);

/// kg m: `sum` and the masses of the free nodes times their heights above the undeformed ones. Summed on, so that the
/// order of the sum over both bodies is one.
double add_weight_moment(const RollingBody& body, const BodyState& state, double sum);

}  // namespace railstrata
