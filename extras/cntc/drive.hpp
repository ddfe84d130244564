#pragma once
// From the settings of a contact problem to its solution, by the half-space engine with whole cells at the leading
// edge, the scheme of Kalker and CONTACT.
#include <string>
#include <vector>

#include "cntc/problem.hpp"

namespace railstrata::cntc {

/// Solves the problem as it is set: `solved` is the new state. Settings that were changed are reported in `remarks`.
/// Throws Refused, with CONTACT's code; then there is no solution, and none to go on from.
void solve(Problem& problem, std::vector<std::string>& remarks);

/// Two states on elements of the same lattice as one: what the next case goes on from where patches join. Throws
/// Refused where the elements do not fit.
Solved joined(const Solved& one, const Solved& other);

}  // namespace railstrata::cntc
