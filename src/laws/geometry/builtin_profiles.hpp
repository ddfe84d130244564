#pragma once
// The profiles shipped inside the program, from the radii and formulas that define them (data/profiles/README.md).
#include "geometry/profile.hpp"

namespace railstrata {

/// LMA wheel: arcs R25-R12-R15-70°-R14-R90-R450, cones 1:40 and 1:15.
Profile lma_wheel();
/// S1002 wheel from the formulas of UIC 510-2, as a spline through points 0.25 mm apart.
Profile s1002_wheel();
/// Rail heads R300-R80-R13 with 1:20 faces.
Profile cn60_rail();
Profile uic60_rail();
Profile uic54_rail();

/// The S1002 formulas themselves: height [mm], positive towards the flange's crest, of the lateral coordinate y [mm] in
/// [-70, 60]. Zones A…H of UIC 510-2; as published, zone C (y from -35 to -26) misses its neighbours by up to 1.2e-4
/// mm; a straight line added to it closes the curve.
double s1002_height_mm(double y);

}  // namespace railstrata
