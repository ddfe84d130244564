#include "options/case_tables.hpp"
#include "options/option_slots.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

using namespace dimension;
using namespace option_slot;
using C = CaseSpec;
using H = MeshSpec;
using R = RunSpec;
using O = OutputSpec;

bool scatters(const CaseSpec& spec, std::size_t) { return spec.passes.lateral_deviation.has_value(); }
bool jumps(const CaseSpec& spec, std::size_t) { return spec.passes.jump != PassJump::off; }

}  // namespace

OptionTable mesh_table() {
  return {
      "mesh",
      "Element sizes",
      {option("element_size", at<&C::mesh, &H::element_size>,
              "Edge length at the running surfaces and in the studied subsurface", kLength,
              {0.05 * kMilli, 20 * kMilli}),
       option("fine_width", at<&C::mesh, &H::fine_width>, "Lateral width of the fine cap, centred on the contact point",
              kLength, {kMilli, 0.1}),
       option("fine_depth", at<&C::mesh, &H::fine_depth>, "Depth of the fine cap", kLength, {0.5 * kMilli, 0.05}),
       option("largest", at<&C::mesh, &H::largest>, "Largest edge far from the contact", kLength, {kMilli, 0.2}),
       option("coarse_ratio", at<&C::mesh, &H::coarse_ratio>,
              "Spacing along the path outside the cap, in element sizes", kNumber, {1, 20}),
       choice_at<&C::mesh, &H::element>(
           "element", "Fully integrated without locking, or one point with hourglass stiffness",
           {{"full", ElementFormulation::full}, {"one_point", ElementFormulation::one_point}}),
       option("hourglass_coefficient", at<&C::mesh, &H::hourglass_coefficient>,
              "element = \"one_point\": scale of the hourglass stiffness", kNumber, {0, 1}),
       option("end_length", at<&C::mesh, &H::end_length>, "Rail beyond both ends of the fine range", kLength,
              {1e-3, 5}),
       option(
           "elements_through_layer_one", at<&C::mesh, &H::elements_through_layer_one>,
           "One element through every layer, as coarse published meshes have; `elements` of the layers is not used")}};
}

OptionTable contact_table() {
  return {"contact",
          "Enforcement of the contact",
          {choice_at<&C::contact, &ContactSpec::method>(
               "method", "No penetration at the end of each step, or penalty springs",
               {{"mortar", ContactMethod::mortar}, {"penalty", ContactMethod::penalty}}),
           option("penalty_scale", at<&C::contact, &ContactSpec::penalty_scale>,
                  "method = \"penalty\": stiffness in units of K A / V of the rail's surface elements", kNumber,
                  above(0, 100))}};
}

OptionTable run_table() {
  return {
      "run",
      "Path, damping and steps",
      {option("positions", at<&C::run, &R::positions>, "Wheel positions at which results are wanted, increasing",
              kLength, {0, 20}),
       option("window", at<&C::run, &R::window>,
              "Rolling distance, centred on each position, over which results are averaged", kLength, {0, 1}),
       option("run_up", at<&C::run, &R::run_up>, "Rolling distance over which the run-up damping fades to zero",
              kLength, {0, 10}),
       option("run_up_damping", at<&C::run, &R::run_up_damping>, "Mass-proportional damping of vibration at the start",
              kRate, {0, 1e6}),
       option("step_safety", at<&C::run, &R::step_safety>, "Time step as a share of the stable one", kNumber,
              above(0, 1)),
       choice_at<&C::run, &R::time_step_method>(
           "time_step_method",
           "Thin layers: selective mass scaling, the short step of the real masses, or inner steps for the thin rows "
           "alone; auto scales where the step grows by more than a fifth",
           {{"auto", TimeStepMethod::automatic},
            {"uniform", TimeStepMethod::uniform},
            {"mass_scaling", TimeStepMethod::mass_scaling},
            {"local", TimeStepMethod::local}}),
       option("mass_scaling_step", at<&C::run, &R::mass_scaling_step>,
              "Mass scaling: step it aims at, in element sizes over the matrix's pressure wave speed", kNumber,
              above(0, 10)),
       choice_at<&C::run, &R::precision>(
           "precision", "Element arithmetic while rolling; nodal values and the static preload are always double",
           {{"double", ArithmeticPrecision::double_precision}, {"single", ArithmeticPrecision::single_precision}}),
       choice_at<&C::run, &R::device>("device", "Where steps of finite elements are computed (docs/gpu.md)",
                                      {{"cpu", ComputeDevice::cpu}, {"gpu", ComputeDevice::gpu}}),
       option("preload_tolerance", at<&C::run, &R::preload_tolerance>, "Relative residual of the static equilibrium",
              kNumber, {1e-13, 0.1}),
       option("history_interval", at<&C::run, &R::history_interval>, "Rolling distance between rows of history.csv",
              kLength, above(0, 1)),
       option("rolling", at<&C::run, &R::rolling>, "false stops after the static preload"),
       option("plasticity", at<&C::run, &R::plasticity>,
              "Finite elements: materials with a strength or a hardening yield; the half-space engine stays elastic"),
       option("plastic_depth", at<&C::run, &R::plastic_depth>,
              "Depth of a box under the path whose elements follow the law of yielding from the start; without a box "
              "those that come near yielding do, as they do outside of one",
              kLength, above(0, 1)),
       option("plastic_width", at<&C::run, &R::plastic_width>,
              "Its reach to either side of the contact point; of a box that is given by one of the two, the depth is "
              "2.5 times Hertz's larger half-axis, the reach 1.6 times his half-width and two elements",
              kLength, above(0, 1)),
       choice_at<&C::run, &R::judged>(
           "judged",
           "Whose strength and fatigue are judged: the answer, its zones and the worst load are of these bodies",
           {{"both", JudgedBodies::both}, {"rail", JudgedBodies::rail}, {"wheel", JudgedBodies::wheel}})}};
}

