#pragma once

namespace railstrata {

/// How finely the preload's coarse space cuts the bodies (body/aggregates.hpp). Smaller clusters: fewer iterations, a
/// larger coarse matrix. The result does not depend on it.
struct ClusterSizes {
  double at_contact = 24e-3;  ///< m, largest edge of a cluster at the contact point
  double growth = 0.2;        ///< added per metre of distance from it
};

}  // namespace railstrata
