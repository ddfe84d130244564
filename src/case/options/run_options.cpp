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
  return {"mesh",
          "Element sizes",
          {option("element_size", at<&C::mesh, &H::element_size>,
                  "Edge length at the running surfaces and in the studied subsurface", kLength,
                  {0.05 * kMilli, 20 * kMilli}),
           option("fine_width", at<&C::mesh, &H::fine_width>,
                  "Lateral width of the fine cap, centred on the contact. Not given: 24 mm, more where the patch is "
                  "wider",
                  kLength, {kMilli, 0.1}),
           option("fine_depth", at<&C::mesh, &H::fine_depth>, "Depth of the fine cap", kLength, {0.5 * kMilli, 0.05}),
           option("largest", at<&C::mesh, &H::largest>, "Largest edge far from the contact", kLength, {kMilli, 0.2}),
           option("coarse_ratio", at<&C::mesh, &H::coarse_ratio>,
                  "Spacing along the path outside the cap, in element sizes", kNumber, {1, 20}),
           choice_at<&C::mesh, &H::element>(
               "element",
               "full: fully integrated, without locking; one_point: one integration point with hourglass stiffness",
               {{"full", ElementFormulation::full}, {"one_point", ElementFormulation::one_point}}),
           option("end_length", at<&C::mesh, &H::end_length>, "Rail beyond both ends of the fine range", kLength,
                  {1e-3, 5})}};
}

OptionTable run_table() {
  return {
      "run",
      "Path, damping and steps",
      {choice_at<&C::run, &R::start>(
           "start",
           "steady: rolling starts with the friction, torque and creepage of steady rolling, from rest where the case "
           "has no such state or gives drive.torque_ramp or drive.creepage_start; rest: the torque rises over "
           "drive.torque_ramp",
           {{"steady", RunStart::steady}, {"rest", RunStart::rest}}),
       option("positions", at<&C::run, &R::positions>,
              "Wheel positions at which results are wanted, increasing. Left out: from a steady start on until the "
              "results repeat, from rest 0.3 m",
              kLength, {0, 20}),
       option("window", at<&C::run, &R::window>,
              "Rolling distance, centred on each position, over which results are averaged", kLength, {0, 1}),
       option("run_up", at<&C::run, &R::run_up>,
              "Rolling distance over which the run-up damping fades to zero. Left out: from a steady start two lengths "
              "of the patch, from rest 120 mm",
              kLength, {0, 10}),
       option("run_up_damping", at<&C::run, &R::run_up_damping>, "Mass-proportional damping of vibration at the start",
              kRate, {0, 1e6}),
       option("step_safety", at<&C::run, &R::step_safety>, "Time step as a share of the stable one", kNumber,
              above(0, 1)),
       option("mass_scaling_step", at<&C::run, &R::mass_scaling_step>,
              "Selective mass scaling of thin layers: target time step, in element sizes over the matrix's pressure "
              "wave speed, used where it lengthens the step by more than a fifth; 0: real masses and their short step",
              kNumber, {0, 10}),
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
              "Finite elements: materials with a strength or hardening can yield; the half-space engine stays elastic"),
       choice_at<&C::run, &R::judged>(
           "judged",
           "Bodies whose strength and fatigue are assessed; the answer, its zones and the worst load refer to them",
           {{"both", JudgedBodies::both}, {"rail", JudgedBodies::rail}, {"wheel", JudgedBodies::wheel}})}};
}