OptionTable bem_table() {
  return {
      "bem",
      "The half-space engine",
      {choice_at<&C::bem, &BemSpec::leading_edge>(
           "leading_edge",
           "Where rows of cells meet the leading edge of the patch: inside a cell, from the gap, or between two "
           "cells, as Kalker's method and CONTACT have it",
           {{"sub_cell", LeadingEdge::sub_cell}, {"whole_cell", LeadingEdge::whole_cell}}),
       choice_at<&C::bem, &BemSpec::spin_angle>("spin_angle",
                                                "The angle that the lateral slip of spin is taken with: the surfaces' "
                                                "own at each place of the patch, or that of the contact plane",
                                                {{"local", SpinAngle::local}, {"patch", SpinAngle::patch}})}};
}

OptionTable passes_table() {
  using P = PassesSpec;
  return {
      "passes",
      "Passes over a rail that yields (`railstrata passes`); lists begin again after their last value",
      {option("lateral_positions", at<&C::passes, &P::lateral_positions>,
              "Of the wheel in pass 1, 2, …, positive to the field side; not given: every pass at 0", kLength, {-1, 1}),
       option("lateral_deviation", at<&C::passes, &P::lateral_deviation>,
              "Standard deviation of a normal distribution about these positions, cut at three of it", kLength,
              above(0, 0.01)),
       option("lateral_seed", at<&C::passes, &P::lateral_seed>,
              "Of the distribution's random numbers; pass n has its own, however the passes are cut", kNumber, {0, 1e9})
           .where(scatters),
       option("traction_coefficients", at<&C::passes, &P::traction_coefficients>,
              "F_T over the static load G in pass 1, 2, …; not given: that of the drive", kNumber, {-10, 10}),
       choice_at<&C::passes, &P::pressure>(
           "pressure",
           "Stationary method: pressure and friction on the surface as the passes shape it, or those of the elastic "
           "bodies in every pass",
           {{"elastic", PassPressure::elastic}, {"following", PassPressure::following}}),
       option("ductility", at<&C::passes, &P::ductility>,
              "Net plastic strain that the material bears: passes are extrapolated to it", kNumber, above(0, 100)),
       choice_at<&C::passes, &P::jump>("jump",
                                       "Jump over passes by extrapolating the state of the rail, as far as the rates "
                                       "computed after the jump are those expected",
                                       {{"off", PassJump::off}, {"auto", PassJump::automatic}}),
       option("jump_tolerance", at<&C::passes, &P::jump_tolerance>,
              "Of the net strain and of the accumulated strain of a pass after a jump, against those expected", kNumber,
              above(0, 0.5))
           .where(jumps),
       option("patch_cells", at<&C::passes, &P::patch_cells>,
              "Cells of the grid of plastic strain over each half-axis of the patch", kNumber, {2, 64}),
       option("patch_rows", at<&C::passes, &P::patch_rows>, "Its rows over the shorter half-axis", kNumber, {2, 128}),
       option("first_row", at<&C::passes, &P::first_row>,
              "Thickness of its row at the surface; those below grow by a quarter each; not given: as the others",
              kLength, above(0, 0.1)),
       option(
           "window", at<&C::passes, &P::window>,
           "Half-lengths of the patch behind the load where flow is followed; not given: 4, of a line contact 6, and "
           "as many more as the flow of pass 1 asks for",
           kNumber, {2, 100}),
       option(
           "window_tolerance", at<&C::passes, &P::window_tolerance>,
           "Flow in the last quarter of the window over the largest of the pass: above it a window that is not given "
           "grows by half, to four times its usual length at most; where it is given, there is a warning",
           kNumber, above(0, 1))}};
}

OptionTable output_table() {
  return {
      "output",
      "Files",
      {option("volume", at<&C::output, &O::volume>, "Write the fine zone as VTU"),
       option("patch_series", at<&C::output, &O::patch_series>, "Write the patch during the rolling as a VTP series"),
       option("series_frames", at<&C::output, &O::series_frames>, "Frames of the series", kNumber, {1, 10000})}};
}

}  // namespace railstrata
