#pragma once
// Error bars of half-space results: what the size of the cells leaves uncertain in steady rolling of one patch. The
// laws cost nothing beside the solution. Their constants are those that 98 % of 150 cases drawn at random keep, each
// against its solution on cells of a quarter (tools/cell_error_cases.py, docs/bem-verification.md).
//
// With h the cell, a the shorter semi-axis, r = sqrt(area / pi), L the patch's length, s the slip area, d2 the largest
// second difference of the pressure of a cell and its neighbours, in either direction:
//
//   p_max       max over cells of (p + 0.09 d2), less max p: bends of a profile that cells miss show in d2
//   q_max       as p_max, relative, + 0.37 (h / (s L))^1.4: the front of slip, cells behind it counted
//   slip area   0.22 h/a sqrt(1 - s) + 0.001
//   forces      0.08 h/r f F_n
//   creepages   0.14 h/r (|creepage| + f p_max / (2 G)), 1/G the mean of both bodies' compliances
//   von Mises   as p_max, relative, + 0.04 x^3 / (1 + x^2), x = h / depth: cells fade with depth
#include "bem/solve_bem.hpp"
#include "result/summary.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {

/// None where the laws do not hold: several patches, a line, a given approach, whole cells at the leading edge; that
/// the contact is steady or without friction the caller has to know. With friction by place, direction, temperature or
/// memory, or a film that yields, of p_max alone.
ContactErrors cell_errors(const CaseSpec& spec, const BemResult& result, const ContactSummary& contact);

/// Of the von Mises stresses below the surface, by the bar of p_max; of none where that is NaN.
void add_stress_errors(const BemResult& result, const ContactSummary& contact, StressSummary& stress);

}  // namespace railstrata
