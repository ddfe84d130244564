#pragma once
// A half-space result as a Summary, with its checks: the same keys with the same meanings as a finite element result.
#include "bem/solve_bem.hpp"
#include "result/stress_sections.hpp"
#include "result/summary.hpp"

namespace railstrata {

/// Where below the surface stresses are looked for: from subsurface_begin, under all layers by the longer side of the
/// patch (the largest von Mises stress of any Hertzian ellipse lies above 0.4 of it), deeper while they rise.
SearchDepths depths_of_interest(const LayeredHalfSpace& body, const ContactSummary& contact);

/// Contact and checks; what else there is adds ask/judge.hpp. run.elements counts the cells of the grids. Of several
/// patches: F_x, F_y and F_z of all, warnings of the worse. NaN: penetration and scatter; without friction also slip
/// area and creepages. Steady rolling is the same everywhere: position is the case's last one, of a static case 0.
/// Checks (limits: check_limits.hpp): F_z against G, F_x/G against the wanted traction coefficient, the patch inside
/// the grid.
Summary bem_contact_summary(const CaseSpec& spec, const BemResult& result);

/// Warnings for implausible values of a summary and its stresses. coarsest: cell_of_patch of a transient's worst state.
std::vector<Warning> bem_warnings(const Summary& summary, const CaseSpec& spec, const BemResult& result,
                                  double coarsest = 0);

/// A cell, of the patch's shorter axis; of several patches the mean by their forces, since one that has just split off
/// is a cell wide and carries next to nothing. Of a transient each state has its own.
double cell_of_patch(const BemResult& result);
/// The check cell_of_patch of the worst state instead of the last.
void judge_coarsest_state(double coarsest, Summary& summary);

/// The largest stresses of one body, of several patches below the first: x, y in the contact plane from the rigid
/// contact point; `subsurface` starts at subsurface_begin (result/patch.hpp); `interface` takes either side.
StressSummary bem_stress(const BemResult& result, BodyId body, const ContactSummary& contact);

/// The rail's stress below the cell nearest to (x, y), model axes, from the surface to `deepest`; at an interface a row
/// for either side. Material: 0 the matrix, k the k-th layer.
StressSection rail_depth_line(const BemResult& result, double x, double y, double deepest);

}  // namespace railstrata
