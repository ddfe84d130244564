#pragma once
// What a case file says, in SI units, with every default. case/case_file reads it; case/option_table gives names,
// units, ranges, the words of the choices and documentation.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "case/strength_spec.hpp"
#include "core/body_id.hpp"
#include "friction/falling_friction.hpp"
#include "geometry/body_shapes.hpp"

namespace railstrata {

enum class ElementFormulation {
  full,      ///< fully integrated, free of locking
  one_point  ///< with scaled hourglass stiffness
};

enum class ContactMethod {
  mortar,  ///< no penetration at the end of each step
  penalty
};

/// How thin layers are kept from shortening the time step (fem/step_plan.hpp).
enum class TimeStepMethod { automatic, uniform, mass_scaling, local };

/// Of the element arithmetic while rolling; nodal values and the static preload stay double.
enum class ArithmeticPrecision { double_precision, single_precision };

/// Where the fields of a rolling are computed (docs/gpu.md). emulated: the card's kernels on the processor, for tests.
enum class ComputeDevice { cpu, gpu, emulated };

/// Where the half-space engine takes the leading edge of the patch (bem/leading_edge.hpp).
enum class LeadingEdge {
  sub_cell,   ///< inside a cell, told by the gap ahead of it
  whole_cell  ///< between two cells, as Kalker and CONTACT do
};

/// What the half-space engine follows in time (bem/transient.hpp).
enum class TransientKind {
  none,     ///< steady rolling
  rolling,  ///< rolling from a beginning, step by step
  shift     ///< loads and displacements sideways without rolling: presliding, fretting
};
enum class TransientStart {
  rest,   ///< pressed together, then shifted by the first forces
  steady  ///< as if it had rolled so for ever
};

enum class ContactShape {
  point,  ///< a patch, closed all round
  line    ///< a cylinder along its whole length: plane strain (halfspace/line_contact.hpp)
};

struct GeometrySpec {
  std::string rail_profile = "CN60";  ///< a built-in name or a file
  std::string wheel_profile = "LMA";
  RailShape rail_shape = RailShape::rail;
  WheelShape wheel_shape = WheelShape::wheel;
  ContactShape contact = ContactShape::point;
  std::optional<double> line_length;  ///< m, of a line contact: what bears the load
  double gauge = 1.435, gauge_depth = 0.016, back_to_back = 1.353, flange_back_to_tape = 0.070;
  double cant = 0.025;  ///< tangent (1:40)
  double lateral_shift = 0.0;
  double yaw = 0.0;                    ///< tangent of the angle of attack, positive towards the field side
  double roll = 0.0;                   ///< tangent of the wheelset's roll, positive with the field side up
  std::optional<double> curve_radius;  ///< m, positive with the centre on the field side; none: straight track
  double wheel_radius = 0.430;
  double block_width = 0.06, block_height = 0.06;
  double rim_thickness = 0.060, web_thickness = 0.030, web_offset = 0.0, hub_radius = 0.135, hub_width = 0.17,
         bore_radius = 0.095;
  bool in_line() const { return contact == ContactShape::line; }
};

struct MaterialSpec {
  double young = 210e9, poisson = 0.3, density = 7800.0;
  StrengthSpec strength = {};
};

/// Young's modulus at a depth below a layer's top; linear between two of them.
struct ModulusPoint {
  double depth = 0, young = 0;
  friend bool operator==(const ModulusPoint&, const ModulusPoint&) = default;
};
inline std::array<double*, 2> columns(ModulusPoint& p) { return {&p.depth, &p.young}; }

struct LayerSpec {
  std::string name = "layer";  ///< of several of a body that have none in the file: "layer 1", "layer 2", …
  BodyId on = BodyId::rail;
  double thickness = 1e-3;  ///< of a graded layer: its table's last depth
  double width = 0.060;
  MaterialSpec material;                  ///< young of a graded layer: the mean over its depth
  std::vector<ModulusPoint> young_table;  ///< a modulus that varies with depth, from 0 down; empty: uniform
  double grading_tolerance = 0.05;  ///< half-space engine: largest relative change of the modulus within one of the
                                    ///< layers that a graded one is cut into
  int elements = 0;                 ///< through the thickness; 0 = chosen
  bool graded() const { return !young_table.empty(); }
};

struct VehicleSpec {
  double wheel_mass = 660.0, sprung_mass = 8000.0;
  double suspension_stiffness = 0.95e6, suspension_damping = 10.4e3;
  int suspension_groups = 8;
  double gravity = 9.81;
  std::optional<double> approach;  ///< m, of the bodies along the contact normal: then the load is a result
  bool couple_sprung_mass = true;  ///< the sprung mass rides along with the axle in x (else it only moves vertically
                                   ///< and does not add inertia to it)
};

/// Each direction is driven by a force or by a creepage. Forces act on the wheel, creepages are rigid slips of the
/// wheel over the rail divided by the speed; lateral ones lie in the contact plane.
struct DriveSpec {
  double speed = 27.78;
  double traction_coefficient = 0.2;                                     ///< F_T / G, unless a creepage is given
  std::optional<double> creepage;                                        ///< longitudinal: negative drives
  std::optional<double> lateral_creepage, lateral_traction_coefficient;  ///< at most one; neither: no lateral creepage
  std::optional<double> spin;                                            ///< 1/m; if not given, of the geometry
  double friction_coefficient = 0.5;
  double torque_ramp = 4e-3;    ///< s, smooth rise of the torque; a shorter one overshoots the wanted traction
  double creepage_start = 0.0;  ///< longitudinal creepage at the start, (V - omega r)/V: negative drives
  /// The longitudinal force on the wheel over the load G, if it is given.
  std::optional<double> traction() const {
    return creepage ? std::optional<double>() : std::optional<double>(traction_coefficient);
  }
};

/// Friction at rest is drive.friction_coefficient.
struct FrictionSpec {
  FrictionForm law = FrictionForm::coulomb;
  std::optional<double> kinetic_coefficient;  ///< limit of fast slip; with a falling law
  std::optional<double> half_velocity;        ///< m/s, where half of the fall is done; with a falling law
  double memory_distance = 0;                 ///< m, slid until the coefficient has followed; 0: at once
  double memory_velocity = 1e-3;              ///< m/s, at least, by which it follows: at rest too
};

/// A layer of wear debris, sand, … between wheel and rail; none without a thickness.
struct ThirdBodySpec {
  std::optional<double> thickness, shear_modulus;
  std::optional<double> yield_shear;  ///< Pa; none: elastic
  double hardening = 0;               ///< Pa/m, by plastic shear
};

struct MeshSpec {
  double element_size = 1e-3, fine_width = 24e-3, fine_depth = 8e-3, largest = 12e-3;
  int coarse_ratio = 3;
  ElementFormulation element = ElementFormulation::full;
  double hourglass_coefficient = 0.05;  ///< one_point only: kappa of the Flanagan–Belytschko stiffness
  double end_length = 0.12;
  bool elements_through_layer_one = false;  ///< a coarser mesh than `elements` of the layers asks for
};

struct ContactSpec {
  ContactMethod method = ContactMethod::mortar;
  double penalty_scale = 0.1;  ///< penalty only: k = scale * K A / V of the rail's surface elements
};

struct RunSpec {
  std::vector<double> positions = {0.3};  ///< wheel positions at which results are wanted, m
  double window = 0.010;                  ///< m of rolling, centred on each position, over which results are averaged
  double run_up = 0.12;                   ///< m of rolling over which the run-up damping fades to zero
  double run_up_damping = 2000.0;         ///< 1/s, mass-proportional damping of vibration at the start
  double step_safety = 0.9;               ///< of the stable step
  TimeStepMethod time_step_method = TimeStepMethod::automatic;
  double mass_scaling_step =
      1.0;  ///< wanted step of thin rows of elements, in element sizes over the matrix's pressure wave speed
  ArithmeticPrecision precision = ArithmeticPrecision::double_precision;
  ComputeDevice device = ComputeDevice::cpu;
  double preload_tolerance = 1e-6;                     ///< relative residual of the static equilibrium
  double history_interval = 0.2e-3;                    ///< m of rolling between rows of history.csv
  bool rolling = true;                                 ///< false: stop after the static preload
  bool plasticity = false;                             ///< finite elements: materials that say a strength yield
  std::optional<double> plastic_depth, plastic_width;  ///< m, box of the elements that may (fem/plastic_zone.hpp)
};

/// Angle of the surfaces that the lateral slip of spin is taken with (bem/case_patch.hpp).
enum class SpinAngle {
  local,  ///< of each place of the patch
  patch   ///< of the contact plane everywhere
};

struct BemSpec {
  LeadingEdge leading_edge = LeadingEdge::sub_cell;
  SpinAngle spin_angle = SpinAngle::local;
};

/// A history of loads and motions, linear between its rows: columns of one length, an empty one is not given. What
/// rolls takes from the drive what has no column; what is shifted is held where nothing is given.
struct TransientSpec {
  TransientKind kind = TransientKind::none;
  TransientStart start = TransientStart::rest;
  std::optional<double> distance;               ///< m, rolled altogether; not given: to the last row
  int increments = 10;                          ///< shift: from row to row
  std::string history_file;                     ///< empty once it is read into the columns
  std::vector<double> at_distance, at_time;     ///< m, s: where the rows are
  std::vector<double> wheel_load, load_factor;  ///< N; over the static load
  std::vector<double> traction_coefficient, tractive_force, creepage, displacement;
  std::vector<double> lateral_traction_coefficient, lateral_force, lateral_creepage, lateral_displacement;
  std::vector<double> spin;  ///< 1/m
};

/// How deep wear is (damage/wear.hpp).
enum class WearLaw {
  usfd,    ///< University of Sheffield, from T-gamma over the area
  kth,     ///< Archard with Jendel's map of coefficients
  archard  ///< Archard with the rail's wear_coefficient
};

/// A row of a load collective: what it does not give is the case's (case/load_rows.hpp).
struct LoadSpec {
  std::string name;     ///< empty: "load 1", "load 2", … by its place
  double passages = 1;  ///< of such a wheel
  std::optional<double> wheel_load, lateral_shift, yaw, curve_radius, speed;
  std::optional<double> traction_coefficient, creepage;                  ///< at most one
  std::optional<double> lateral_traction_coefficient, lateral_creepage;  ///< at most one
  std::optional<double> friction_coefficient;
};

struct CollectiveSpec {
  std::string file;  ///< empty once it is read into the rows
  WearLaw wear_law = WearLaw::usfd;
};

/// Passes over a rail that yields (`railstrata passes`); lists begin again after their last value.
struct PassesSpec {
  std::vector<double> lateral_positions;      ///< m, of pass 1, 2, …, positive to the field side; empty: 0
  std::optional<double> lateral_deviation;    ///< m, of a normal distribution about them, cut at three of it
  int lateral_seed = 1;                       ///< of its random numbers
  std::vector<double> traction_coefficients;  ///< of pass 1, 2, …; empty: that of the drive
  std::optional<double> ductility;            ///< net plastic strain that the material bears
};

struct OutputSpec {
  bool volume = true;        ///< VTU of the fine zone
  bool patch_series = true;  ///< VTP series of the patch during the rolling, PVD
  int series_frames = 30;
};

struct CaseSpec {
  std::string title = "untitled";
  GeometrySpec geometry;
  MaterialSpec rail_material, wheel_material;
  std::vector<LayerSpec> layers;
  VehicleSpec vehicle;
  DriveSpec drive;
  FrictionSpec friction;
  ThirdBodySpec third_body;
  MeshSpec mesh;
  ContactSpec contact;
  RunSpec run;
  BemSpec bem;
  TransientSpec transient;
  std::vector<LoadSpec> loads;
  CollectiveSpec collective;
  PassesSpec passes;
  OutputSpec output;
};

}  // namespace railstrata