OptionTable bem_table() {
  return {"bem",
          "The half-space engine",
          {choice_at<&C::bem, &BemSpec::bodies>(
               "bodies",
               "Elastic bodies of the contact. sections: the sections of rail and wheel with their layers, the foot "
               "held or on [track], the bore held",
               {{"half_spaces", ContactBodies::half_spaces}, {"sections", ContactBodies::sections}}),
           choice_at<&C::bem, &BemSpec::leading_edge>(
               "leading_edge",
               "How rows of cells meet the leading edge of the patch. sub_cell: inside a cell, computed from the gap; "
               "whole_cell: between two cells, as in Kalker's method and CONTACT",
               {{"sub_cell", LeadingEdge::sub_cell}, {"whole_cell", LeadingEdge::whole_cell}}),
           choice_at<&C::bem, &BemSpec::spin_angle>(
               "spin_angle",
               "Contact angle used for the lateral slip due to spin. local: the surface angle at each point of the "
               "patch; patch: the angle of the contact plane",
               {{"local", SpinAngle::local}, {"patch", SpinAngle::patch}}),
           choice_at<&C::bem, &BemSpec::normals>(
               "normals",
               "Directions of gap, pressure and traction. plane: those of the contact plane; local: in each row of "
               "cells those of the surfaces there, with cells by arc length across, for conformal contact",
               {{"plane", ContactNormals::plane}, {"local", ContactNormals::local}})}};
}

OptionTable passes_table() {
  using P = PassesSpec;
  return {
      "passes",
      "Passes over a yielding rail (`railstrata passes`); lists start again after their last value",
      {option("lateral_positions", at<&C::passes, &P::lateral_positions>,
              "Lateral position of the wheel in pass 1, 2, …, positive to the field side; not given: every pass at 0",
              kLength, {-1, 1}),
       option("lateral_deviation", at<&C::passes, &P::lateral_deviation>,
              "Standard deviation of a normal distribution about these positions, cut at three deviations", kLength,
              above(0, 0.01)),
       option("lateral_seed", at<&C::passes, &P::lateral_seed>,
              "Seed of the random positions; pass n always gets the same one, also in a series continued later",
              kNumber, {0, 1e9})
           .where(scatters),
       option("traction_coefficients", at<&C::passes, &P::traction_coefficients>,
              "F_T over the static load G in pass 1, 2, …; not given: the value of [drive]", kNumber, {-10, 10}),
       choice_at<&C::passes, &P::pressure>(
           "pressure",
           "Stationary method. following: pressure and friction on the surface as the passes deform it; elastic: those "
           "of the elastic bodies in every pass",
           {{"elastic", PassPressure::elastic}, {"following", PassPressure::following}}),
       option("ductility", at<&C::passes, &P::ductility>,
              "Net plastic strain at which the material fails; passes are extrapolated to it", kNumber, above(0, 100)),
       choice_at<&C::passes, &P::jump>("jump",
                                       "Skip passes by extrapolating the state of the rail, as long as the rates "
                                       "computed after a jump agree with the predicted ones",
                                       {{"off", PassJump::off}, {"auto", PassJump::automatic}}),
       option("jump_tolerance", at<&C::passes, &P::jump_tolerance>,
              "Tolerance of a jump: difference of the net and accumulated strain of the pass after it from the "
              "predicted values",
              kNumber, above(0, 0.5))
           .where(jumps),
       option("patch_cells", at<&C::passes, &P::patch_cells>,
              "Grid of plastic strain: cells over each half-axis of the patch", kNumber, {2, 64}),
       option("patch_rows", at<&C::passes, &P::patch_rows>,
              "Grid of plastic strain: rows in depth over the shorter half-axis", kNumber, {2, 128}),
       option("first_row", at<&C::passes, &P::first_row>,
              "Grid of plastic strain: thickness of the row at the surface; each row below is a quarter thicker; not "
              "given: the same as the other rows",
              kLength, above(0, 0.1)),
       option(
           "window", at<&C::passes, &P::window>,
           "Length behind the load where plastic flow is computed, in half-lengths of the patch; not given: 4 (line "
           "contact 6). Where more than 0.1 % of the largest flow of a pass comes in its last quarter, a window that "
           "is not given grows by half, up to four times its usual length; a given one causes a warning",
           kNumber, {2, 100})}};
}

OptionTable output_table() {
  return {"output",
          "Output files",
          {option("volume", at<&C::run, &R::output, &O::volume>, "Write the fine zone as VTU"),
           option("patch_series", at<&C::run, &R::output, &O::patch_series>,
                  "Write the patch during the rolling as a VTP series"),
           option("series_frames", at<&C::run, &R::output, &O::series_frames>, "Frames of the series", kNumber,
                  {1, 10000})}};
}

}  // namespace railstrata
