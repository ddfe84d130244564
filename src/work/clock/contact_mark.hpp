#pragma once
// Where a load's contact is and how hard it presses, to see how far it has changed.
#include <vector>

namespace railstrata {

struct ContactMark {
  double p_max = 0;        ///< Pa; 0: it was not solved
  std::vector<double> at;  ///< m, of its patches on the unworn profile
};

/// Changes that count as one.
struct MarkLimits {
  double change = 0;  ///< of the pressure, share of the larger one
  double moved = 0;   ///< m, of a patch
};

/// The largest change between two marks of a load over what counts as one. Patches are compared by place: their order
/// is that of pressures, which changes places where no patch does. One that has come or gone is a change of one, and
/// none is more than four, so that a few loads that go from tread to flange do not outweigh all others.
double change_between(const ContactMark& one, const ContactMark& other, const MarkLimits& limits);

}  // namespace railstrata
