#pragma once
// Gauss and Legendre's rule of eight points on 0 to 1.
#include <array>

namespace railstrata {

struct GaussPoint {
  double node, weight;
};
inline constexpr std::array<GaussPoint, 8> kGauss8{{{0.01985507175123188, 0.05061426814518813},
                                                    {0.10166676129318664, 0.11119051722668724},
                                                    {0.2372337950418355, 0.15685332293894363},
                                                    {0.4082826787521751, 0.18134189168918100},
                                                    {0.5917173212478249, 0.18134189168918100},
                                                    {0.7627662049581645, 0.15685332293894363},
                                                    {0.8983332387068134, 0.11119051722668724},
                                                    {0.9801449282487681, 0.05061426814518813}}};

}  // namespace railstrata
