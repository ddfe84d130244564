#pragma once
// How a case is computed: mesh, contact, steps, the half-space engine, output; in SI units.
#include <optional>
#include <vector>

namespace railstrata {

enum class ElementFormulation {
  full,      ///< fully integrated, free of locking
  one_point  ///< with scaled hourglass stiffness
};

/// Element arithmetic while rolling; nodal values and the static preload stay double.
enum class ArithmeticPrecision { double_precision, single_precision };

/// Where the fields of a rolling are computed (docs/gpu.md).
enum class ComputeDevice { cpu, gpu };

/// How a rolling of finite elements begins (fem/steady_start.hpp).
enum class RunStart {
  steady,  ///< with the friction, torque and creepage of steady rolling, where there is such a state
  rest     ///< without friction along the rail; the torque rises
};

/// Where the half-space engine takes the leading edge of the patch (bem/leading_edge.hpp).
enum class LeadingEdge {
  sub_cell,   ///< inside a cell, found from the gap ahead of it
  whole_cell  ///< between two cells, as Kalker and CONTACT do
};

/// Whose strength and fatigue a result judges.
enum class JudgedBodies { both, rail, wheel };

/// m, of the fine cap that is not given: wider where the patch is.
inline constexpr double kFineWidth = 24e-3;

struct MeshSpec {
  double element_size = 1e-3, fine_depth = 8e-3, largest = 12e-3;
  std::optional<double> fine_width;  ///< m, across; of a Model always given
  int coarse_ratio = 3;
  ElementFormulation element = ElementFormulation::full;
  double end_length = 0.12;
};

struct OutputSpec {
  bool volume = true;        ///< VTU of the fine zone
  bool patch_series = true;  ///< VTP series of the patch during the rolling, PVD
  int series_frames = 30;
};

struct RunSpec {
  RunStart start = RunStart::steady;
  std::vector<double> positions;  ///< wheel positions at which results are wanted, m; empty: as build_model decides
  double window = 0.010;          ///< m of rolling, centred on each position, over which results are averaged
  std::optional<double> run_up;   ///< m of rolling over which the run-up damping fades to zero; of a Model always given
  double run_up_damping = 2000.0;  ///< 1/s, mass-proportional damping of vibration at the start
  double step_safety = 0.9;        ///< of the stable step
  double mass_scaling_step = 1.0;  ///< wanted step of thin rows of elements, in element sizes over the matrix's
                                   ///< pressure wave speed; 0: real masses (fem/step_plan.hpp)
  ArithmeticPrecision precision = ArithmeticPrecision::double_precision;
  ComputeDevice device = ComputeDevice::cpu;
  double preload_tolerance = 1e-6;   ///< relative residual of the static equilibrium
  double history_interval = 0.2e-3;  ///< m of rolling between rows of history.csv
  bool rolling = true;               ///< false: stop after the static preload
  bool plasticity = false;           ///< finite elements: materials with a strength yield
  JudgedBodies judged = JudgedBodies::both;
  OutputSpec output;
};

/// Angle of the surfaces that the lateral slip of spin is taken with (bem/case_patch.hpp).
enum class SpinAngle {
  local,  ///< of each place of the patch
  patch   ///< of the contact plane everywhere
};

/// What carries the surfaces of the contact of the half-space engine.
enum class ContactBodies {
  half_spaces,
  sections  ///< the rail's and the wheel's own, alike along rolling (bem/rows_difference.hpp)
};

/// Directions in which the surfaces of the half-space engine meet.
enum class ContactNormals {
  plane,  ///< those of the contact plane
  local   ///< of each row of cells its own, with cells by arc length: conformal contact (bem/profile_gap.hpp)
};

struct BemSpec {
  ContactBodies bodies = ContactBodies::half_spaces;
  LeadingEdge leading_edge = LeadingEdge::sub_cell;
  SpinAngle spin_angle = SpinAngle::local;
  ContactNormals normals = ContactNormals::plane;
};

}  // namespace railstrata
