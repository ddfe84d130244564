#pragma once
// What the points of profiles from files leave open of an answer.
#include "ask/answer.hpp"

namespace railstrata {

/// Solves the contact again with kOtherFits other fits of the profiles that leave much open
/// (geometry/profile_scatter.hpp) and widens the error bars by 2.4 times the root mean square of what moved points
/// change (Student's t of six, 95 %) and the largest change by another smoothing; of points far apart by twice the
/// largest change. Where other fits decide the number of patches, the largest pressure of all counts. Does nothing for
/// other profiles.
///
/// Where a listed profile has an edge in the patch, its pressure has no limit on finer cells: the bars of p_max and
/// shear are withheld, and the edge is named in `notes`.
void add_profile_errors(const CaseSpec& spec, const Placement& placement, const AskOptions& how,
                        std::vector<std::string>& notes, ContactSummary& contact);

}  // namespace railstrata
