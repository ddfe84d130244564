#pragma once
// The mechanical system of a case, ready for computing and constant: two elastic bodies, the rigid axle that carries
// the wheel's bore, the suspension and its masses, the track's support, and the contact surfaces.
//
// Axle: a rigid body in the bore with the degrees of freedom x, z and the spin psi (positive rolling forward, about
// +y); it does not tilt (the other wheel of the set and the bearings hold it). Sideways it is guided, at rest or with
// the speed that makes a given lateral creepage, or it is free under the lateral force that holds it in the static
// equilibrium with the given friction. A yawed wheel has axes of its own, turned about the vertical through the axle's
// start. The axle has what the given wheel mass exceeds the meshed one by, as a solid shaft of the bore's radius.
// Suspension: groups of a spring and a dashpot with a share of the sprung mass each, vertical, around the axle's
// (non-rotating) box. In x the sprung mass moves with the axle if the case asks for it.
//
// A rail that is a ring (mesh/bodies.hpp) turns about a rigid shaft in its bore with the uniform spin -V/R; the wheel's
// axle then stays where it is along x. Positions, speeds and creepages count the arc that has passed below the wheel.
#include <array>

#include "body/body.hpp"
#include "contact/enforcement.hpp"
#include "core/body_id.hpp"
#include "fem/rail_pads.hpp"
#include "fem/watched_points.hpp"
#include "model/model.hpp"

namespace railstrata {

/// Elements and precision that a case asks for.
ElementOptions element_options(const CaseSpec& spec);

/// A node on a rigid axle: index of component x in the body's fields, arm from the axle's centre in the undeformed
/// body.
struct BoreNode {
  std::ptrdiff_t index;
  int stride;
  Vec3 arm;
};

struct Axle {
  double mass_z = 0;   ///< kg, of the axle and the bore's nodes
  double mass_x = 0;   ///< the same plus the sprung mass when it rides along
  double inertia = 0;  ///< kg m², about the axle, of axle and bore
  std::vector<BoreNode> bore;
};

/// Viscous absorber at a node of the rail's end planes: f = coefficient * v. [LysmerKuhlemeyer1969]
struct EndDashpot {
  std::ptrdiff_t index;
  double coefficient;
};

/// At all free nodes of both end planes.
std::vector<EndDashpot> end_absorbers(const Body& rail);

/// Force of the rail beyond the model's end on a node of the end plane [N], along x: the nodal force of its initial
/// stress, so that the rail is as long as it is and keeps that stress up to its ends. A free end would be felt far into
/// it: of a layer of thickness h on a block the stress comes back as 1 - 2.14 h/distance (a wedge of a right angle with
/// a force along its edge [TimoshenkoGoodier1970 art. 38]).
struct EndLoad {
  std::ptrdiff_t index;
  double force;
};

/// What follows from a case for the steps.
struct ExplicitOptions {
  EnforcementOptions contact;   ///< friction included
  bool keeps_pace = false;      ///< the creepage is given: travel and spin of the axle go on as they started
  bool free_sideways = false;   ///< the axle keeps the lateral force of the start, not its lateral speed
  double lateral_speed = 0;     ///< m/s, of a guided axle; at the start of one that is free sideways
  double lateral_friction = 0;  ///< N, on the rail at the start (fem/lateral_start.hpp)
};

struct RollingSystem {
  explicit RollingSystem(const Model& model);

  Model model;
  ExplicitOptions options;
  std::array<Body, 2> bodies;  ///< by BodyId
  Axle axle;
  std::vector<EndDashpot> absorbers;
  std::vector<EndLoad> end_loads;
  RailPads pads;                           ///< none: the rail's foot is held
  std::array<ContactSurface, 2> surfaces;  ///< by BodyId
  double gravity = kGravity;
  double rolling_radius = 0;
  double spin_inertia = 0;          ///< kg m², of everything that turns
  double travel_mass = 0;           ///< kg, of everything that moves along x
  double start_spin = 0;            ///< rad/s, at the start of the rolling: V (1 - creepage)/r; 0 for a static case
  double rail_spin = 0;             ///< rad/s, of a rail that is a ring, always: -V/R; 0: of a straight one, at rest
  std::vector<BoreNode> rail_bore;  ///< of a rail that is a ring
  std::vector<WatchedPoint> watched_points;
  double torque =
      0;  ///< N m, steady: gives the wanted F_T with the inertia of the accelerated wheel, M = F_T (r + I/(m r))

  const CaseSpec& spec() const { return model.spec; }
  const Body& body(BodyId id) const { return bodies[index_of(id)]; }
  const Body& rail() const { return body(BodyId::rail); }
  const Body& wheel() const { return body(BodyId::wheel); }
  bool on_ring() const { return rail().mesh.rises(); }
  /// Whether surfaces or materials change along the way.
  bool varies_along() const {
    const auto varies = [](const ContactSurface& surface, const Body& body) {
      return !surface.heights.none() || !body.mesh.blocks[body.mesh.contact.block].along.empty() ||
             !body.mesh.interfaces.empty();
    };
    return varies(rail_surface(), rail()) || varies(wheel_surface(), wheel());
  }
  const ContactSurface& surface(BodyId id) const { return surfaces[index_of(id)]; }
  const ContactSurface& rail_surface() const { return surface(BodyId::rail); }
  const ContactSurface& wheel_surface() const { return surface(BodyId::wheel); }

  /// Moves the bore's nodes with the axle and the slaves with their masters; u_wheel and pose in the same axes. parts:
  /// of the bodies' lines; none: whole.
  void apply_constraints(Field& u_rail, Field& u_wheel, const AxlePose& pose,
                         const std::array<TiedPart*, 2>& parts = {}) const;
};

/// Displacement of the foot's base at x [m], u of the rail: 0 if it is held.
double foot_height(const RollingSystem& system, double x, const Field& u);

}  // namespace railstrata
