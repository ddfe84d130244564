#pragma once
// Potential contact area, undeformed distance and Hertz's numbers of a contact problem. [eve70a/CONTACT, user guide]
#include "cntc/problem.hpp"

namespace railstrata::cntc {

/// Throws Refused where something is missing or does not fit. Under layers Hertz's ellipse, which sizes the grid of
/// IPOTCN < 0, and the curvatures of IPOTCN -2 and -3 are those of the materials under them.
Discretisation discretise(const Settings& settings);

}  // namespace railstrata::cntc
