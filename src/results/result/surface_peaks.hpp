#pragma once
// Where the stress of a loaded surface has peaks that the points of a contact field miss: at the edge of the patch and
// at the front of slip.
#include <vector>

#include "contact/contact_field.hpp"
#include "core/callable_ref.hpp"
#include "core/vec.hpp"

namespace railstrata {

/// The points along x of a contact field's column, at equal distances.
struct SurfaceRow {
  std::vector<double> p, q;  ///< Pa, q the magnitude
  std::vector<ContactState> state;
  CallableRef<Sym3(int)> stress;  ///< Pa, of a point; x rolling, z into the body
  double poisson = 0;             ///< of the surface
  bool cells = false;             ///< tractions are means over cells (half-spaces), not values at points
};

/// Edge: inside the patch the stress rises as the root of the distance to it. What is left of sigma_xx + p and
/// sigma_yy + 2 nu p is smooth (of a circular contact: [Johnson1985 eq. 3.43]); it is extrapolated from the two points
/// behind the outermost to the edge, where p² is zero.
///
/// Front of slip: |q| has a cusp there (result/patch.hpp). The stresses rise as a root on the
/// slipping side; on the sticking one what is left of sigma_xx + p and sigma_yy + 2 nu p is smooth (of a line contact:
/// constant) and is extrapolated from there; shear is f p.
struct SurfacePeaks {
  int first = 0, last = -1;  ///< points with pressure; none where they are fewer than four
  Sym3 behind, ahead;        ///< at the edges, just outside of first and last
  struct Front {
    int at;  ///< the sticking point next to it
    Sym3 stress;
  };
  std::vector<Front> fronts;
  bool any() const { return last >= first; }
};
SurfacePeaks surface_peaks(const SurfaceRow& row);

}  // namespace railstrata
