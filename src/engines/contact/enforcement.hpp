#pragma once
// Contact forces of one explicit step.
//
// Lagrange multipliers are found so that at the END of the step no chosen node penetrates and no sticking
// node slides (forward-increment multipliers [CarpenterTaylorKatona1991]):
//   g_A + dt w_A . n_A >= 0,  p_A >= 0,  one of them zero;     w_tA = 0 with |q_A| < f p_A (stick)  or  q_A = f p_A
//   w_tA/|w_tA| (slip) w = w_free - dt (M m_w^-1 M^T a + m_r^-1 a) tau
// solved by projected block Gauss–Seidel sweeps from the last step's tractions. It adds no stiffness, so it does not
// lower the stable step, and leaves a penetration of the order of the solver's tolerance.
//
// A third-body film (friction/friction_step.hpp) stands in the same place as the disc: its elastic shear is added to
// what a node yields per traction, D + (h/G)/dt, and belongs to the velocities of the step's end. A node that opens
// meets a fresh film when it closes again. Friction across rolling may differ from that along it (an ellipse in the
// disc's place, slip along its normal), and from column to column of the rail. Friction that falls with slip is
// Coulomb's in a step, with the coefficient that the slip up to then has left the rail's node
// (friction/friction_memory.hpp); it too is whole when a node opens. The law sees the mean slip velocity, as a vector:
// surfaces that slide vibrate at the mesh's highest frequency, under Coulomb's law already, by as much as they slide,
// and a law that falls would take that for sliding.
#include <cassert>

#include "contact/enforcement_law.hpp"
#include "contact/mortar.hpp"

namespace railstrata {

/// One body's nodes in the contact.
struct ContactSide {
  std::vector<Vec3> velocity;        ///< m/s; free on input, final on output
  std::vector<Vec3> before;          ///< of the last half step
  std::vector<double> inverse_mass;  ///< 1/kg

  void clear() {
    velocity.clear();
    before.clear();
    inverse_mass.clear();
  }
};

/// Surface nodes, gathered for the rows of a step: rail nodes in the order of the rows, wheel nodes each
/// once.
struct ContactSystem {
  std::vector<std::ptrdiff_t> wheel_nodes;  ///< index of component x
  std::vector<int> weight_node;             ///< per weight of the rows, position in wheel_nodes
  ContactSide rail, wheel;
  int sweeps = 0;  ///< that the multipliers took
  // room for what follows, kept so that a step allocates nothing
  std::vector<int> mark;           ///< of number_wheel_nodes, by node of the wheel's surface; -1
  std::vector<double> compliance;  ///< of the rows, (m/s)/Pa
  std::vector<char> slips;         ///< of the rows, the law's verdict in the last sweep
  std::vector<RowStart> at_start;  ///< of the rows, before the step; with a film only
};

/// Numbers the wheel nodes of the rows, each once: fills wheel_nodes and weight_node.
void number_wheel_nodes(const MortarRows& rows, const ContactSurface& wheel, ContactSystem& system);

/// Tractions of the rail's surface nodes, [column * stations + station].
class SurfaceTractions {
 public:
  SurfaceTractions(int columns, int stations)
      : stations_(stations), node_(static_cast<std::size_t>(columns) * stations) {}
  NodeTraction& at(int column, int station) { return node_[index(column, station)]; }
  const NodeTraction& at(int column, int station) const { return node_[index(column, station)]; }
  std::vector<NodeTraction>& all() { return node_; }
  const std::vector<NodeTraction>& all() const { return node_; }
  int stations() const { return stations_; }

 private:
  std::size_t index(int column, int station) const {
    const std::size_t k = static_cast<std::size_t>(column) * stations_ + station;
    assert(station >= 0 && station < stations_);
    assert(k < node_.size());
    return k;
  }
  int stations_;
  std::vector<NodeTraction> node_;
};

struct EnforcementOptions {
  FrictionLaws friction;
  double slip_time = 0;      ///< s, falling laws: time constant of the mean slip velocity; 0: that of the step
  double tolerance = 1e-11;  ///< m, change of a relative displacement per step at which the sweeps stop
  int max_sweeps = 100;
  std::vector<double> coefficient_across{};  ///< of the rail's columns, for that of `friction`; empty: the same
};

RowLaw row_law(const EnforcementOptions& options, double dt);

/// Finds the tractions of the rows and the velocities after the step. Tractions of nodes that are not among the rows
/// must be zero.
void enforce_contact(const MortarRows& rows, double dt, const EnforcementOptions& options, ContactSystem& system,
                     SurfaceTractions& tractions);

}  // namespace railstrata
