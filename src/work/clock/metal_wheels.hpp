#pragma once
// The wheels that roll through the metal of a rail: a patch each of the loads that are solved on the profile of the
// day.
#include <cstddef>
#include <string>
#include <vector>

#include "clock/worn_profile.hpp"
#include "collective/collective.hpp"
#include "passes/metal.hpp"

namespace railstrata {

struct MetalWheels {
  std::vector<MetalWheel> wheels;
  std::vector<std::size_t> load_of;  ///< of the wheels, the row
  struct Fault {
    std::size_t load = 0;
    std::string why;
  };
  std::vector<Fault> faults;  ///< patches under which the metal cannot be followed
};

/// Of the rows that are sound and have their results; wheels: of all rows; kernels: kept from one call to the next.
MetalWheels metal_wheels(const std::vector<CollectiveRow>& rows, const WornProfile& surface, const MetalGrid& grid,
                         double wheels, InteriorKernels& kernels);

}  // namespace railstrata
